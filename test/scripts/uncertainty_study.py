"""Holds the uncertainties of scripts/uncertainty against known answers, and prints the table of its page.

    uncertainty_study.py DIR [PROBLEM=CELLS ...]      such as layer=0.5; by default all that the page has

Every problem runs on its own grid, on coarser and on shifted ones, and so do two shifted grids with its own cells, which count
as cases of their own. A bar covers when the known answer lies within it, and is tight when it is three errors long at most.
"""
import argparse
import os
import sys
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import known_answers
import uncertainty
import uncertainty_report
from convergence import estimate
from grids import RATIOS

PROBLEMS = [(name, cells) for name in ("layer", "two_layers", "layer_p") for cells in (0.5, 0.35, 0.25)]
PROBLEMS += [("yielding", 1.0), ("yielding", 0.5), ("yielding", 0.25), ("hill", 1.0)]


def series_of(name, cells, out, shifts=(2, 3, 4), programs=uncertainty.PROGRAMS):
    """The runs of a problem, and its answers."""
    case, options, answers = known_answers.problem(name, out)
    width = 140.0 if name == "hill" else 12.0
    options = [*options, "--set", f"grid.spacing={width / round(width / cells):.12g} m", "--quiet"]
    series = uncertainty.Series(argparse.Namespace(case=case, out=out, both=options, seismic=[], shifts=shifts, ratios=RATIOS,
                                                   programs=programs, bisections=0))
    series.run_all()
    with h5py.File(out / "as-is" / "history.h5") as file:
        return series, answers(file["gauges/time"][...])


def judged(series, answers):
    """[(measure, kind, whether it is the case's own grid, value, uncertainty, answer)] of all grids with the case's cells."""
    found = uncertainty_report.measured({grid.name: series.folder(grid) for grid in series.grids})
    coarser = [grid for grid in series.grids if grid.level > 0]
    rows = []
    for own in (grid for grid in series.grids if grid.level == 0):
        levels = uncertainty_report.levels_of([own, *coarser], found)
        for measure, answers_of in levels.items():
            if measure.name in answers:
                told = estimate(answers_of)
                rows.append((measure.name, told.kind, not any(own.shift), told.value, told.uncertainty, answers[measure.name]))
    return rows


def shares(rows):
    """Share of bars that cover and of those that are tight, and the median of bar and error over the answer."""
    error = np.array([abs(row[3] - row[5]) for row in rows])
    bar, size = np.array([row[4] for row in rows]), np.abs([row[5] for row in rows])
    return np.mean(error <= bar), np.mean(bar <= 3 * error), np.median(bar / size), np.median(error / size)


def main():
    """Runs, prints a line for each problem and one for all."""
    out, *chosen = sys.argv[1:]
    problems = [(name, float(cells)) for name, _, cells in (word.partition("=") for word in chosen)] or PROBLEMS
    print("| problem | cells (m) | bars | cover | tight | bar, median | error, median |\n" + "| --- " * 7 + "|")
    total = []
    for name, cells in problems:
        rows = judged(*series_of(name, cells, Path(out) / f"{name}-{cells:g}"))
        total += rows
        print(f"| {name} | {cells:g} | {len(rows)} | " + "{:.2f} | {:.2f} | {:.1e} | {:.1e} |".format(*shares(rows)), flush=True)
    kinds = sorted({row[1] for row in total})
    groups = {"all": total, "own grid": [row for row in total if row[2]], "shifted": [row for row in total if not row[2]]}
    groups |= {kind: [row for row in total if row[1] == kind] for kind in kinds}
    for kind, rows in groups.items():
        if rows:
            print(f"| {kind} | | {len(rows)} | " + "{:.2f} | {:.2f} | {:.1e} | {:.1e} |".format(*shares(rows)))


if __name__ == "__main__":
    main()
