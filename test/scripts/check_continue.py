"""Draws small cases at random, stops each in both stages at steps drawn too, and goes on with other numbers of threads: all results
have to be those of a run that was left alone, bit for bit.

    check_continue.py [BUILD] [--draws N] [--first N]     300 draws take some 10 minutes
    check_continue.py [BUILD] --draw N --out DIR          one draw alone, whose case, record and results stay in DIR
"""
import argparse
import json
import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "test/atlas"), str(ROOT / "test/campaign")]
import cases
import checking
import draws
import same

STOPPED = 75
ENV = {**os.environ, "OMP_WAIT_POLICY": "passive"}  # more threads than processors, perhaps


def call(program, arguments, threads, stop_at=None):
    """(exit code, messages) of a program, which a signal stops in a step of its own where one is given."""
    plant = {"PLANT": "stop", "PLANT_AT": str(stop_at)} if stop_at is not None else {}
    done = subprocess.run([f"{program}-faulty" if plant else program, *arguments, "--threads", str(threads)], capture_output=True, text=True,
                          check=False, timeout=300, env={**ENV, **plant})
    return done.returncode, done.stdout + done.stderr


def compare(program, arguments, whole, other, rng):
    """Runs one stage whole and in pieces; (its exit code, what differs in words, steps at which it was stopped)."""
    code, said = call(program, [*arguments, "--out", whole], rng.choice([1, 2]))
    if not (whole / "summary.json").exists():  # refused before the first step
        return code, "", []
    steps = json.loads((whole / "summary.json").read_text())["steps"]
    stops = sorted(rng.sample(range(steps), min(steps, rng.choice([1, 1, 2, 3]))))
    done = 0
    for stop in stops:
        stopped, told = call(program, [*arguments, "--out", other], rng.choice([1, 2, 3]), stop - done)
        done = stop + 1
        if done == steps and stopped == code:  # the ground settled in that very step
            break
        if stopped != STOPPED:
            return code, f"ended with {stopped} when it was to be stopped after {done} of {steps} steps: {told}", stops
    again, told = call(program, [*arguments, "--out", other], rng.choice([1, 2, 3]))
    if again != code:
        return code, f"ended with {again} instead of {code}, after stops at {stops} of {steps} steps: {said}\n{told}", stops
    for path in [*whole.glob("checkpoint-*"), *other.glob("checkpoint-*")]:  # of a run that diverged: as many as were due
        path.unlink()
    return code, "; ".join(same.differences(whole, other)), stops


def run(number, programs, folder):
    """Both stages of a draw; {exit codes, stops, difference, case}."""
    built, rng = cases.build(**draws.draw_to_stop(number)), random.Random(number)
    (folder / "case.yaml").write_text(built["case"])
    (folder / "shake.txt").write_text(built["record"])
    result, start = {"number": number, "codes": [], "stops": [], "difference": "", "case": built["case"]}, []
    stages = [("mpm-static", "static"), ("mpm-seismic", "seismic")] if '"gravity": "0.0 m/s2"' not in built["case"] else [("mpm-seismic", "seismic")]
    for program, name in stages:
        code, what, stops = compare(programs / program, [folder / "case.yaml", *start], folder / name, folder / f"{name}-stopped", rng)
        result["codes"].append(code)
        result["stops"].append(stops)
        if what:
            result["difference"] = f"{program}, stopped at {stops}: {what}"
        if what or code != 0:
            break
        start = ["--from", folder / "static/final.h5"]
    return result


def checks(given):
    """All checks."""
    found = []
    for number in range(given.first, given.first + given.draws):
        with tempfile.TemporaryDirectory() as folder:
            found.append(run(number, given.build, Path(folder)))
        if found[-1]["difference"]:
            print(f"draw {number}: {found[-1]['difference']}\n{found[-1]['case']}", flush=True)
    bad = [str(r["number"]) for r in found if r["difference"]]
    stops = sum(len(of_stage) for r in found for of_stage in r["stops"])
    yield f"{given.draws} draws, stopped {stops} times, end as if they had not been {' '.join(bad)}", (len(bad), 0)
    ended = [r["codes"][-1] for r in found]
    yield ("two thirds of them run to their end: " + ", ".join(f"{ended.count(c)} with {c}" for c in sorted(set(ended))),
           (sum(code != 0 for code in ended) / len(found), 1 / 3))


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, nargs="?", default=ROOT / "build")
    parser.add_argument("--draws", type=int, default=12)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--draw", type=int)
    parser.add_argument("--out", type=Path)
    given = parser.parse_args()
    given.build = given.build.resolve()
    if given.draw is None:
        return checking.report(checks(given))
    given.out.mkdir(parents=True)
    result = run(given.draw, given.build, given.out.resolve())
    print(result["difference"] or f"the same, after stops at {result['stops']}; exit codes {result['codes']}")
    return 1 if result["difference"] else 0


if __name__ == "__main__":
    sys.exit(main())
