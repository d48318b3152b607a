"""What befalls a run: drawn with a seed, carried out, and what has come of it."""
import os
import random
import shutil
import signal
import subprocess
import threading
import time
from pathlib import Path

import same
from subjects import ENV

SIGNALS = ("SIGKILL", "SIGKILL", "SIGTERM", "SIGINT", "SIGUSR1", "SIGHUP")
MODES = ("kill", "group", "torn", "EIO", "ENOSPC", "EDQUOT", "EROFS")
AROUND = ("full", "unwritable", "removed", "moved", "lock", "two", "clock")
NOBODY = 65534
TIMEOUT = 120  # s; the longest of the commands takes 10
HANGS = "hangs"
CODES = {0, 65, 66, 73, 74, 75}  # with which a program may end when something befalls it; below 0: by the signal


def every_call(subjects):
    """A death and, in turn, one of the other faults at every call of the programs that changes something; those of the scripts and reads,
    of which there are too many, are drawn."""
    others = [mode for mode in MODES if mode not in ("kill", "group")]
    for subject in subjects.values():
        if subject.scripts or "often" in subject.name:
            continue
        for at in range(1, subject.changes + 1):
            yield from ({"subject": subject.name, "kind": "call", "mode": mode, "at": at} for mode in ("kill", others[at % len(others)]))
        if subject.name == "a new start":
            yield from ({"subject": subject.name, "kind": "call", "mode": mode, "at": at, "back": True} for at in range(1, 41) for mode in ("kill", "EIO"))


def draw(subjects, seed, number):
    """The befalling of a number."""
    rng = random.Random(f"{seed} {number}")
    programs, scripts = ([s for s in subjects.values() if s.scripts == of] for of in (False, True))
    subject = rng.choice((scripts if rng.random() < 0.2 else programs) or programs or scripts)
    kind = rng.choices(("signals", "call", "around", "damage"), (5, 2, 0 if subject.scripts else 2, 0 if subject.scripts else 1))[0]
    what = {"subject": subject.name, "kind": kind}
    if kind == "signals":  # one or several, each to a run that has been started again
        what["signals"] = [(rng.choice(SIGNALS), round(rng.uniform(0, 1.05), 4), rng.choice(("group", "process"))) for _ in range(rng.choice((1, 1, 2, 4)))]
    if kind == "call":
        what["mode"] = rng.choice((*MODES, "read") if not subject.scripts else MODES)
        what["at"] = rng.randint(1, max(1, subject.reads if what["mode"] == "read" else subject.changes))
    if kind == "around":
        what |= {"kind": rng.choice(AROUND), "when": round(rng.random(), 4)}
    if kind == "damage":
        what |= {"how": rng.choice(("flip", "flip", "stretch", "cut")), "file": rng.random(), "where": rng.random(), "seed": rng.randrange(2**30),
                 "when": round(rng.uniform(0.3, 1.2), 4)}
    return what


class Ending:
    """How a command ended."""

    def __init__(self, code, said):
        self.code, self.said = code, said


class Running:
    """A command in a session of its own."""

    def __init__(self, bench, command, environment=None, user=None):
        self.said = bench.out / "said/now.txt"
        with self.said.open("wb") as said:
            self.process = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=said, stderr=said, cwd=bench.hurt,
                                            env={**ENV, **(environment or {})}, start_new_session=True, user=user)

    def send(self, number, to):
        """Sends a signal to all of them, or to the first process alone."""
        try:
            (os.killpg if to == "group" else os.kill)(self.process.pid, number)
        except ProcessLookupError:
            pass

    def wait(self):
        """How it ended; the rest of its group is waited for too."""
        try:
            code = self.process.wait(TIMEOUT)
            end = time.monotonic() + TIMEOUT
            while time.monotonic() < end:
                os.killpg(self.process.pid, 0)
                time.sleep(0.01)
            code = HANGS
        except ProcessLookupError:
            pass
        except subprocess.TimeoutExpired:
            code = HANGS
        if code == HANGS:
            self.send(signal.SIGKILL, "group")
        return Ending(code, self.said.read_text(errors="replace"))


def after(seconds, act):
    """Acts after a while, beside what goes on."""
    timer = threading.Timer(seconds, act)
    timer.start()
    return timer


def with_signals(bench, subject, what):
    """Signals at given times of runs that are started one after the other."""
    for k, (name, when, to) in enumerate(what["signals"]):
        running = Running(bench, subject.command if k == 0 else subject.again)
        time.sleep(when * subject.seconds)
        running.send(getattr(signal, name), to)
        yield running.wait()


def with_fault(bench, subject, what):
    """A fault at a call."""
    (bench.out / "count").unlink(missing_ok=True)
    yield Running(bench, subject.command, bench.fault(what["at"], what["mode"])).wait()


def with_full_disk(bench, subject, what):
    """A disk of its own that is too small, and is then made larger."""
    size = sum(path.stat().st_size for path in bench.whole(subject).rglob("*") if path.is_file())
    kept = bench.out / "kept"
    shutil.rmtree(kept, ignore_errors=True)
    if bench.work.exists():
        shutil.move(bench.work, kept)
    bench.work.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={64 + int(what['when'] * 2 * size / 1024)}k", "tmpfs", bench.work], check=True)
    if kept.exists() and subprocess.run(["cp", "-a", f"{kept}/.", bench.work], check=False, stderr=subprocess.DEVNULL).returncode:
        yield Ending(74, "the disk has no room for what was there before")
    else:
        yield Running(bench, subject.command).wait()
    subprocess.run(["mount", "-o", "remount,size=1g", bench.work], check=True)
    if kept.exists():
        subprocess.run(["cp", "-an", f"{kept}/.", bench.work], check=True)


