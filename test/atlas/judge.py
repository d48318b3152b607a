"""Runs a small case through the two programs and judges how it ended.

Every run ends as one of ENDS; *grew* (grows and was not caught) and *broke* (a crash, a hang, a bug, or values that are no
numbers in a result) are failures of the programs.
"""
import json
import os
import subprocess
import tempfile
from pathlib import Path

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

import h5py
import numpy as np

ENDS = {
    "stable": "stable",
    "damped": "too much damping",
    "caught": "grows and was caught",
    "grew": "grows and was not caught",
    "refused": "refused before the first step",
    "restless": "does not come to rest under gravity (81)",
    "broke": "crash, hang or no numbers",
}
FAILURES = ("grew", "broke")
TIMEOUT = 120  # s; the longest of these runs takes a few
GROWN = 0.05   # of what was there and came in; what has come from nowhere beyond it has grown, unless the run warns that
GROWN_WARNED = 0.1  # its energy balance does not close: then this, at which the programs end it
DAMPED = 0.2   # of the energy that came in, taken by the transfers: a tenth of a wave's amplitude
FAST = 30      # times the speed that the motion and gravity can give ground


def finite(path):
    """Name of the first dataset of a state with a value that is no finite number; None where all are."""
    found = []

    def look(name, item):
        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and not found:
            state = {"particles", "materials", "energy"} & set(name.split("/")[:3])
            if state and not np.isfinite(item[...]).all():
                found.append(name)

    with h5py.File(path, "r") as file:
        file.visititems(look)
    return found[0] if found else None


def greatest_speed(path):
    """Of the particles of a state, m/s, and a millionth of the elastic energy that gravity had stored, J/m: none."""
    with h5py.File(path, "r") as file:
        velocity, stored = file["particles/velocity"][...], float(np.ravel(file["energy/opening_elastic"])[0])
    return float(np.sqrt((velocity ** 2).sum(axis=1)).max()) if len(velocity) else 0.0, 1e-6 * stored


def last_error(said):
    """The line of a program's messages that tells why it ended."""
    lines = [line for line in said.splitlines() if line.strip()]
    errors = [line for line in lines if "error" in line.lower()]
    return (errors or lines or [""])[-1].strip()[:400]


def call(program, arguments, env):
    """(exit code, messages) of a program; None as code when it hangs."""
    try:
        done = subprocess.run([str(program), *map(str, arguments)], capture_output=True, text=True, timeout=TIMEOUT, check=False,
                              env={**os.environ, "OMP_NUM_THREADS": "1", **env})
    except subprocess.TimeoutExpired:
        return None, f"{program.name}: no end within {TIMEOUT} s"
    return done.returncode, done.stderr + done.stdout


def judge_end(code, said):
    """What an exit code other than 0 is."""
    if code == 80:
        named = "particle " in said and " at x = " in said and " steps" in said
        return "caught" if named else "broke"
    if code in (65, 64, 66):
        return "refused"
    return "restless" if code == 81 else "broke"


def judge_state(folder, speed):
    """(end, measures) of a seismic run that ended with 0; `speed`: what motion and gravity can give the ground, m/s."""
    summary = json.loads((folder / "summary.json").read_text())
    hurt = finite(folder / "final.h5")
    if hurt:
        return "broke", {"why": f"{hurt} is not finite"}
    e = summary["energy"]
    grown = (e["kinetic"] + e["elastic"] + e["gravitational"] + e["departed"] - e["incoming"] - e["static_reaction"]
             - e["free_field"])
    fastest, negligible = greatest_speed(folder / "final.h5")
    sources = max(e["incoming"], abs(e["free_field"]), abs(e["gravitational"] - e["static_reaction"]), negligible, 1e-300)
    measures = {"grown": grown / sources, "taken": e["transfer"] / sources, "speed": fastest / max(speed, 1e-300),
                "residual": e["residual"] / sources, "steps": summary["steps"], "warnings": len(summary["warnings"])}
    warned = any("energy balance does not close" in text for text in summary["warnings"])
    if grown > (GROWN_WARNED if warned else GROWN) * sources + negligible or fastest > FAST * speed:
        return "grew", measures
    return ("damped" if e["transfer"] > DAMPED * sources else "stable"), measures


def run(programs, case, record, speed, factor=1.0):
    """Runs both stages, or the second alone where there is no gravity; {end, code, stage, said, measures}.

    `factor` makes the steps of the seismic stage so many times as long as the case says, by the programs with planted faults.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "case.yaml").write_text(case)
        (folder / "shake.txt").write_text(record)
        start = []
        if '"gravity": "0.0 m/s2"' not in case:
            code, said = call(programs / "mpm-static", [folder / "case.yaml", "--out", folder / "static", "--threads", "1"], {})
            if code != 0:
                return {"end": judge_end(code, said), "code": code, "stage": "static", "said": last_error(said)}
            if finite(folder / "static/final.h5"):
                return {"end": "broke", "code": 0, "stage": "static", "said": "the static state holds values that are no numbers"}
            start = ["--from", folder / "static/final.h5"]
        longer = {"PLANT": "step", "PLANT_AT": "0", "PLANT_BY": repr(factor)} if factor != 1 else {}
        program = programs / ("mpm-seismic-faulty" if longer else "mpm-seismic")
        code, said = call(program, [folder / "case.yaml", "--out", folder / "run", "--threads", "1", *start], longer)
        if code != 0:
            return {"end": judge_end(code, said), "code": code, "stage": "seismic", "said": last_error(said)}
        end, measures = judge_state(folder / "run", speed)
        return {"end": end, "code": 0, "stage": "seismic", "said": "", "measures": measures}
