"""Runs tests by name and reads how near each came to its bounds."""
import re
import subprocess
import xml.etree.ElementTree as xml

COMPARISON = re.compile(r"^\s*(-?[\d.]+(?:e[+-]?\d+)?)f?\s*(<=|<)\s*(-?[\d.]+(?:e[+-]?\d+)?)f?\s*$", re.IGNORECASE)


def nearest(case):
    """'0.31 of 1e-12'-like text of the check that came nearest to its bound; empty where none compares two numbers."""
    worst = None
    for expression in case.iter("Expression"):
        text = (expression.findtext("Expanded") or "").strip()
        found = COMPARISON.match(text)
        if not found:
            continue
        value, bound = float(found[1]), float(found[3])
        if bound > 0 and value >= 0 and (worst is None or value / bound > worst[0] / worst[1]):
            worst = (value, bound)
    return f"{worst[0]:.2g} of {worst[1]:.2g}" if worst else ""


def run(program, pattern):
    """(passed, measure) of the tests whose names match a pattern; not passed where none does."""
    name = pattern.replace("\\", "").replace(",", "\\,").replace("[", "\\[")
    done = subprocess.run([str(program), name, "-s", "-r", "xml"], capture_output=True, text=True, check=False)
    try:
        root = xml.fromstring(re.sub(r"[^\x09\x0a\x0d\x20-\x7e\u0080-\uffff]", "?", done.stdout))
    except xml.ParseError:
        return False, f"ended with {done.returncode}"
    cases = list(root.iter("TestCase"))
    passed = bool(cases) and done.returncode == 0
    return passed, "; ".join(filter(None, map(nearest, cases)))