def with_unwritable(bench, subject, what):
    """A folder in which its user may write nothing, from some moment on."""
    bench.work.mkdir(exist_ok=True)
    for path in [bench.work, *bench.work.rglob("*")]:
        os.chown(path, NOBODY, NOBODY)
    running = Running(bench, subject.command, user=NOBODY) if what["when"] > 0.3 else None
    time.sleep(max(0.0, what["when"] - 0.3) * subject.seconds)
    bench.work.chmod(0o555)
    yield (running or Running(bench, subject.command, user=NOBODY)).wait()
    bench.work.chmod(0o755)


def with_vanishing(bench, subject, what):
    """A folder that is removed, or moved away, under the run."""
    running = Running(bench, subject.command)
    time.sleep(what["when"] * subject.seconds)
    away = bench.out / "away"
    shutil.rmtree(away, ignore_errors=True)
    if what["kind"] == "moved" and bench.work.exists():
        bench.work.rename(away)
    shutil.rmtree(bench.work, ignore_errors=True)
    yield running.wait()


def with_lock(bench, subject, what):
    """The lock file of a host that is dead."""
    running = Running(bench, subject.command)
    time.sleep(what["when"] * subject.seconds)
    running.send(signal.SIGKILL, "group")
    yield running.wait()
    bench.work.mkdir(exist_ok=True)
    (bench.work / ".lock").write_text("host gone, pid 1, since 2001-01-01T00:00:00Z\n")


def with_two(bench, subject, what):
    """Two runs in one folder at once: each goes on, or says that the other is at work."""
    first = Running(bench, subject.command)
    time.sleep(what["when"] * subject.seconds)
    second = subprocess.run([str(word) for word in subject.again], capture_output=True, text=True, check=False, env=ENV, cwd=bench.hurt)
    yield Ending(second.returncode, second.stderr)
    yield first.wait()


def with_clock(bench, subject, what):
    """A clock that is set back by a day after the run was cut short."""
    running = Running(bench, subject.command)
    time.sleep(what["when"] * subject.seconds)
    running.send(signal.SIGKILL, "group")
    yield running.wait()
    yield Running(bench, subject.again, {"LD_PRELOAD": str(bench.faults), "FAULT_CLOCK": "-86400"}).wait()


def with_damage(bench, subject, what):
    """A file of the folder that is damaged after the run was cut short, or had ended."""
    running = Running(bench, subject.command)
    time.sleep(what["when"] * subject.seconds)
    running.send(signal.SIGKILL, "group")
    yield running.wait()
    files = sorted(path for path in bench.work.rglob("*") if path.is_file() and path.name != ".lock" and path.stat().st_size)
    if not files:
        return
    path = files[int(what["file"] * len(files))]
    what["damaged"] = path.name
    content, rng = bytearray(path.read_bytes()), random.Random(what["seed"])
    at = int(what["where"] * len(content))
    if what["how"] == "flip":
        content[at] ^= 1 << rng.randrange(8)
    elif what["how"] == "stretch":
        length = min(len(content) - at, rng.randint(1, 4096))
        content[at:at + length] = rng.choice((bytes(length), rng.randbytes(length)))
    else:
        del content[at:]
    path.write_bytes(content)


ACTS = {"signals": with_signals, "call": with_fault, "full": with_full_disk, "unwritable": with_unwritable, "removed": with_vanishing, "moved": with_vanishing,
        "lock": with_lock, "two": with_two, "clock": with_clock, "damage": with_damage}


def why_skipped(what):
    """Why a befalling cannot be brought about here; empty: it can."""
    if what["kind"] in ("full", "unwritable") and os.geteuid() != 0:
        return "takes root"
    return ""


def may_say_why(what):
    """Whether what is left may be beyond mending: then a refusal that says why will do."""
    return what.get("back") or what["kind"] == "removed" or (what["kind"] == "damage" and Path(what.get("damaged", "")).suffix in (".hdf", ".json"))


def judge(bench, subject, what, endings):
    """(how it ended, why): survived, said why, or FAILED."""
    for ending in endings:
        if ending.code == HANGS or (not subject.scripts and ending.code not in CODES and ending.code > 0) or "a bug of ours" in ending.said:
            return "FAILED", f"ended with {ending.code} when it was hurt: {ending.said[-2000:]}"
    again = Running(bench, bench.other if what.get("back") else subject.again).wait()
    if again.code == 73 and may_say_why(what) and again.said.strip():
        return "said why", again.said.strip().splitlines()[-1]
    if again.code != 0:
        return "FAILED", f"the same command ended with {again.code}: {again.said[-2000:]}"
    if what.get("back"):
        return "survived", ""
    different = same.differences(bench.whole(subject), bench.work)
    if different:
        return "FAILED", "; ".join(different[:5])
    if not subject.scripts:
        repeated = Running(bench, [word for word in subject.again if word != "--fresh"]).wait()
        if repeated.code != 0 or "finished already" not in repeated.said:
            return "FAILED", f"it is not finished: {repeated.said[-2000:]}"
    rough = [e for e in endings if "Traceback (most recent" in e.said]
    return ("survived", "") if not rough else ("survived, untidily", rough[0].said[-600:])


def carry_out(bench, what):
    """Lets it befall its subject and runs the same command again; (how it ended, why)."""
    if why := why_skipped(what):
        return "skipped", why
    subject = bench.subjects[what["subject"]]
    bench.begin(subject)
    try:
        endings = list(ACTS[what["kind"]](bench, subject, what))
        return judge(bench, subject, what, endings)
    finally:
        if os.path.ismount(bench.work):
            subprocess.run(["umount", "-l", bench.work], check=False)
