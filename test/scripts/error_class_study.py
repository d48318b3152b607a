"""Holds the classes of error that mpm-seismic --check tells against errors that were measured, and prints their table.

    error_class_study.py DIR [--only WORD] [--programs BUILD]

Every case is run as coarsely as the class is asked for, and on finer cells as reference (hill: finite elements). Waves: rms of
the difference of horizontal velocity over the rms of the reference, worst gauge of the surface, ground elastic and without
gravity. Run-out: difference of the displacement of the centre of mass of what has moved. A class is right when the error that
was measured lies in it; it holds when the error lies in it or in a better one. Runs that are there are not repeated.
"""
import argparse
import csv
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, os.fspath(ROOT / "scripts"))
from plot_common import open_history
from plot_histories import read_gauges

CASES = ROOT / "cases"
BOUNDS = (0.02, 0.06, 0.2)
WEAKER = ["materials.clay.strength.peak=60 kPa", "materials.clay.strength.residual=26 kPa"]
GENTLE = ["surfaces.ground.points=[[0 m, 18 m], [30 m, 18 m], [60 m, 8 m], [90 m, 8 m]]", "materials.clay.strength.peak=54 kPa",
          "materials.clay.strength.residual=22 kPa", "output.gauges.points.crest=[30 m, 18 m]"]
ROCK = "{model: elastic, density: 2200 kg/m3, young_modulus: 250 MPa, poisson_ratio: 0.25}"
SOIL = "{model: elastic, density: 1800 kg/m3, young_modulus: 40 MPa, poisson_ratio: 0.35}"
TSAOLING = [f"materials.{name}={{model: elastic, density: 2450 kg/m3, young_modulus: {modulus}, poisson_ratio: 0.3}}"
            for name, modulus in (("mass", "3.6 GPa"), ("shear_zone", "1 GPa"))]
BUILT_IN = ["seismic.motion.horizontal=built_in"]
LEVEL = ["domain.x=[0 m, 12 m]", "output.gauges.points.top=[6 m, 20 m]"]
STILL = ["static.gravity=0 m/s2", "seismic.duration=8 s"]
PAPERS = ["seismic.transfer=apic", "grid.interfaces=sharp", "seismic.inertia=lumped"]
HILL = ["left", "behind", "crest", "middle", "toe", "right"]
# case, settings, gauges at the surface (none: run-out), cells that the model was made with, cells held out, reference (m, or a
# run of another case; none: finite elements)
STUDIED = {
    "layer": ("verification/layer", LEVEL, ["top"], (1.5, 1, 0.75, 0.5), (0.6,), 0.25),
    "two layers": ("verification/two_layers", LEVEL, ["top"], (1.5, 1, 0.5), (0.75,), 0.25),
    "hill": ("verification/hill", [], HILL, (2, 1.25, 1, 0.5), (1.4, 0.7), None),
    "layer, paper's method": ("verification/layer", [*LEVEL, *PAPERS], ["top"], (), (0.75, 0.5), "layer/0.25"),
    "hill, paper's method": ("verification/hill", PAPERS, HILL, (), (1, 0.5), None),
    "slope, elastic": ("slope", [f"materials.soil={SOIL}", *STILL], ["crest", "middle", "toe", "left", "right"], (2, 1), (1.25,), 0.5),
    "first, elastic": ("first", [f"materials.clay={SOIL}", *STILL], ["crest", "toe"], (2, 1, 0.6), (1.5, 0.75), 0.3),
    "tsaoling, elastic": ("tsaoling", [*TSAOLING, *BUILT_IN, "seismic.motion.vertical=built_in", *STILL],
                          ["A", "B", "bench", "toe", "left", "right"], (25, 12.5), (18.4,), 6.25),
    "first": ("first", ["seismic.duration=20 s"], None, (1, 0.75, 0.6), (0.9,), 0.4),
    "first, weaker": ("first", ["seismic.duration=20 s", *WEAKER], None, (1, 0.6), (0.75,), 0.4),
    "first, gentler": ("first", ["seismic.duration=20 s", *GENTLE], None, (), (1, 0.75, 0.6), 0.4),
    "slope": ("slope", ["seismic.duration=20 s"], None, (1, 0.8), (), 0.5),
}


