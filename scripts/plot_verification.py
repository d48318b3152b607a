"""Draws the curves of a run of the verification ladder over their references, and the errors over the resolution.

    plot_verification.py DIR     reads DIR/results.json, writes DIR/verification.png and DIR/verification.pdf
"""
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

COLUMNS = 4


def panels_of(case):
    """Curves of a case by name, those of all resolutions together, coarse to fine; and its errors."""
    curves = {}
    for curve in case["curves"]:
        curves.setdefault(curve["name"], []).append(curve)
    return [("curves", group) for group in curves.values()] + [("errors", case["rows"])]


def draw_curves(axis, group):
    """One curve at every resolution (coarse is light, fine dark) over its reference."""
    finest = group[-1]
    axis.plot(finest["x"], finest["reference"], color="black", lw=2.4, alpha=0.35, label="reference")
    shades = plt.cm.viridis([0.85 * k / max(len(group) - 1, 1) for k in range(len(group))][::-1])
    for curve, shade in zip(group, shades):
        axis.plot(curve["x"], curve["model"], color=shade, lw=0.9, label=f"{curve['resolution']:g}")
    axis.set_xlabel(finest["x_label"])
    axis.set_ylabel(finest["y_label"])
    axis.legend(fontsize=6, title=finest["name"], title_fontsize=6)


def draw_errors(axis, rows, resolution):
    """Errors of all measures over the resolution, and their bounds, on logarithmic axes."""
    for measure in dict.fromkeys(row["measure"] for row in rows):
        mine = [row for row in rows if row["measure"] == measure]
        line, = axis.loglog([row["resolution"] for row in mine], [max(row["error"], 1e-17) for row in mine], "o-",
                            ms=3, lw=1, label=measure)
        bounded = [row for row in mine if row["bound"] is not None]
        axis.loglog([row["resolution"] for row in bounded], [row["bound"] for row in bounded], "v--", ms=3, lw=0.6,
                    color=line.get_color(), alpha=0.6)
    ticks = sorted({row["resolution"] for row in rows})
    axis.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axis.minorticks_off()
    axis.set_xlabel(resolution)
    axis.set_ylabel("error; dashed: bound")
    axis.legend(fontsize=6)


def page(cases):
    """One figure with all panels."""
    panels = [(case, *panel) for case in cases for panel in panels_of(case)]
    rows = -(-len(panels) // COLUMNS)
    figure, axes = plt.subplots(rows, COLUMNS, figsize=(4.2 * COLUMNS, 3.1 * rows), layout="constrained", squeeze=False)
    for axis, (case, kind, data) in zip(axes.flat, panels):
        if kind == "curves":
            draw_curves(axis, data)
        else:
            draw_errors(axis, data, case["resolution"])
        failed = not all(row["pass"] for row in case["rows"])
        axis.set_title(f"{case['name']}: {case['title']}", fontsize=8, color="red" if failed else "black")
        axis.tick_params(labelsize=7)
        axis.xaxis.label.set_size(7)
        axis.yaxis.label.set_size(7)
        axis.grid(alpha=0.3)
    for axis in axes.flat[len(panels):]:
        axis.remove()
    return figure


def main():
    """Reads the results and writes the page; returns the exit code."""
    if len(sys.argv) != 2:
        print("usage: plot_verification.py DIR", file=sys.stderr)
        return 64
    folder = Path(sys.argv[1])
    figure = page(json.loads((folder / "results.json").read_text()))
    for name in ("verification.png", "verification.pdf"):
        figure.savefig(folder / name, dpi=110)
        print(folder / name)
    return 0


if __name__ == "__main__":
    sys.exit(main())
