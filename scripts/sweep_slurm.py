"""A sweep on Slurm: a job for each static state, an array of its runs that waits for it, and a last job for the summary."""
import getpass
import json
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from resolved_case import Refused
from sweep_plan import command_of_run, commands_of_static
from sweep_run import code_of, left
from whole_file import write_whole

SCRIPTS = Path(__file__).resolve().parent
JOB = SCRIPTS / "slurm" / "job.sbatch"
MOST_TASKS = 1000  # of an array: Slurm's MaxArraySize is 1001 unless the administrator says otherwise


def alive(out):
    """Ids of the sweep's jobs that wait or run."""
    path = Path(out) / "slurm" / "jobs.json"
    if not path.exists() or not shutil.which("squeue"):
        return []
    queued = subprocess.run(["squeue", "--noheader", "--user", getpass.getuser(), "--format", "%A %F"], capture_output=True,
                            text=True, check=False)
    if queued.returncode:
        raise Refused(queued.returncode, f"squeue: {queued.stderr.strip()}")
    return sorted(set(json.loads(path.read_text())) & set(queued.stdout.split()))


def refuse_while_alive(out):
    """Refuses to touch a sweep whose jobs wait or run."""
    jobs = alive(out)
    if jobs:
        raise Refused(73, f"{out}: its jobs {' '.join(jobs)} wait or run (squeue); let them end, or scancel them")


def submit(given, out, name, words, after=(), kind="afterok", at_once=""):
    """Submits a job of `words` for job.sbatch, to begin after other jobs; returns its id."""
    command = ["sbatch", "--parsable", f"--job-name={name}", "--kill-on-invalid-dep=yes", "--requeue", "--open-mode=append",
               f"--signal=B:USR1@{given.warn}", f"--output={out}/slurm/%x-%j.out", *shlex.split(given.sbatch)]
    if given.threads:
        command.append(f"--cpus-per-task={given.threads}")
    if after:
        command.append(f"--dependency={kind}:" + ":".join(after))
    if words[0] == "--line-of":
        command.append(f"--array=1-{len(Path(words[1]).read_text().splitlines())}{at_once}")
    done = subprocess.run([*command, str(JOB), *words], capture_output=True, text=True, check=False)
    if done.returncode:
        raise Refused(done.returncode, f"sbatch: {done.stderr.strip()}")
    return done.stdout.strip().split(";")[0]


def send(plan, out, given):
    """Submits what is left of a plan and prints the ids of the jobs."""
    if not shutil.which("sbatch"):
        raise Refused(66, "sbatch is missing: this machine is no part of a cluster with Slurm; leave --slurm out to run here")
    folder = Path(out).resolve() / "slurm"
    folder.mkdir(parents=True, exist_ok=True)
    jobs, ends = [], []

    def note(job, is_end):
        """Keeps the id of a job at once, so that an interrupted submission is known."""
        jobs.append(job)
        ends.extend([job] * is_end)
        write_whole(folder / "jobs.json", json.dumps(jobs) + "\n")
        return job

    out = Path(out).resolve()
    groups = {}
    for run in plan["runs"]:
        if left(command_of_run(plan, out, run)[0]):
            groups.setdefault(run["static"], []).append(run)
    for digest, runs in groups.items():
        after = []
        if digest and not (commands_of_static(plan, out, digest)[0] / "finished.json").exists():
            state, command = commands_of_static(plan, out, digest)
            if not left(state):
                print(f"sweep: static state {digest} ended with {code_of(state)}: {len(runs)} runs cannot begin; "
                      f"remove {state} to have it tried again", file=sys.stderr)
                continue
            after = [note(submit(given, out, f"static-{digest}", command), True)]
        for k in range(0, len(runs), MOST_TASKS):
            lines = folder / f"runs-{digest or 'all'}-{k // MOST_TASKS + 1}.txt"
            lines.write_text("".join(shlex.join(command_of_run(plan, out, run)[1]) + "\n" for run in runs[k:k + MOST_TASKS]))
            note(submit(given, out, f"runs-{digest or 'all'}", ["--line-of", str(lines)], after,
                        at_once=f"%{given.jobs}" if given.jobs else ""), True)
    last = note(submit(given, out, "summary", [str(SCRIPTS / "sweep-summary"), str(out), *shlex.split(given.summary)], ends, "afterany"),
                False)
    count = sum(len(runs) for runs in groups.values())
    print(f"sweep: {count} runs are left, submitted as jobs {' '.join(jobs[:-1]) or 'none'}; the summary is job {last}")