def said_by(*command):
    """What a program says."""
    return subprocess.run([os.fspath(part) for part in command], check=True, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True).stdout


def run(programs, case, options, folder):
    """Both stages, or the second alone without gravity, once."""
    if (folder / "summary.json").exists() and json.loads((folder / "summary.json").read_text())["exit"] == 0:
        return
    start = []
    if "static.gravity=0 m/s2" not in options and "verification" not in os.fspath(case):
        said_by(programs / "mpm-static", case, "--out", folder / "static", "--quiet", *options)
        start = ["--from", folder / "static" / "final.h5"]
    said_by(programs / "mpm-seismic", case, *start, "--out", folder, "--quiet", *options)


def velocities(folder, gauges):
    """Times and horizontal velocities {gauge: values}."""
    with open_history(folder) as file:
        time, names, fields = read_gauges(file)
    return time, {name: fields["velocity"][:, names.index(name), 0] for name in gauges}


def finite_elements(gauges):
    """The reference of cases/verification/hill, as velocities()."""
    with open(CASES / "verification/hill/reference.csv", encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    table = dict(zip(rows[0], np.array(rows[1:], dtype=float).T))
    return table["time"], {name: table[f"{name}_x"] for name in gauges}


def wave_error(folder, reference, gauges):
    """Of the worst gauge; without a reference it is the hill's."""
    time, found = velocities(folder, gauges)
    reference_time, true = velocities(reference, gauges) if reference else finite_elements(gauges)
    errors = []
    for name in gauges:
        wanted = np.interp(time, reference_time, true[name])
        errors.append(np.sqrt(np.mean((found[name] - wanted) ** 2) / np.mean(wanted**2)))
    return max(errors)


def run_out(folder):
    """Displacement of the centre of mass of what has moved (m)."""
    return np.linalg.norm(json.loads((folder / "summary.json").read_text())["slide"]["centre_of_mass_displacement"])


def letter(error):
    """The class of an error."""
    return "ABCD"[sum(error >= bound for bound in BOUNDS)]


def expected(said):
    """Classes of waves and run-out and the shares behind them, of the settings that were chosen."""
    row = next(line for line in said.splitlines() if re.match(r"(as it is|\w+ \*) ", line)).split()
    shares = re.search(r"in the first row waves (\S+) .*run-out (\S+) ", said)
    return row[-2:], [float(share) / 100 if share != "not" else float("nan") for share in shares.groups()]


def main():
    """Prints a row for each case and size of cells."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--programs", type=Path, default=ROOT / "build")
    arguments = parser.parse_args()
    programs, right = arguments.programs.resolve(), {"made with": [], "held out": []}
    print("| case | error of | cells (m) | | expected | class | measured | class |\n" + "| --- " * 8 + "|")
    for name, (case, settings, gauges, fitted, held, finest) in STUDIED.items():
        if not re.search(arguments.only, name):
            continue
        case, folder = CASES / case / "case.yaml", arguments.out.resolve() / re.sub(r"\W+", "-", name)
        options = {h: ["--threads", "1", *(word for s in [*settings, f"grid.spacing={h} m"] for word in ("--set", s))]
                   for h in (*fitted, *held, finest) if isinstance(h, (int, float))}
        for h, own in options.items():
            run(programs, case, own, folder / f"{h}")
        reference = arguments.out.resolve() / finest if isinstance(finest, str) else finest and folder / f"{finest}"
        for h in (*fitted, *held):
            (waves, slides), shares = expected(said_by(programs / "mpm-seismic", case, "--check", *options[h]))
            told, share = (waves, shares[0]) if gauges else (slides, shares[1])
            error = (wave_error(folder / f"{h}", reference, gauges) if gauges else
                     abs(run_out(folder / f"{h}") / run_out(reference) - 1))
            role = "held out" if h in held else "made with"
            right[role].append((told == letter(error), told >= letter(error)))
            print(f"| {name} | {'waves' if gauges else 'run-out'} | {h:g} | {role} | {100 * share:.2g} % | {told} | {100 * error:.2g} % | "
                  f"{letter(error)} |", flush=True)
    print()
    for role, found in right.items():
        print(f"{role}: {sum(same for same, _ in found)} of {len(found)} classes are right, {sum(holds for _, holds in found)} hold")


if __name__ == "__main__":
    sys.exit(main())
