"""Checks a sweep on a real Slurm (slurm_cluster.py), or says why it was skipped; prints 'N passed, N failed'.

A sweep goes through what a cluster does to its jobs: a job of a better partition takes its nodes, and one of them dies. What comes out
equals a run on this machine, bit for bit. A run that is submitted by hand comes to its time limit, goes on, and is cancelled.
"""
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py
import numpy as np

from checking import report
from slurm_cluster import Cluster, Unavailable, wait_for

ROOT = Path(__file__).resolve().parent.parent.parent
PROGRAMS = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build"
CASE = ROOT / "cases" / "first" / "case.yaml"
JOB = ROOT / "scripts" / "slurm" / "job.sbatch"
SETTINGS = ["grid.spacing=2 m", "output.frames.every=10000 s", "output.checkpoint.every=1 s"]
# Slurm counts in minutes, looks every 30 s, and warns a job that it might not find in time otherwise: at its first look.
LIMIT = ["--time=1", "--signal=B:USR1@50"]
LONG = 11  # s, that a run of the sweep takes: some 4 until it is preempted, and a rest


def sweep(folder, *words):
    """scripts/sweep of three records, one of which is none; what it says."""
    command = [ROOT / "scripts" / "sweep", CASE, "--out", folder / "sweep", "--programs", PROGRAMS, "--records", folder / "records"]
    for setting in SETTINGS:
        command += ["--set", setting]
    return subprocess.run([str(word) for word in [*command, "--summary=--newmark=none --bootstrap=0", *words]], capture_output=True,
                          text=True, check=False)


def make_records(folder):
    """Two motions and a file that is no record."""
    (folder / "records").mkdir()
    for name, seed in (("a", 1), ("b", 2)):
        subprocess.run([sys.executable, str(ROOT / "scripts" / "make_motion.py"), "--seed", str(seed), "--out",
                        str(folder / "records" / f"{name}.AT2")], check=True, capture_output=True)
    (folder / "records" / "junk.AT2").write_text("no record\n")


def be_long(folder):
    """Sets the duration of the runs to what this machine does in about LONG seconds."""
    tried = folder / "tried"
    words = ["--set", SETTINGS[0], "--quiet"]
    for command in (["mpm-static", CASE, "--out", tried / "static"],
                    ["mpm-seismic", CASE, "--out", tried / "run", "--from", tried / "static" / "final.h5", "--max-wall", "2s",
                     "--set", "seismic.duration=1000 s"]):
        subprocess.run([str(word) for word in [PROGRAMS / command[0], *command[1:], *words]], check=False, capture_output=True)
    reached = json.loads((tried / "run" / "summary.json").read_text())["time"]
    SETTINGS.append(f"seismic.duration={0.5 * LONG * reached:.0f} s")


def by_hand(folder):
    """Submits a run that would take minutes to a node of its own, as one does without scripts/sweep; its id."""
    words = [JOB, PROGRAMS / "mpm-seismic", CASE, "--out", folder / "by-hand", "--from", folder / "tried" / "static" / "final.h5",
             "--set", SETTINGS[0], "--set", SETTINGS[1], "--set", "seismic.duration=9000 s"]
    done = subprocess.run(["sbatch", "--parsable", "--partition=apart", "--output=/dev/null", *LIMIT, *map(str, words)],
                          capture_output=True, text=True, check=True)
    return done.stdout.strip()


def log_of(run):
    """The log of a run."""
    path = run / "log.txt"
    return path.read_text() if path.exists() else ""


def starts(run):
    """How often a run was started."""
    return log_of(run).count("mpm-seismic ")


def stops(run):
    """How often it was told to stop, and did."""
    return log_of(run).count("the same command goes on")


def checkpointed(run):
    """Whether a run has left a checkpoint."""
    return any(run.glob("checkpoint-*.h5"))


