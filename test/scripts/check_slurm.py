"""Checks a sweep on a real Slurm (slurm_cluster.py), or says why it was skipped; prints 'N passed, N failed'.

One sweep goes through all that a cluster does to a job: a job of a better partition takes its nodes, one of them dies, and its runs
take longer than the time limit gives them. What comes out equals a run on this machine, bit for bit.
"""
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
SETTINGS = ["grid.spacing=2 m", "seismic.duration=90 s", "output.frames.every=90 s", "output.checkpoint.every=1 s"]
LIMIT = ["--sbatch=--time=1", "--warn=54"]  # Slurm counts in minutes: warned 6 s after the start, at the latest


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


def log_of(folder, name):
    """The log of a run."""
    path = folder / "sweep" / "runs" / name / "log.txt"
    return path.read_text() if path.exists() else ""


def starts(folder, name):
    """How often a run was started."""
    return log_of(folder, name).count("mpm-seismic ")


def stops(folder, name):
    """How often it was told to stop, and did: by the job that took its node, and before the time limit."""
    return log_of(folder, name).count("the same command goes on")


def checkpointed(folder, name):
    """Whether a run has left a checkpoint."""
    return any((folder / "sweep" / "runs" / name).glob("checkpoint-*.h5"))


def live_through(folder, cluster):
    """Submits the sweep and does to it what clusters do; what was seen on the way."""
    seen = {"submitted": sweep(folder, "--slurm", *LIMIT)}
    seen["twice"] = sweep(folder, "--slurm", *LIMIT)
    wait_for(lambda: checkpointed(folder, "a") and checkpointed(folder, "b"), 60, "two runs on the way")
    subprocess.run(["sbatch", "--partition=high", "--exclusive", "--nodes=2", "--output=/dev/null", "--wrap", "sleep 1"], check=True,
                   capture_output=True)
    wait_for(lambda: starts(folder, "a") >= 2 and checkpointed(folder, "a"), 60, "run a goes on")
    wait_for(lambda: "RUNNING" in cluster.ask("squeue", "-h", "-w", "n1", "-o", "%T"), 60, "a job on n1")
    seen["lost"] = cluster.ask("squeue", "-h", "-w", "n1", "-o", "%j %K")
    cluster.kill_node("n1")
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
        make_records(folder)
        with Cluster() as cluster:
            print(f"Slurm is up after {time.monotonic() - began:.1f} s", flush=True)
            seen = live_through(folder, cluster)
            yield "a sweep is submitted", count(seen["submitted"].returncode == 0, "3 runs are left" in seen["submitted"].stdout)
            yield "not while its jobs wait or run", count(seen["twice"].returncode == 73, "squeue" in seen["twice"].stderr)
            table = (folder / "sweep" / "summary.csv").read_text()
            yield "two runs are done, and the one without a record is told", count(table.count(",0,done,") == 2,
                                                                                  ",65," in table, "not a record" in table)
            yield "they were preempted, and went on", count(*(starts(folder, name) >= 2 and stops(folder, name) >= 1 for name in "ab"))
            yield "one lost its node, and went on", count(any(starts(folder, name) > stops(folder, name) + 1 for name in "ab"),
                                                          seen["lost"] != "")
            yield "and stopped before their time limit, and went on", count(any(stops(folder, name) >= 2 for name in "ab"))
            again = sweep(folder, "--slurm", *LIMIT)
            yield "what is done is not submitted again", count("1 runs are left" in again.stdout)
        yield "as if nothing had happened", same(folder, "a")
    print(f"{time.monotonic() - began:.0f} s")


if __name__ == "__main__":
    os.environ["OMP_NUM_THREADS"] = "1"
    try:
        sys.exit(report(checks()))
    except Unavailable as reason:
        print(f"skipped: {reason}")
