"""Checks that ParaView reads the frames of a run as h5py does, and draws the state of scripts/paraview-state; prints 'N passed, N failed'.

    check_paraview.py [FOLDER_OF_PROGRAMS]

Runs the first case coarsely for 8 s of one processor, and pvbatch three times. Skipped where there is no pvbatch.
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np
from matplotlib.image import imread

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
from checking import report
from display import screen
from paraview_state import NEEDED

ROOT = Path(__file__).resolve().parent.parent.parent
PROGRAMS = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build"
CASE = ROOT / "cases" / "first" / "case.yaml"
CODES = [0, 73, 0, 66, 64]  # of paraview-state: once, again, with --force, a field that is none, an option that is none
SHORT = ("--set", "seismic.duration=6 s", "--set", "output.frames.every=2 s", "--quiet")

# What pvbatch runs: all that ParaView makes of the frames, and of the state, as arrays in a file.
READ = """
import sys
import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
series, out = sys.argv[1:]
reader = simple.OpenDataFile(series)
simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
found = {"times": np.array(simple.GetAnimationScene().TimeKeeper.TimestepValues)}
for k, time in enumerate(found["times"]):
    reader.UpdatePipeline(time)
    data = simple.servermanager.Fetch(reader)
    points, fields = data.GetPointData(), data.GetFieldData()
    found[f"{k}/position"] = vtk_to_numpy(data.GetPoints().GetData())
    for i in range(points.GetNumberOfArrays()):
        found[f"{k}/{points.GetArrayName(i)}"] = vtk_to_numpy(points.GetArray(i))
    if points.GetGlobalIds():  # ParaView 5.11 does not take them from the file
        found[f"{k}/global ids"] = vtk_to_numpy(points.GetGlobalIds())
    names = fields.GetAbstractArray("material_names")
    found[f"{k}/names"] = np.array([names.GetValue(i) for i in range(names.GetNumberOfValues())])
    found[f"{k}/cells"] = np.array([data.GetNumberOfCells(), data.GetCellType(0)])
np.savez(out, **found)
"""
LOAD = """
import json, sys
from paraview import simple
simple.LoadState(sys.argv[1])
view = simple.GetActiveViewOrCreate("RenderView")
shown = [part for part in view.Representations if hasattr(part, "ColorArrayName") and part.ColorArrayName[1]]
reader = shown[0].Input
print("STATE " + json.dumps({"time": view.ViewTime, "field": shown[0].ColorArrayName[1], "times": list(reader.TimestepValues)}))
"""


def pvbatch(folder, script, *words):
    """What a script says that pvbatch runs, on a screen."""
    (folder / "script.py").write_text(script)
    command = ["pvbatch", "--force-offscreen-rendering", folder / "script.py", *words]
    with screen() as environment:
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def run(folder):
    """A run of four frames."""
    for words in (("mpm-static", CASE, "--out", folder / "static", "--quiet"),
                  ("mpm-seismic", CASE, "--from", folder / "static/final.h5", "--out", folder / "run", *SHORT)):
        subprocess.run([PROGRAMS / words[0], *words[1:]], check=True, capture_output=True)
    return folder / "run"


def frames(folder, run_folder):
    """Errors of the times; names that one of both lacks; greatest difference of the values; wrong ids and materials."""
    pvbatch(folder, READ, run_folder / "frames.hdf.series", folder / "read.npz")
    paths = sorted(run_folder.glob("frame-*.hdf"))
    times, names, values, wrong = 0.0, 0, 0.0, 0
    with np.load(folder / "read.npz") as found:
        wrong += len(found["times"]) != len(paths)
        for k, path in enumerate(paths):
            read = {name.split("/")[1]: found[name] for name in found if name.startswith(f"{k}/")}
            with h5py.File(path) as file:
                held = {name: data[...] for name, data in file["particles"].items() if name not in ("component", "stress_component")}
                times = max(times, abs(found["times"][k] - float(file.attrs["time"])))
                wrong += list(read.pop("names")) != [name.decode() for name in file["material_names"][...]]
            wrong += not np.array_equal(read.pop("global ids", held["id"]), held["id"])
            wrong += list(read.pop("cells")) != [len(held["id"]), 1]  # each a vertex
            names += len(set(read) ^ set(held))
            values = max(values, *(np.abs(read[name] - held[name]).max() for name in set(read) & set(held)))
    return times, names, values, wrong


def state(folder, run_folder):
    """Exit codes, picture and state of scripts/paraview-state."""
    command = [ROOT / "scripts" / "paraview-state", run_folder, "--field", "displacement", "--time", "4.1"]
    tried = [subprocess.run([*command, *more], capture_output=True, text=True, check=False)
             for more in ([], [], ["--force"], ["--force", "--field", "component"], ["--force", "--filed", "q"])]
    codes = [done.returncode for done in tried]
    if codes != CODES:
        print(*(f"     {done.returncode}: {done.stderr.strip()}" for done in tried), sep="\n")
    told = json.loads(pvbatch(folder, LOAD, run_folder / "slide.pvsm").split("STATE ")[1])
    pixels = imread(run_folder / "pictures" / "paraview.png")[:, :, :3].reshape(-1, 3)
    colours = len(np.unique((16 * pixels).astype(int), axis=0))
    return abs(told["time"] - 4.0) + (told["field"] != "displacement") + (len(told["times"]) != 4), codes, colours


def checks():
    """Name and (error, tolerance) of every check."""
    lacking = [name for name in NEEDED if not shutil.which(name)]
    if lacking:
        yield "frames and state in ParaView", f"there is no {lacking[0]} (Debian: paraview, python3-paraview, xvfb)"
        return
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run_folder = run(folder)
        times, names, values, wrong = frames(folder, run_folder)
        yield "times of the frames in ParaView (s)", (times, 1e-9)  # which has them from text of 17 digits
        yield "names of the fields in ParaView: as h5py has them", (names, 0)
        yield "values of all fields in ParaView: those of h5py, to the bit", (values, 0)
        yield "ids, vertices, names of materials, number of frames in ParaView", (wrong, 0)
        off, codes, colours = state(folder, run_folder)
        yield "paraview-state ends as it should: done, 73 without --force, done, 66, 64", (float(codes != CODES), 0)
        yield "its state opens with all frames, at the time and with the field that were asked for", (off, 0.005)
        yield "its picture has a scale of colours, 30 at least", (float(colours < 30), 0)


if __name__ == "__main__":
    os.environ["OMP_NUM_THREADS"] = "1"
    sys.exit(report(checks()))
