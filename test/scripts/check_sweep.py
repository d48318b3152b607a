"""Checks what a sweep plans, runs, does after an interruption and sums up, with the built programs; prints 'N passed, N failed'."""
import argparse
import csv
import os
import re
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from time import monotonic, sleep

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import make_motion
import sweep_measures
import sweep_plan
from checking import report
from resolved_case import Refused

ROOT = Path(__file__).resolve().parent.parent.parent
PROGRAMS = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build"
CASE = ROOT / "cases" / "first" / "case.yaml"
COARSE = ["grid.spacing=2 m", "seismic.duration=20 s", "output.frames.every=20 s"]


def wrong(*claims):
    """Number of claims that do not hold, and the number that may."""
    return float(sum(not claim for claim in claims)), 0.0


def options(**given):
    """A command line of scripts/sweep."""
    usual = {"case": CASE, "records": [], "scales": [1.0], "start": None, "profiles": [], "set": COARSE[:1], "vary": [], "draw": [],
             "samples": 1, "seed": 1, "programs": PROGRAMS, "more": []}
    return argparse.Namespace(**{**usual, **given})


def refused(code, part, act):
    """Whether an act is refused with a code and words."""
    try:
        act()
    except Refused as reason:
        return reason.code == code and part in str(reason)
    return False


def planned(folder):
    """Records of a folder and of a table, each with each scale and variation; one static state for one ground."""
    for name in ("b.AT2", "a.AT2"):
        (folder / name).write_text("")
    table = folder / "t.csv"
    table.write_text("record,scale,name,dt,materials.clay.strength.peak\n# soft ground\na.AT2,2,soft,0.01,60 kPa\na.AT2,,,,\n")
    plan = sweep_plan.make(options(records=[table, folder / "b.AT2"], scales=[1.0, 0.5]))
    runs = {run["name"]: run for run in plan["runs"]}
    soft = next(run for name, run in runs.items() if name.startswith("soft-x2-"))
    varied = sweep_plan.make(options(vary=["seismic.duration=5 s; 6 s", "materials.clay.strength.peak=60 kPa;61 kPa"]))
    command = sweep_plan.command_of_run(plan, folder / "out", soft)[1]
    return wrong(len(runs) == 6, {"a", "a-x0.5", "b", "b-x0.5"} < set(runs), soft["scale"] == 2.0,
                 soft["settings"]["materials.clay.strength.peak"] == "60 kPa", soft["record_options"] == ["--record-dt", "0.01"],
                 len(plan["statics"]) == 2, soft["static"] != runs["a"]["static"], command[command.index("--scale") + 1] == "2",
                 len(varied["runs"]) == 4, len(varied["statics"]) == 2,
                 refused(65, "is none of", lambda: table.write_text("motion\na\n") and sweep_plan.read_table(table)),
                 refused(66, "no such", lambda: sweep_plan.make(options(records=["none"]))),
                 refused(66, "no such", lambda: sweep_plan.make(options(start=Path("none")))),
                 refused(65, "strenth", lambda: sweep_plan.make(options(set=["materials.clay.strenth.peak=1 kPa"]))),
                 refused(64, "KEY=VALUE", lambda: sweep_plan.make(options(set=["grid.spacing"]))))


def grown(folder):
    """A stored plan may grow; one with a run changed or gone is refused."""
    one, two = sweep_plan.make(options(scales=[1.0])), sweep_plan.make(options(scales=[0.5, 1.0]))
    sweep_plan.store(one, folder)
    return wrong([run["name"] for run in sweep_plan.store(two, folder)["runs"]] == ["case", "case-x0.5"],
                 refused(73, "case-x0.5", lambda: sweep_plan.store(one, folder)),
                 refused(73, "case", lambda: sweep_plan.store(sweep_plan.make(options(scales=[0.5, 1.0], set=["grid.spacing=1 m"])), folder)))


