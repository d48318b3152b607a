"""Holds the JSON Schema of the case file, as the programs print it, against all cases and against mistakes; prints 'N passed, N failed'.

    check_schema.py [FOLDER_OF_PROGRAMS]
"""
import copy
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from checking import report

ROOT = Path(__file__).resolve().parent.parent.parent
PROGRAMS = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build"
# Where in cases/slope, and what is put there.
MISTAKES = ((("grid", "spacng"), "1 m"), (("grid", "spacing"), "1 s"), (("grid", "spacing"), 1), (("grid", "softening"), "averged"),
            (("grid", "particles_per_cell"), 2.5), (("domain", "x"), "0 m"), (("materials", "soil", "densty"), "1800 kg/m3"),
            (("materials", "soil", "strength", "peak"), "70 k"), (("seismic", "motion", "horizontal"), "builtin"),
            (("seismic", "motion", "horizontal"), {"fle": "a"}), (("regions", 0, "abov"), "ground"), (("static", "damping"), "much"),
            (("nam",), "x"))


def wrong(*claims):
    """Number of claims that do not hold, and the number that may."""
    return float(sum(not claim for claim in claims)), 0.0


def printed(option):
    """What mpm-static prints for an option."""
    return subprocess.run([PROGRAMS / "mpm-static", option], check=True, capture_output=True, text=True).stdout


def cases(yaml):
    """All cases of the tree, by their paths."""
    found = {path: yaml.safe_load(path.read_text()) for path in sorted((ROOT / "cases").rglob("*.yaml"))}
    return {path: case for path, case in found.items() if str(case.get("schema", "")).startswith("seismpm-case/")}


def all_cases(validator, yaml):
    """Every case of the tree keeps to the schema, and so does one with all defaults written out."""
    found = cases(yaml)
    resolved = subprocess.run([PROGRAMS / "mpm-static", ROOT / "cases/slope/case.yaml", "--print-case"], check=True, capture_output=True)
    found["--print-case"] = yaml.safe_load(resolved.stdout)
    faults = [f"{path}: {error.json_path}: {error.message}" for path, case in found.items() for error in validator.iter_errors(case)]
    print(*faults, sep="\n", end="\n" if faults else "")
    return wrong(len(found) > 10, not faults)


def mistakes(validator, yaml):
    """A misspelt key or word, a wrong unit and a wrong type do not keep to it, wherever they stand."""
    right, good = yaml.safe_load((ROOT / "cases/slope/case.yaml").read_text()), []
    for path, value in MISTAKES:
        case = copy.deepcopy(right)
        node = case
        for step in path[:-1]:
            node = node[step] if isinstance(step, int) or step in node else node.setdefault(step, {})
        node[path[-1]] = value
        good.append(not validator.is_valid(case))
        if not good[-1]:
            print(path, value, "is taken")
    return wrong(validator.is_valid(right), *good)


def example():
    """What --example prints is a case with remarks, and can be run."""
    text = printed("--example")
    with tempfile.TemporaryDirectory() as folder:
        case = Path(folder) / "case.yaml"
        case.write_text(text)
        done = subprocess.run([PROGRAMS / "mpm-static", case, "--check", "--quiet"], check=False, capture_output=True, text=True)
    return wrong(done.returncode == 0, text.count("  # ") > 3, not done.stderr)


def checks():
    """Name and (error, tolerance) of every check."""
    yield example.__doc__, example()
    try:
        import jsonschema
        import yaml
    except ImportError as missing:
        yield all_cases.__doc__, f"{missing.name} is missing (apt-get install python3-jsonschema python3-yaml)"
        return
    validator = jsonschema.Draft7Validator(json.loads(printed("--schema")))
    validator.check_schema(validator.schema)
    for check in (all_cases, mistakes):
        yield check.__doc__, check(validator, yaml)


if __name__ == "__main__":
    sys.exit(report(checks()))
