"""Runs both stages of a case, and reads a case as the programs understand it."""
import re
import subprocess
import sys
from pathlib import Path

MOTION_OPTIONS = ("--motion", "--vertical", "--scale", "--record-dt", "--record-unit", "--record-format",
                  "--record-component", "--vertical-component")  # with a value each, of mpm-seismic alone


class Failed(Exception):
    """A program ended with `code`, and has said why."""

    def __init__(self, code):
        """Of an exit code."""
        super().__init__(f"a program ended with {code}")
        self.code = code


def split_options(options):
    """Options of both programs, and those that only mpm-seismic has."""
    both, seismic = [], []
    words = iter(options)
    for word in words:
        of_motion = word.split("=")[0] in MOTION_OPTIONS
        (seismic if of_motion else both).append(word)
        if word in MOTION_OPTIONS:
            seismic.extend([value] if (value := next(words, None)) is not None else [])
    return both, seismic


def call(*command, **named):
    """Runs a program; raises Failed when it fails, or is not there."""
    if not Path(command[0]).exists():
        print(f"{command[0]} is missing; build first (scripts/run)", file=sys.stderr)
        raise Failed(66)
    done = subprocess.run([str(part) for part in command], check=False, **named)
    if done.returncode:
        raise Failed(done.returncode if done.returncode > 0 else 128 - done.returncode)  # of a signal as shells tell it
    return done


def both_stages(programs, case, folders, both, seismic=()):
    """Both stages to folders (static, seismic), which go on where they were interrupted.

    both, seismic: options of both programs and of the second. Without a static folder the ground starts free of stress.
    """
    static, shaken = folders
    start = []
    if static is not None:
        call(programs / "mpm-static", case, "--out", static, *both)
        start = ["--from", static / "final.h5"]
    call(programs / "mpm-seismic", case, *start, "--out", shaken, *both, *seismic)


def settings_of(text):
    """{path of key: text of value} of what --print-case prints: two spaces a level, a map or a value a line."""
    found, path, count = {}, [], {}
    for line in text.splitlines():
        matched = re.match(r"( *)(- )?([^\s#:][^:]*):(?: (.*))?$", line)
        if not matched:
            continue
        indent = len(matched[1])
        path = [(depth, name) for depth, name in path if depth < indent]
        if matched[2]:
            above = "".join(name for _, name in path)
            count[above] = count.get(above, -1) + 1
            path.append((indent, f"[{count[above]}]"))
            indent += 2
        path.append((indent, ("." if path else "") + matched[3]))
        if matched[4] is not None:
            found["".join(name for _, name in path)] = matched[4]
    return found


def resolved_case(programs, case, both):
    """Settings of a case with all defaults, by their paths, as text."""
    done = call(programs / "mpm-static", case, "--print-case", *both, stdout=subprocess.PIPE, text=True)
    return settings_of(done.stdout)


def numbers(text):
    """The numbers of a setting in SI, such as [0 m, 90 m]; words are left out."""
    return [float(word) for word in re.findall(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w.])", text)]


def with_settings(options, settings):
    """Options with {path: value} set on top: a --set of the same key gives way."""
    kept, words = [], iter(options)
    for word in words:
        value = next(words, "") if word == "--set" else word[6:] if word.startswith("--set=") else None
        if value is None:
            kept.append(word)
        elif value.split("=")[0].strip() not in settings:
            kept += ["--set", value]
    return kept + [part for key, value in settings.items() for part in ("--set", f"{key}={value}")]
