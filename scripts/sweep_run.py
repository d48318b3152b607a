"""How far the runs of a sweep are, and running what is left with a bounded number of processes.

Beside the folder FOLDER of a run or static state stand FOLDER.exit, the exit code of its last command, and FOLDER.err, what
that said. scripts/slurm/job.sbatch writes the same, so that it is all one where a run was done.
"""
import os
import signal
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

from sweep_plan import command_of_run, commands_of_static
from whole_file import write_whole

INTERRUPTED = 75
NOT_AGAIN = (80, 81)  # the same would come out: diverged, did not settle
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1, signal.SIGUSR2, signal.SIGXCPU)
WORDS = {0: "done", 64: "wrong command", 65: "bad case, record or state", 66: "an input is missing", 70: "a bug of the program",
         73: "its folder is taken", 74: "a write failed", 75: "interrupted", 80: "diverged", 81: "the static state did not settle",
         None: "not run"}


def beside(folder, ending):
    """FOLDER.ending."""
    return folder.with_name(folder.name + ending)


def code_of(folder):
    """Exit code of the last command of a folder; 0 once it is finished, None where nothing has ended yet."""
    if (folder / "finished.json").exists():
        return 0
    try:
        return int(beside(folder, ".exit").read_text())
    except (OSError, ValueError):
        return None


def words_of(code):
    """An exit code in words."""
    return WORDS.get(code) or (f"killed by signal {code - 128}" if code > 128 else f"ended with {code}")


def reason_of(folder):
    """The last error that a command of the folder told, in one line; empty without one."""
    try:
        lines = [line.strip() for line in beside(folder, ".err").read_text(errors="replace").splitlines() if line.strip()]
    except OSError:
        return ""
    errors = [line for line in lines if "error" in line.lower()]
    return (errors or lines or [""])[-1]


def left(folder):
    """Whether a folder has to be run: it is neither finished nor has it ended in a way that would come again."""
    code = code_of(folder)
    return code is None or code not in (0, *NOT_AGAIN) or (code in NOT_AGAIN and not folder.exists())


class Pool:
    """A context in which commands run, side by side if need be; a signal ends all that run with a checkpoint, and starts no other."""

    def __init__(self, threads=""):
        """threads: of each command, as text; empty: as the environment says."""
        self.environment = {**os.environ, "OMP_NUM_THREADS": str(threads)} if threads else None
        self.running, self.stopped, self.lock = set(), False, threading.RLock()

    def __enter__(self):
        """Takes the signals that are not ignored, as SIGHUP is under nohup."""
        self.before = {number: signal.signal(number, self.stop) for number in SIGNALS if signal.getsignal(number) is not signal.SIG_IGN}
        return self

    def __exit__(self, *_):
        """Gives them back."""
        for number, handler in self.before.items():
            signal.signal(number, handler)

    def stop(self, *_):
        """Handler of a signal."""
        with self.lock:
            self.stopped = True
            for process in self.running:
                process.send_signal(signal.SIGTERM)

    def run(self, folder, command):
        """Runs a command and notes its exit code and words; returns the code."""
        folder.parent.mkdir(parents=True, exist_ok=True)
        beside(folder, ".exit").unlink(missing_ok=True)
        with open(beside(folder, ".err"), "wb") as said:
            with self.lock:
                if self.stopped:
                    return INTERRUPTED
                process = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=said, stderr=said,
                                           env=self.environment)
                self.running.add(process)
                if self.stopped:  # just now, by a signal to this very thread
                    process.send_signal(signal.SIGTERM)
            code = process.wait()
        with self.lock:
            self.running.discard(process)
        code = code if code >= 0 else 128 - code
        write_whole(beside(folder, ".exit"), f"{code}\n")
        return code


def tell(what, folder, code):
    """One line of progress: how a command has ended."""
    reason = f": {reason_of(folder)}" if code else ""
    print(f"sweep: {what}: {words_of(code)}{reason}", file=sys.stderr, flush=True)


def work(plan, out, jobs, threads):
    """Runs what is left of the plan, static states before the runs that need them; returns whether it was interrupted."""
    with Pool(threads) as pool:
        work_in(pool, plan, out, jobs)
    return pool.stopped


def work_in(pool, plan, out, jobs):
    """What `work` does, in a pool, `jobs` commands at a time."""
    count, done = len(plan["runs"]), 0

    def state(digest):
        """Exit code of a static state, computed if need be."""
        folder, command = commands_of_static(plan, out, digest)
        code = pool.run(folder, command) if left(folder) else code_of(folder)
        if code and not pool.stopped:
            tell(f"static state {digest}", folder, code)
        return code

    def shake(run):
        """Runs one, after its static state; one whose static state has failed is told with that."""
        nonlocal done
        folder, command = command_of_run(plan, out, run)
        if not left(folder):
            code = code_of(folder)
        elif run["static"] and states[run["static"]].result():
            return
        else:
            code = pool.run(folder, command)
        done += 1
        if not (pool.stopped and code == INTERRUPTED):
            tell(f"{done}/{count} {run['name']}", folder, code)

    needed = {run["static"] for run in plan["runs"] if run["static"] and left(command_of_run(plan, out, run)[0])}
    with ThreadPoolExecutor(jobs) as workers:
        states = {digest: workers.submit(state, digest) for digest in plan["statics"] if digest in needed}
        for future in [workers.submit(shake, run) for run in plan["runs"]]:
            future.result()


def ends(plan, out):
    """(exit code, folder that has it) of every run by its name: its own, or that of its static state where that has failed."""
    found = {}
    for run in plan["runs"]:
        folder, _ = command_of_run(plan, out, run)
        code = code_of(folder)
        if code is None and run["static"]:
            state, _ = commands_of_static(plan, out, run["static"])
            if code_of(state):
                code, folder = code_of(state), state
        found[run["name"]] = code, folder
    return found
