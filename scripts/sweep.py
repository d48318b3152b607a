"""Shakes a slope with many records, scale factors and variations of its case, here or on Slurm, and sums up.

    scripts/sweep CASE --out DIR --records FOLDER|TABLE.csv|RECORD ... [--scales 0.5,1,2] [--profiles a,b]
                  [--set KEY=VALUE] [--vary 'KEY=V1; V2'] [--draw 'KEY=lognormal(64 kPa, 0.1)' --samples N --seed N]
                  [--jobs N] [--slurm --sbatch='--time=2:00:00'] [-- options of both programs]

Every record with every factor, profile, value of --vary and sample of --draw. Static states go to DIR/static, one for all runs
of the same ground, runs to DIR/runs/NAME, the summary to DIR. Repeated, the command goes on where it was interrupted and runs
nothing twice; more records or factors are added to what is there. A run that fails is told, and the others go on. Exit code: 75
when it was interrupted, otherwise that of the first run that failed.
"""
import argparse
import fcntl
import os
import shlex
import sys
from pathlib import Path

import sweep_plan
import sweep_run
import sweep_slurm
from options import Parser
from programs import PROGRAMS
from resolved_case import Refused


def numbers(words):
    """The numbers of a list with commas."""
    return [float(word) for word in words.split(",")]


def whole(word):
    """A whole number above 0."""
    if int(word) < 1:
        raise ValueError
    return int(word)


def parse_arguments(given):
    """The command line, with what follows a lone -- as options of both programs."""
    cut = given.index("--") if "--" in given else len(given)
    parser = Parser(prog="sweep", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", type=Path)
    parser.add_argument("--out", type=Path, required=True, metavar="DIR")
    parser.add_argument("--records", nargs="+", default=[], metavar="PATH", help="folders, tables and records; default: the case's own")
    parser.add_argument("--scales", type=numbers, default=[1.0], metavar="F,F", help="factors on every record; default 1")
    parser.add_argument("--from", dest="start", type=Path, metavar="STATIC/final.h5", help="of mpm-static, if it is there already")
    parser.add_argument("--profiles", type=lambda names: names.split(","), default=[], metavar="a,b", help="default: the case as it is")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="of all runs; repeatable")
    parser.add_argument("--vary", action="append", default=[], metavar="'KEY=V1; V2'", help="each value in turn; repeatable")
    parser.add_argument("--draw", action="append", default=[], metavar="KEY=LAW",
                        help="normal(64 kPa, 6 kPa), lognormal(MEDIAN, log. deviation) or uniform(50 kPa, 70 kPa); repeatable")
    parser.add_argument("--samples", type=whole, default=1, metavar="N", help="how many samples of --draw; default 1")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of --draw; default 1")
    parser.add_argument("--jobs", type=whole, metavar="N",
                        help="runs at the same time; default here: one for each processor, on Slurm: no limit")
    parser.add_argument("--threads", type=whole, metavar="N", help="of each run; default here 1, on Slurm as the job has")
    parser.add_argument("--list", action="store_true", help="prints the commands, one a line; runs nothing")
    parser.add_argument("--summary", default="", metavar="'OPTIONS'", help="for scripts/sweep-summary, in quotes")
    parser.add_argument("--slurm", action="store_true", help="submits to Slurm instead")
    parser.add_argument("--sbatch", default="", metavar="'OPTIONS'", help="for sbatch, in quotes")
    parser.add_argument("--warn", type=whole, default=120, metavar="S", help="stops so long before Slurm's time limit; default 120 s")
    parser.add_argument("--programs", type=Path, default=PROGRAMS, metavar="DIR", help="their folder; default: of the build, or installed")
    arguments = parser.parse_args(given[:cut])
    arguments.more = given[cut + 1:]
    if arguments.draw and arguments.samples < 1 or not arguments.draw and arguments.samples > 1:
        parser.error("--samples needs --draw")
    return arguments


def list_commands(plan, out):
    """Prints every command, static states first."""
    for digest in plan["statics"]:
        print(shlex.join(sweep_plan.commands_of_static(plan, out, digest)[1]))
    for run in plan["runs"]:
        print(shlex.join(sweep_plan.command_of_run(plan, out, run)[1]))


def run_here(plan, given):
    """Runs what is left on this machine and sums up; returns the exit code."""
    from sweep_summary import summarise  # matplotlib takes its time
    jobs = given.jobs or len(os.sched_getaffinity(0))
    interrupted = sweep_run.work(plan, given.out, jobs, given.threads or 1)
    if interrupted:
        print("sweep: interrupted; the same command goes on", file=sys.stderr)
        return sweep_run.INTERRUPTED
    return summarise([str(given.out), *shlex.split(given.summary)])


def main():
    """Plans, then runs, submits or lists; returns the exit code."""
    given = parse_arguments(sys.argv[1:])
    try:
        plan = sweep_plan.make(given)
        if given.list:
            list_commands(plan, given.out)
            return 0
        sweep_slurm.refuse_while_alive(given.out)
        given.out.mkdir(parents=True, exist_ok=True)
        with open(given.out / ".lock", "w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise Refused(73, f"{given.out}: another scripts/sweep is at work there; let it end") from None
            plan = sweep_plan.store(plan, given.out)
            if given.slurm:
                sweep_slurm.send(plan, given.out, given)
                return 0
            return run_here(plan, given)
    except Refused as reason:
        print(f"sweep: {reason}", file=sys.stderr)
        return reason.code
    except OSError as reason:
        print(f"sweep: {reason}", file=sys.stderr)
        return 74 if given.out.exists() else 66


if __name__ == "__main__":
    sys.exit(main())
