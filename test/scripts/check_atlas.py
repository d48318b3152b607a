"""A small part of the atlas (scripts/atlas): draws of everything at once, points beyond the stable step, tests that exist.

    check_atlas.py [FOLDER]     with the programs of another build's folder
"""
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "test/atlas"))
import cases
import checking
import draws
import judge
from extremes import EXTREMES
from maps import MAPS

PROGRAMS = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build").resolve()
DRAWS = 40


def run(settings):
    """How a case with these settings ends."""
    built = cases.build(**settings)
    return judge.run(PROGRAMS, built["case"], built["record"], built["speed"], built["factor"])


def named_tests():
    """Patterns of the forty that no test has the name of."""
    # Catch2 2 lists names by the first of these, 3 by the second; each refuses or folds the other's.
    for options in (["--list-test-names-only"], ["--list-tests", "--verbosity", "quiet"]):
        listed = subprocess.run([PROGRAMS / "seismpm-tests", *options, "*"], capture_output=True, text=True, check=False).stdout
        if listed.strip():
            break
    names = [" ".join(line.split()) for line in listed.splitlines()]
    missing = [p for e in EXTREMES for p in (*e.tests, *e.slow)
               if not any(n.startswith(p[:-1]) if p.endswith("*") else n == p for n in names)]
    return missing


def checks():
    """All checks."""
    yield "the forty are forty, in order", (abs(len(EXTREMES) - 40) + sum(e.number != k for k, e in enumerate(EXTREMES, 1)), 0)
    missing = named_tests()
    yield f"every test that they name is there{': ' + '; '.join(missing) if missing else ''}", (len(missing), 0)
    ends = {number: run(draws.draw(number)) for number in range(DRAWS)}
    bad = [f"{number} {r['end']} {r['said']}" for number, r in ends.items() if r["end"] in judge.FAILURES]
    yield f"none of {DRAWS} draws grows unseen or breaks {'; '.join(bad)}", (len(bad), 0)
    yield "at least half of them run to their end", (sum(r["end"] not in ("stable", "damped") for r in ends.values()) / DRAWS, 0.5)
    courant = next(of for of in MAPS if of.name == "courant")
    for method in ("flip, consistent; free sides", "apic, lumped; free sides"):
        for number, wanted in ((0.5, "stable"), (1.8, "caught")):
            end = run(courant.settings(method, 2, number))["end"]
            yield f"{method} at {number}: {end}", (end != wanted, 0)


sys.exit(checking.report(checks()))