def live_through(folder, cluster):
    """Submits the sweep and does to it what clusters do; what was seen on the way."""
    a, b = (folder / "sweep" / "runs" / name for name in "ab")
    job = by_hand(folder)
    seen = {"submitted": sweep(folder, "--slurm"), "twice": sweep(folder, "--slurm")}
    wait_for(lambda: checkpointed(a) and checkpointed(b), 60, "two runs on the way")
    subprocess.run(["sbatch", "--partition=high", "--exclusive", "--nodes=2", "--output=/dev/null", "--wrap", "sleep 1"], check=True,
                   capture_output=True)
    wait_for(lambda: starts(a) >= 2 and checkpointed(a), 60, "run a goes on")
    wait_for(lambda: "RUNNING" in cluster.ask("squeue", "-h", "-w", "n1", "-o", "%T"), 60, "a job on n1")
    cluster.kill_node("n1")
    wait_for(lambda: "goes on from" in log_of(folder / "by-hand"), 60, "the run by hand goes on")
    time.sleep(1.0)  # into its steps
    subprocess.run(["scancel", job], check=True)
    wait_for(lambda: (folder / "sweep" / "summary.csv").exists() and not cluster.ask("squeue", "-h", "-o", "%i"), 90, "the summary")
    return seen


def same(folder, name):
    """Greatest difference in the particles of a run on the cluster and one that nothing has happened to."""
    command = [PROGRAMS / "mpm-seismic", CASE, "--out", folder / "here" / name, "--quiet", "--motion", folder / "records" / f"{name}.AT2",
               "--from", next((folder / "sweep" / "static").glob("*/final.h5"))]
    for setting in SETTINGS:
        command += ["--set", setting]
    subprocess.run([str(word) for word in command], check=True, capture_output=True)
    states = []
    for run in (folder / "here" / name, folder / "sweep" / "runs" / name):
        with h5py.File(run / "final.h5", "r") as file:
            states.append(np.concatenate([file[f"particles/{field}"][...].ravel() for field in ("position", "velocity", "stress")]))
    return float(np.abs(states[0] - states[1]).max()), 0.0


def count(*claims):
    """Number of claims that do not hold, and the number that may."""
    return float(sum(not claim for claim in claims)), 0.0


def checks():
    """Name and (error, tolerance) of every check."""
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as path:
        folder = Path(path)
        with Cluster() as cluster:
            print(f"Slurm is up after {time.monotonic() - began:.1f} s", flush=True)
            make_records(folder)
            be_long(folder)
            seen = live_through(folder, cluster)
            yield "a sweep is submitted", count(seen["submitted"].returncode == 0, "3 runs are left" in seen["submitted"].stdout)
            yield "not while its jobs wait or run", count(seen["twice"].returncode == 73, "squeue" in seen["twice"].stderr)
            table = (folder / "sweep" / "summary.csv").read_text()
            yield "two runs are done, and the one without a record is told", count(table.count(",0,done,") == 2,
                                                                                  ",65," in table, "not a record" in table)
            runs = [folder / "sweep" / "runs" / name for name in "ab"]
            yield "they were preempted, and went on", count(*(starts(run) >= 2 and stops(run) >= 1 for run in runs))
            yield "one lost its node, and went on", count(any(starts(run) > stops(run) + 1 for run in runs))
            alone = folder / "by-hand"
            yield "a run by hand stopped before its time limit, went on, and ended when it was cancelled", count(
                starts(alone) == 2, stops(alone) == 2, alone.with_name("by-hand.exit").read_text() == "75\n")
            again = sweep(folder, "--slurm")
            yield "what is done is not submitted again", count("1 runs are left" in again.stdout)
        yield "as if nothing had happened", same(folder, "a")
    print(f"{time.monotonic() - began:.0f} s")


if __name__ == "__main__":
    os.environ["OMP_NUM_THREADS"] = "1"
    try:
        sys.exit(report(checks()))
    except Unavailable as reason:
        print(f"skipped: {reason}")
