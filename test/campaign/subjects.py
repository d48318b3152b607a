"""What the campaign hurts: commands on a small case, each with what its folder holds before, and its results when it is left alone."""
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "test/atlas"))
import cases

CLAY = {"model": "von_mises", "density": 1800.0, "young_modulus": 40e6, "poisson_ratio": 0.35, "strength": {"peak": 50e3, "residual": 25e3},
        "softening": {"displacement": 0.1}}
USUAL = {"slope": 2, "soil": CLAY, "gravity": 9.81, "n": 2, "steps": 150, "pga": 20.0, "sides": "free_field", "gauges": True, "frames": 3}
OTHER = ["--set", "seismic.filter.time=2 s"]
ENV = {**os.environ, "OMP_WAIT_POLICY": "passive", "MPLBACKEND": "Agg"}


class Subject:
    """A command that writes into one folder."""

    def __init__(self, name, command, again=None, start=None, scripts=False):
        """`again`: the command after the first one was cut short; `start`: what the folder holds before; `scripts`: starts programs."""
        self.name, self.command, self.again, self.start, self.scripts = name, command, again or command, start, scripts
        self.changes = self.reads = 0  # calls of the file system when nothing befalls it
        self.seconds = 0.0


class Bench:
    """The folders: `hurt` holds case, static state and the folder `work` of what is at work; `whole` the results of each subject."""

    def __init__(self, out, build):
        """Makes the case and what the subjects start from."""
        self.out, self.build, self.hurt, self.work = out, build, out / "hurt", out / "hurt/work"
        self.faults = build / "libseismpm-faults.so"
        shutil.rmtree(out / "hurt", ignore_errors=True)
        for folder in ("hurt/case", "start", "whole", "said"):
            shutil.rmtree(out / folder, ignore_errors=True)
            (out / folder).mkdir(parents=True)
        for name, every in (("seldom", "1 h"), ("often", "1 ms")):
            built = cases.build(**USUAL, output={"checkpoint": {"every": every}})
            (self.hurt / "case" / f"{name}.yaml").write_text(built["case"])
        (self.hurt / "case/shake.txt").write_text(built["record"])
        self.install()
        self.subjects = {subject.name: subject for subject in self.make()}

    def install(self):
        """The scripts as they are installed: those of the tree build first."""
        prefix = self.out / "prefix"
        if not (prefix / "bin/seismpm").exists() or (prefix / "bin/mpm-static").stat().st_mtime < (self.build / "mpm-static").stat().st_mtime:
            shutil.rmtree(prefix, ignore_errors=True)
            subprocess.run(["cmake", "--install", self.build, "--prefix", prefix], check=True, stdout=subprocess.DEVNULL)
        self.seismpm = prefix / "bin/seismpm"

    def call(self, command, **environment):
        """(exit code, messages) of a command that nothing befalls."""
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, timeout=300,
                              env={**ENV, **environment}, cwd=self.hurt)
        return done.returncode, done.stdout + done.stderr

    def must(self, command, code=0, **environment):
        """Runs what has to end with a code."""
        ended, said = self.call(command, **environment)
        if ended != code:
            raise SystemExit(f"{' '.join(map(str, command))} ended with {ended} instead of {code}: {said}")

    def keep(self, folder, name):
        """Moves a folder to the starts."""
        shutil.move(folder, self.out / "start" / name)
        return self.out / "start" / name

    def make(self):
        """All subjects."""
        case, often, work, one = self.hurt / "case/seldom.yaml", self.hurt / "case/often.yaml", self.work, ["--threads", "1"]
        static = [self.build / "mpm-static", case, "--out", work, *one]
        self.must(static)
        shutil.move(work, self.hurt / "static")
        start = ["--from", self.hurt / "static/final.h5", "--out", work, *one]
        seismic = [self.build / "mpm-seismic", case, *start]
        yield Subject("static", static)
        yield Subject("static often", [self.build / "mpm-static", often, "--out", work, *one])
        yield Subject("seismic", seismic)
        yield Subject("seismic often", [self.build / "mpm-seismic", often, *start])
        self.must([*seismic, *OTHER])
        self.other = [*seismic, *OTHER]
        yield Subject("a new start", [*seismic, "--fresh"], start=self.keep(work, "other"))
        self.must([f"{seismic[0]}-faulty", *seismic[1:]], 75, PLANT="stop", PLANT_AT="70")
        yield Subject("going on", seismic, start=self.keep(work, "stopped"))
        self.must(seismic)
        for name in ("finished.json", "summary.json", "history.h5", "frames.hdf.series"):
            (work / name).unlink()
        yield Subject("the end", seismic, start=self.keep(work, "ended"))
        yield Subject("run", [self.seismpm, "run", case, "--out", work, *one], scripts=True)
        yield Subject("sweep", [self.seismpm, "sweep", case, "--out", work, "--scales", "1,0.5", "--jobs", "2"], scripts=True)
        yield Subject("uncertainty", [self.seismpm, "uncertainty", case, "--out", work, "--shifts", "0,0,0", "--bisections", "1", "--", *one], scripts=True)
        yield Subject("factor-of-safety", [self.seismpm, "factor-of-safety", case, "--out", work, "--tolerance", "0.5", *one], scripts=True)
        atlas = [sys.executable, ROOT / "test/atlas/atlas.py", "--out", work, "--only", "draws", "--draws", "6", "--build", self.build]
        yield Subject("atlas", atlas, scripts=True)

    def begin(self, subject):
        """The folder as it is before the subject's command."""
        shutil.rmtree(self.work, ignore_errors=True)
        if subject.start:
            shutil.copytree(subject.start, self.work)

    def learn(self, subject):
        """Runs a subject without a fault, counts its calls and keeps its results."""
        count = self.out / "count"
        for mode in ("read", "kill"):
            count.unlink(missing_ok=True)
            self.begin(subject)
            began = time.monotonic()
            self.must(subject.command, **self.fault(0, mode))
            subject.seconds = time.monotonic() - began
            calls = int.from_bytes(count.read_bytes(), sys.byteorder) if count.exists() else 0
            subject.reads, subject.changes = (calls, subject.changes) if mode == "read" else (subject.reads, calls)
        shutil.move(self.work, self.whole(subject))

    def whole(self, subject):
        """Where its results are kept."""
        return self.out / "whole" / subject.name.replace(" ", "-")

    def fault(self, at, mode):
        """The environment in which call `at` meets a fault."""
        return {"LD_PRELOAD": str(self.faults), "FAULT_FOLDER": str(self.hurt), "FAULT_AT": str(at), "FAULT_MODE": mode,
                "FAULT_COUNT": str(self.out / "count")}


def summary(lines):
    """A table of {what: {how it ended: number}} as text."""
    ends = sorted({end for row in lines.values() for end in row})
    return "\n".join(f"{what:44s} " + ", ".join(f"{row[end]} {end}" for end in ends if end in row) for what, row in lines.items())


def described(what):
    """A befalling in words."""
    return json.dumps(what, sort_keys=True)
