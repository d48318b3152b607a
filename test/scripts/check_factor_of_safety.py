"""Checks the factor of safety of a slope against Bishop's method, and which strengths are reduced; prints 'N passed, N failed'."""
import csv
import json
import os
import subprocess
import sys
import tempfile
from math import atan, radians, tan
from pathlib import Path

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
from checking import report
from factor_of_safety import bracket, weakened

ROOT = Path(__file__).resolve().parent.parent.parent
PROGRAMS = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build"
FOLDER = ROOT / "cases" / "verification" / "slope"


def wrong(*claims):
    """Number of claims that do not hold, and the number that may."""
    return float(sum(not claim for claim in claims)), 0.0


def reduced():
    """Cohesion, tan(phi), Mises stress, tension cut-off and friction, peak and residual, are divided; nothing else is."""
    materials = {"rock": {"model": "elastic", "young_modulus": "1 Pa"},
                 "clay": {"model": "von_mises", "strength": {"peak": "64000 Pa", "residual": "30000 Pa"}, "softening": {"strain": "0.1"}},
                 "mass": {"model": "mohr_coulomb", "cohesion": {"peak": "980 Pa", "residual": "0 Pa"}, "dilation_angle": "0.1 rad",
                          "friction_angle": {"peak": f"{radians(30):.15g} rad", "residual": "0.2 rad"}, "tension_cutoff": "500 Pa"},
                 "zone": {"model": "slip_weakening", "friction": {"peak": 0.56, "residual": 0.07}, "critical_slip": "1 m"}}
    wanted = {"clay.strength.peak": 32000, "clay.strength.residual": 15000, "mass.cohesion.peak": 490, "mass.cohesion.residual": 0,
              "mass.friction_angle.peak": atan(tan(radians(30)) / 2), "mass.friction_angle.residual": atan(tan(0.2) / 2),
              "mass.tension_cutoff": 250, "zone.friction.peak": 0.28, "zone.friction.residual": 0.035}
    found = {key[len("materials."):]: float(value.split()[0]) for key, value in weakened(materials, 2.0).items()}
    return (max(abs(found[key] - value) for key, value in wanted.items()) if found.keys() == wanted.keys() else 1.0), 1e-9


def bracketed():
    """The bracket of a threshold on either side of 1 holds it and is narrow; without one there is none."""
    ends = [bracket(lambda factor, at=at: factor < at, 0.01) for at in (0.31, 0.999, 1.47, 8.0)]
    return wrong(*(low < at <= high and high - low <= 0.01 for (low, high), at in zip(ends, (0.31, 0.999, 1.47, 8.0))),
                 bracket(lambda factor: True, 0.01)[1] is None, bracket(lambda factor: False, 0.01)[0] is None)


def of_clay(folder):
    """Of the clay slope, five cells high, within 5 % of Bishop's method; found again at once, and refused for another case."""
    with open(FOLDER / "reference.csv", newline="") as file:
        reference = next(csv.DictReader(line for line in file if not line.startswith("#")))
    command = [str(ROOT / "scripts" / "factor-of-safety"), str(FOLDER / "clay.yaml"), "--out", str(folder), "--programs", str(PROGRAMS),
               "--set", "grid.spacing=2 m"]
    first = subprocess.run(command, capture_output=True, text=True, check=False)
    found = json.loads((folder / "factor-of-safety.json").read_text())
    marks = {path: path.stat().st_mtime_ns for path in folder.glob("*/log.txt")}
    second = subprocess.run(command, capture_output=True, text=True, check=False)
    other = subprocess.run([*command, "--set", "materials.ground.strength.peak=90 kPa"], capture_output=True, text=True, check=False)
    good = (first.returncode, second.returncode, other.returncode) == (0, 0, 73) and first.stdout == second.stdout \
        and marks == {path: path.stat().st_mtime_ns for path in marks} and 0 < found["fails"] - found["stands"] <= 0.02
    return (abs(found["factor_of_safety"] / float(reference["clay"]) - 1) if good else 1.0), 0.05


def checks():
    """Name and (error, tolerance) of every check."""
    yield "strengths that are reduced", reduced()
    yield "the bracket of a threshold", bracketed()
    with tempfile.TemporaryDirectory() as folder:
        yield "a slope in clay against Bishop's method", of_clay(Path(folder))


if __name__ == "__main__":
    os.environ["OMP_NUM_THREADS"] = "1"
    sys.exit(report(checks()))
