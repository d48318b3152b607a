"""Holds the time that --check predicts against that of the run, and prints the table of solver/README.md.

    prediction_study.py DIR [CASE ...] [--repeat N] [--programs BUILD]

Five cases, both stages, one thread. Prediction and run follow each other and are repeated in turn; compared is the processor's
time, since other work on the machine takes from the wall's. Each of the ten ratios is the median of its repetitions.
"""
import argparse
import json
import os
import re
import statistics
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
CASES = ROOT / "cases"
LEVEL = """schema: seismpm-case/1
name: wide
grid: {spacing: 1 m, particles_per_cell: 2}
domain: {x: [0 m, 600 m], bottom: 0 m}
surfaces:
  rockhead: {points: [[0 m, 12 m]]}
  sand: {points: [[0 m, 20 m]]}
  ground: {points: [[0 m, 30 m]]}
regions:
  - {material: rock, below: rockhead}
  - {material: sand, below: sand}
  - {material: clay, below: ground}
materials:
  rock: {model: elastic, density: 2300 kg/m3, young_modulus: 800 MPa, poisson_ratio: 0.25}
  sand:
    model: mohr_coulomb
    density: 1900 kg/m3
    young_modulus: 120 MPa
    poisson_ratio: 0.3
    friction_angle: {peak: 35 deg}
    cohesion: {peak: 10 kPa}
  clay: {model: von_mises, density: 1700 kg/m3, young_modulus: 30 MPa, poisson_ratio: 0.4, strength: {peak: 60 kPa}}
seismic:
  duration: 8 s
  motion: {recorded_as: outcrop, horizontal: built_in, baseline: none}
output: {frames: {every: 1 s}, gauges: {points: {top: [300 m, 30 m]}}}
"""
STUDIED = {
    "first, 0.6 m": (CASES / "first/case.yaml", ["grid.spacing=0.6 m"]),
    "slope, 1 m": (CASES / "slope/case.yaml", ["grid.spacing=1 m", "seismic.duration=30 s"]),
    "slope, 0.625 m": (CASES / "slope/case.yaml", ["seismic.duration=9 s"]),
    "tsaoling, 12.5 m": (CASES / "tsaoling/case.yaml", ["grid.spacing=12.5 m", "seismic.duration=40 s",
                                                        "seismic.motion.horizontal=built_in", "seismic.motion.vertical=built_in"]),
    "wide, 1 m": (None, []),
}
UNITS = {"s": 1, "min": 60, "h": 3600, "d": 86400}


def seconds(text):
    """'1 min 50 s' in s."""
    return sum(float(value) * UNITS[unit] for value, unit in re.findall(r"([\d.e+-]+) (s|min|h|d)\b", text))


def run(*command):
    """Runs a program; what it says and its processor time in s."""
    before = os.times()
    done = subprocess.run([os.fspath(part) for part in command], check=True, stdout=subprocess.PIPE, text=True)
    after = os.times()
    return done.stdout, after.children_user + after.children_system - before.children_user - before.children_system


def predicted(said):
    """Time in s and steps that --check tells; of an undisturbed machine."""
    line = next(line for line in said.splitlines() if re.search(r"settled after|steps for", line))
    time = re.search(r"\((.*) undisturbed\)", line) or re.search(r".*about (.*) on \d+ threads", line)
    return seconds(time[1]), int(re.search(r"(\d+) steps", line)[1])


def steps_of(folder):
    """Steps that a run took."""
    return json.loads((folder / "summary.json").read_text())["steps"]


def studied(name, out, programs, repeat):
    """Rows of a case: (stage, predicted and measured times, predicted and taken steps)."""
    case, settings = STUDIED[name]
    folder = out / re.sub(r"\W+", "-", name)
    folder.mkdir(parents=True, exist_ok=True)
    if case is None:
        case = folder / "case.yaml"
        case.write_text(LEVEL)
    options = ["--threads", "1", *(word for setting in settings for word in ("--set", setting))]
    start = ["--from", folder / "static" / "final.h5"]
    for program, stage, own in (("mpm-static", "static", []), ("mpm-seismic", "seismic", start)):
        told, taken = [], []
        for _ in range(repeat):
            said, _ = run(programs / program, case, *own, *options, "--check")
            told.append(predicted(said))
            taken.append(run(programs / program, case, *own, *options, "--out", folder / stage, "--fresh", "--quiet")[1])
        yield stage, [time for time, _ in told], taken, told[0][1], steps_of(folder / stage)


def main():
    """Prints a row for each case and stage."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("cases", nargs="*", default=list(STUDIED))
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--programs", type=Path, default=ROOT / "build")
    arguments = parser.parse_args()
    print("| case | stage | steps, predicted | taken | time, predicted (s) | measured (s) | ratio |\n" + "| --- " * 7 + "|")
    for name in arguments.cases:
        for stage, told, taken, expected, steps in studied(name, arguments.out.resolve(), arguments.programs.resolve(), arguments.repeat):
            ratio = statistics.median(a / b for a, b in zip(told, taken))
            print(f"| {name} | {stage} | {expected} | {steps} | {statistics.median(told):.3g} | "
                  f"{statistics.median(taken):.3g} | {ratio:.2f} |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
