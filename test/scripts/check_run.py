"""Checks what scripts/run does with its options, on stubs of all that it calls; prints 'N passed, N failed'."""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from checking import report

ROOT = Path(__file__).resolve().parent.parent.parent
STUB = """#!/usr/bin/env bash
log=$(dirname -- "$0")/$(basename -- "$0").log
[ "${0##*/}" != cmake ] || log=$LOGS/cmake.log
printf '%s\\n' "$#" "$@" >>"$log"
case ${0##*/} in mpm-static) exit "${STATIC:-0}" ;; mpm-seismic) exit "${SEISMIC:-0}" ;; esac
"""


class Repository:
    """A repository with stubs for whatever scripts/run starts, and some files to start it with."""

    def __init__(self, folder):
        self.root = Path(folder) / "repository"
        (self.root / "scripts").mkdir(parents=True)
        for name in ("run", "options.sh", "find-programs"):
            shutil.copy(ROOT / "scripts" / name, self.root / "scripts" / name)
        for name in ("scripts/install-packages", "scripts/plot-run", "build/mpm-static", "build/mpm-seismic", "bin/cmake"):
            path = self.root / name
            path.parent.mkdir(exist_ok=True)
            path.write_text(STUB)
            path.chmod(0o755)
        for name in ("CMakeLists.txt", "cases/slope/case.yaml", "cases/slope/other.yaml", "cases/hill/case.yaml", "a/quake.AT2",
                     "b/quake.AT2", "my $case's/case.yaml"):
            path = self.root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(name)

    def run(self, *words, **environment):
        """Exit code, stderr and the calls of each program: lists of their arguments."""
        logs = {name: self.root / name for name in ("build/mpm-static.log", "build/mpm-seismic.log", "cmake.log",
                                                    "scripts/install-packages.log", "scripts/plot-run.log")}
        for log in logs.values():
            log.unlink(missing_ok=True)
        path = f"{self.root}/bin:{os.environ['PATH']}"
        done = subprocess.run([self.root / "scripts/run", *words], cwd=self.root, capture_output=True, text=True,
                              check=False, env={**os.environ, "PATH": path, "LOGS": str(self.root), **environment})
        return done.returncode, done.stderr, {Path(name).stem: calls(log) for name, log in logs.items()}

    def folders(self, *words):
        """Output folders of both stages, relative to run/."""
        code, said, called = self.run(*words)
        assert code == 0, said
        return tuple(os.path.relpath(after(called[stage][0], "--out"), self.root / "run")
                     for stage in ("mpm-static", "mpm-seismic"))


def calls(log):
    """Argument lists that a stub has noted."""
    lines = log.read_text().splitlines() if log.exists() else []
    found = []
    while lines:
        count = int(lines[0])
        found.append(lines[1:1 + count])
        lines = lines[1 + count:]
    return found


def after(words, option):
    """The value of an option."""
    return words[words.index(option) + 1]


def wrong(*claims):
    """Number of claims that do not hold, and the number that may."""
    return float(sum(not claim for claim in claims)), 0.0


def anywhere(repository):
    """Options before and behind the case; those of both stages to both, the motion's to the second."""
    _, _, called = repository.run("--threads", "2", "--motion", "a/quake.AT2", "cases/hill/case.yaml", "--set", "a=1",
                             "--scale=0.5", "--quiet", "--set=b=x y", "--profile", "quick", "--max-wall", "1 h")
    static, shaken = called["mpm-static"][0], called["mpm-seismic"][0]
    shared = ["--quiet", "--set", "a=1", "--set", "b=x y", "--profile", "quick", "--threads", "2", "--max-wall", "1 h"]
    case = str(repository.root / "cases/hill/case.yaml")
    return wrong(static == [case, "--out", after(static, "--out"), *shared],
                 shaken == [case, "--from", after(static, "--out") + "/final.h5", "--out", after(shaken, "--out"), *shared,
                            "--motion", "a/quake.AT2", "--scale", "0.5"],
                 len(called["plot-run"]) == 2, len(called["install-packages"]) == 1)