def drawn():
    """Samples have the median, the deviation and the range of their laws, and go by seed and number alone."""
    values = {law: np.array([float(sweep_plan.drawn(1, "a.b", law, k).split()[0]) for k in range(4000)])
              for law in ("lognormal(64 kPa, 0.2)", "normal(64 kPa, 6 kPa)", "uniform(50 kPa, 70 kPa)")}
    log, normal, uniform = (values[law] for law in values)
    first = [sweep_plan.drawn(7, "a.b", "normal(1, 0.1)", k) for k in (0, 1, 0)]
    error = max(abs(np.log(np.median(log) / 64)) / 0.2, abs(np.std(np.log(log)) / 0.2 - 1), abs(normal.mean() - 64) / 6,
                abs(normal.std() / 6 - 1), abs(uniform.mean() - 60) / 5.8)
    assert 50 <= uniform.min() and uniform.max() <= 70 and first[0] == first[2] != first[1]
    assert refused(64, "unit", lambda: sweep_plan.drawn(1, "a", "normal(64 kPa, 6)", 0))
    return error, 0.05  # three standard errors


def interrupted(folder):
    """A sweep that is stopped goes on, tells the record that is none, and runs nothing twice; its summary is whole."""
    (folder / "records").mkdir()
    for seed in (1, 2):
        (folder / "records" / f"seed{seed}.AT2").write_text(make_motion.at2(make_motion.motion(seed, 0.25), seed))
    (folder / "records" / "junk.AT2").write_text("no record\n")
    out = folder / "out"
    command = [str(ROOT / "scripts" / "sweep"), str(CASE), "--out", str(out), "--records", str(folder / "records"), "--programs",
               str(PROGRAMS), "--jobs", "1", "--scales", "0.5,1", "--summary=--newmark=none --limit displacement=2"]
    for setting in COARSE:
        command += ["--set", setting]
    begun = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    end = monotonic() + 60
    while not (out / "runs" / "seed1-x0.5" / "frames.hdf.series").exists() and monotonic() < end:
        sleep(0.05)
    begun.send_signal(signal.SIGTERM)
    said, _ = begun.communicate()
    stopped = (out / "runs" / "seed1-x0.5.exit").read_text().strip()
    second = subprocess.run(command, capture_output=True, text=True, check=False)
    marks = {path: path.stat().st_mtime_ns for path in out.glob("*/*/finished.json")}
    logs = {path: path.read_text() for path in out.glob("*/*/log.txt")}
    third = subprocess.run(command, capture_output=True, text=True, check=False)
    with open(out / "summary.csv", newline="") as file:
        rows = {row["run"]: row for row in csv.DictReader(file)}
    page = (out / "summary.html").read_text()
    with h5py.File(out / "summary.h5", "r") as file:
        stored = file["runs/pga"][...], file["runs/pga"].attrs["units"], file["runs/run"].asstr()[...]
    pga = {name: float(row["pga (g)"] or "nan") for name, row in rows.items()}
    return wrong(begun.returncode == 75, "the same command goes on" in said, stopped == "75", second.returncode == 65,
                 "junk: bad case, record or state: " in second.stderr, "no line of numbers" in second.stderr, third.returncode == 65,
                 len(marks) == 5, marks == {path: path.stat().st_mtime_ns for path in marks},
                 logs == {path: path.read_text() for path in logs}, len(rows) == 6, abs(pga["seed1"] - 2 * pga["seed1-x0.5"]) < 1e-4,
                 abs(pga["seed1"] - 0.25) < 1e-3, float(rows["seed1"]["displacement (m)"]) > 1, rows["junk"]["exit"] == "65",
                 not re.search(r"""(src|href)=["'](?!data:)""", page), page.count("data:image/png") == 2,
                 stored[1] == "g", stored[2][-1] == "seed2", abs(stored[0][-1] - 0.25) < 1e-3)


def scaled():
    """Intensities of a scaled motion."""
    known = {"pga": 1.0, "arias": 2.0, "d5_95": 3.0, "sa_0.5": 4.0}
    return wrong(sweep_measures.scaled(known, 0.5) == {"pga": 0.5, "arias": 0.5, "d5_95": 3.0, "sa_0.5": 2.0})


def checks():
    """Name and (error, tolerance) of every check."""
    for check in (planned, grown, interrupted):
        with tempfile.TemporaryDirectory() as folder:
            yield check.__doc__.splitlines()[0], check(Path(folder))
    yield "drawn parameters", drawn()
    yield "intensities of a scaled motion", scaled()


if __name__ == "__main__":
    os.environ["OMP_NUM_THREADS"] = "1"
    sys.exit(report(checks()))
