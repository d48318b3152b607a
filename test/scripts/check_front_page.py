"""Checks the case of the front page, and what the page says comes out of it; prints 'N passed, N failed'."""
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from checking import report

ROOT = Path(__file__).resolve().parent.parent.parent
CASE = ROOT / "cases" / "first" / "case.yaml"


def slide_of_the_case(folder):
    """Runs both programs as the page does; the measures of the slide."""
    static, shaken = folder / "first-static", folder / "first"
    for command in (["mpm-static", CASE, "--out", static],
                    ["mpm-seismic", CASE, "--from", static / "final.h5", "--out", shaken]):
        subprocess.run([ROOT / "build" / command[0], *command[1:], "--quiet"], check=True, stderr=subprocess.DEVNULL)
    return json.loads((shaken / "summary.json").read_text())["slide"]


def checks():
    """(name, (error, tolerance)) of each."""
    page = (ROOT / "README.md").read_text()
    shown = re.search(r"```yaml\n(.*?)```", page, re.DOTALL)[1]
    yield "The case that it shows is the one in cases/first.", (float(shown != CASE.read_text()), 0)
    area, way = (float(number) for number in re.search(r"(\d+) m2 slide, ([\d.]+) m on average", page).groups())
    with tempfile.TemporaryDirectory() as folder:
        slide = slide_of_the_case(Path(folder))
    x, y = slide["centre_of_mass_displacement"]
    yield "As much ground slides as it says.", (abs(slide["moved_area"] / area - 1), 0.02)
    yield "And as far.", (abs((x * x + y * y) ** 0.5 / way - 1), 0.03)


if __name__ == "__main__":
    sys.exit(report(checks()))
