"""A case as the programs understand it, profile and settings applied and every default written out.

`mpm-static CASE --print-case` says it; what a script changes in a case it gives back by `--set`.
"""
import json
import subprocess
import sys
from pathlib import Path

try:
    import yaml
except ImportError:
    print("PyYAML is missing: apt-get install python3-yaml, or set PYTHON to a python3 that has it", file=sys.stderr)
    sys.exit(66)

from whole_file import write_whole


class Refused(Exception):
    """Says why a command cannot be carried out, and has the exit code that tells so (io/run_folder)."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


def options_of(profile, settings):
    """Options of both programs for a profile (empty: none) and settings {key: value}."""
    chosen = ["--profile", profile] if profile else []
    return chosen + [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]


def program(folder, name):
    """Path of a program in the folder; refused when there is none."""
    path = Path(folder) / name
    if not path.exists():
        raise Refused(66, f"{path} is missing; build first (scripts/run), or name the folder of the programs with --programs")
    return path


def resolve(folder, case, options=()):
    """The case as nested dictionaries, numbers with their units as text; refused as the program in the folder refuses it."""
    command = [str(program(folder, "mpm-static")), str(case), "--print-case", *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise Refused(done.returncode, done.stderr.strip())
    return yaml.safe_load(done.stdout)


def setting(assignment):
    """(key, value) of KEY=VALUE."""
    key, sign, value = assignment.partition("=")
    if not (key.strip() and sign and value.strip()):
        raise Refused(64, f"'{assignment}' is no setting; write KEY=VALUE")
    return key.strip(), value.strip()


def number_and_unit(value):
    """(number, unit) of a value such as '64 kPa'; the unit of a bare number is empty."""
    number, _, unit = str(value).strip().partition(" ")
    try:
        return float(number), unit.strip()
    except ValueError:
        raise Refused(65, f"'{value}' is no number with a unit, such as 64 kPa") from None


def first_state(programs, case, resolved, options, folder):
    """Path of the first state of a case's ground, in a folder that a stage was stopped in at once.

    It holds the ground as the programs see it, whatever draws its surfaces. `resolved` is the case as `resolve` gives it; it is
    kept beside the folder, and another one is refused.
    """
    kept, words = folder.with_name(folder.name + ".json"), json.dumps(resolved, indent=1) + "\n"
    if kept.exists() and kept.read_text() != words:
        raise Refused(73, f"{folder.parent} holds results of another case or setting; give another --out")
    find = lambda: next(iter([*folder.glob("final.h5"), *folder.glob("checkpoint-*.h5")]), None)
    if find() is None:
        weightless = number_and_unit(resolved["static"]["gravity"])[0] == 0.0
        command = [program(programs, "mpm-seismic" if weightless else "mpm-static"), case, "--out", folder, *options,
                   "--max-wall", "0.001s", "--quiet"]
        folder.parent.mkdir(parents=True, exist_ok=True)
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
        write_whole(kept, words)
        if find() is None:
            raise Refused(done.returncode or 70, done.stderr.strip() or f"{folder}: no state was left")
    return find()
