"""Writes a state file of ParaView that shows a slide, and its picture: scripts/paraview-state RUN_FOLDER [--field NAME] [--time S].

The particles as large as they are, coloured by a field, with the time, over all frames: open it by paraview RUN_FOLDER/slide.pvsm.
Wants ParaView 5.11 or newer with its pvbatch (Debian: paraview, python3-paraview), and where there is no screen Xvfb.
"""
import argparse
import json
import shutil
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np

import plot_sections
from display import NEEDS_SERVER, screen
from options import Parser
from plot_common import Missing, frame_times

SCENE = Path(__file__).resolve().with_name("paraview_scene.py")
NEEDED = ["pvbatch", *(["Xvfb"] if NEEDS_SERVER else [])]


def parse_arguments():
    """The command line."""
    parser = Parser(prog="paraview-state", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, metavar="RUN_FOLDER", help="output folder of mpm-seismic")
    parser.add_argument("--field", default="plastic_strain", metavar="NAME", help="dataset of the frames; of vectors the magnitude; default %(default)s")
    parser.add_argument("--time", type=float, metavar="S", help="of the picture: the nearest frame; default the last")
    parser.add_argument("--force", action="store_true", help="replace a state file that is there")
    return parser.parse_args()


def scene_of(given):
    """What the scene is made of: files, time (s), radius (m), sides (m), the field and the range of its colours."""
    frames = frame_times(given.folder)
    time, path = plot_sections.choose(frames, [given.time])[0] if given.time is not None else frames[-1]
    with h5py.File(path, "r") as file, h5py.File(frames[0][1], "r") as first:
        particles = file["particles"]
        fields = [name for name, data in particles.items() if data.dtype.kind in "fi" and len(data) == len(particles["id"])]
        if given.field not in fields or not len(particles["id"]):
            raise Missing(f"{path.name} has no {given.field}; it has: {', '.join(fields)}")
        values = particles[given.field][...].reshape(len(particles["id"]), -1)
        size = float(np.sqrt(np.median(first["particles/volume"][...])))
        places = np.concatenate([part["particles/position"][:, :2] for part in (first, file)])
    values = np.linalg.norm(values, axis=1) if values.shape[1] > 1 else values[:, 0]
    low, high = (float(value) for value in np.percentile(values, (0, 99.5)))
    return {"series": str((given.folder / "frames.hdf.series").resolve()), "time": time, "radius": size, "field": given.field,
            "range": [low, high if high > low else low + 1.0], "low": places.min(axis=0).tolist(), "high": places.max(axis=0).tolist(),
            "state": str((given.folder / "slide.pvsm").resolve()), "picture": str((given.folder / "pictures" / "paraview.png").resolve())}


def main():
    """Writes both; returns the exit code."""
    given = parse_arguments()
    try:
        scene = scene_of(given)
    except Missing as reason:
        print(f"paraview-state: {given.folder}: {reason}", file=sys.stderr)
        return 66
    if Path(scene["state"]).exists() and not given.force:
        print(f"paraview-state: {scene['state']}: is there already; --force replaces it", file=sys.stderr)
        return 73
    missing = [name for name in NEEDED if not shutil.which(name)]
    if missing:
        print(f"paraview-state: there is no {missing[0]}; install it (Debian: paraview, python3-paraview, xvfb)", file=sys.stderr)
        return 69
    (given.folder / "pictures").mkdir(exist_ok=True)
    command = ["pvbatch", "--force-offscreen-rendering", SCENE, json.dumps(scene)]
    with screen() as environment:
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if done.returncode or not Path(scene["picture"]).exists():
        print(f"paraview-state: pvbatch ended with {done.returncode}: {(done.stderr or done.stdout).strip()[-500:]}", file=sys.stderr)
        return 70
    print(scene["picture"], scene["state"], sep="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