def names(repository):
    """Folders of cases and profiles, and --out."""
    _, _, called = repository.run("--out", "elsewhere")
    return wrong(repository.folders() == ("static", "slope"),
                 repository.folders("cases/slope/case.yaml") == ("static", "slope"),
                 repository.folders("cases/slope/other.yaml") == ("slope_other-static", "slope_other"),
                 repository.folders("cases/hill/case.yaml") == ("hill-static", "hill"),
                 repository.folders("--profile", "quick") == ("static-quick", "slope-quick"),
                 repository.folders("my $case's/case.yaml", "--profile", "a/b") == ("my $case's-static-a_b", "my $case's-a_b"),
                 repository.folders("--threads", "1", "--verbose") == ("static", "slope"),
                 after(called["mpm-static"][0], "--out") == "elsewhere/static",
                 after(called["mpm-seismic"][0], "--out") == "elsewhere/slope")


def others(repository):
    """Another motion, scale or setting has another folder; the same in other words has the same. The static state is
    shared by all that it does not depend on."""
    shaken = [repository.folders(*words) for words in (
        (), ("--motion", "a/quake.AT2"), ("--motion", "b/quake.AT2"), ("--vertical", "a/quake.AT2"), ("--scale", "2"),
        ("--motion", "a/quake.AT2", "--scale", "2"), ("--motion", "a/quake.AT2", "--record-dt", "0.1"),
        ("--motion", "a/quake.AT2", "--record-unit", "g"), ("--set", "seismic.duration=3 s"),
        ("--set", "seismic.duration=4 s"), ("--set", "grid.spacing=2 m"))]
    same = repository.folders("--scale", "2", f"--motion={repository.root}/a/quake.AT2")
    return wrong(len({folder for _, folder in shaken}) == len(shaken),
                 {folder for folder, _ in shaken[:-1]} == {"static"}, shaken[-1][0].startswith("static-"),
                 shaken[1][1].startswith("slope-quake-"), shaken[5][1].startswith("slope-quake-x2-"), same == shaken[5])


def refusals(repository):
    """Wrong options end with 64 before anything is installed or built, a file that is missing with 66."""
    found = []
    for words, code, part in (
            (("--motin", "a/quake.AT2"), 64, "did you mean '--motion'?"), (("--sclae", "2"), 64, "'--scale'"),
            (("cases/hill/case.yaml", "--treads=2"), 64, "'--threads'"), (("--zigzag",), 64, "no such option"),
            (("--scale", ""), 64, "empty"), (("--scale=",), 64, "empty"), (("--motion",), 64, "needs a value"),
            (("--motion", "--quiet"), 64, "looks like an option"), (("--profile", "a", "--profile", "b"), 64, "once"),
            (("--from", "x"), 64, "--from"), (("cases/hill/case.yaml", "cases/slope/case.yaml"), 64, "too many"),
            (("",), 64, "empty"), (("none.yaml",), 66, "none.yaml"), (("--motion", "none.AT2"), 66, "none.AT2"),
            (("--quiet=1",), 64, "no such option")):
        ended, said, called = repository.run(*words)
        good = ended == code and part in said and not any(called.values())
        if not good:
            print(words, ended, said)
        found.append(good)
    return wrong(*found)


def codes(repository):
    """Exit codes of the stages pass through, and nothing is started after one that failed."""
    found = []
    for code in ("64", "65", "73", "75", "80", "81"):
        ended, _, called = repository.run(STATIC=code)
        found.append(ended == int(code) and not called["mpm-seismic"] and not called["plot-run"])
        ended, _, called = repository.run(SEISMIC=code)
        found.append(ended == int(code) and len(called["mpm-static"]) == 1 and not called["plot-run"])
    return wrong(*found)


def checking(repository):
    """With --check both stages tell what they would do, and nothing is drawn."""
    code, _, called = repository.run("--check")
    state = repository.root / "run/static/final.h5"
    state.parent.mkdir(parents=True)
    state.touch()
    _, _, later = repository.run("--check")
    return wrong(code == 0, "--check" in called["mpm-static"][0], "--check" in called["mpm-seismic"][0],
                 not called["plot-run"], "--from" not in called["mpm-seismic"][0],
                 after(later["mpm-seismic"][0], "--from") == str(state))


def checks():
    """Name and (error, tolerance) of every check."""
    for check in (anywhere, names, others, refusals, codes, checking):
        with tempfile.TemporaryDirectory() as folder:
            yield check.__doc__.splitlines()[0], check(Repository(folder))


if __name__ == "__main__":
    sys.exit(report(checks()))
