"""Writes the atlas: a page of tables, and a picture of the maps."""
from collections import Counter

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from judge import ENDS, FAILURES

# Okabe and Ito's colours, and a letter for those who cannot see them.
LOOKS = {"stable": ("#FFFFFF", "."), "damped": ("#56B4E9", "d"), "caught": ("#E69F00", "c"), "grew": ("#D55E00", "G"), "refused": ("#BBBBBB", "r"),
         "restless": ("#F0E442", "m"), "broke": ("#000000", "X")}


def label(value):
    """A value of an axis as text."""
    return "none" if value is None else f"{value:g}" if isinstance(value, (int, float)) else str(value)


def panels(results, of):
    """{panel: {(row, column): end}} of a map."""
    found = {}
    for (panel, row, column), result in results.items():
        found.setdefault(panel, {})[(row, column)] = result["end"]
    order = list(of.panel[1])
    return dict(sorted(found.items(), key=lambda item: order.index(item[0])))


def table(cells, of):
    """A panel as a table of letters: rows against columns."""
    rows = [value for value in of.row[1] if any(r == value for r, _ in cells)]
    columns = [value for value in of.column[1] if any(c == value for _, c in cells)]
    lines = [f"| {of.row[0]} \\ {of.column[0]} | " + " | ".join(label(c) for c in columns) + " |", "| --- |" + " --- |" * len(columns)]
    for r in rows:
        ends = [cells.get((r, c)) for c in columns]
        lines.append(f"| {label(r)} | " + " | ".join(LOOKS[end][1] if end else "" for end in ends) + " |")
    return "\n".join(lines)


def picture(path, results, maps):
    """All panels of all maps on one sheet."""
    sheets = [(of, panel, cells) for of in maps if results.get(of.name) for panel, cells in panels(results[of.name], of).items()]
    if not sheets:
        return
    across = 4
    down = -(-len(sheets) // across)
    figure, axes = plt.subplots(down, across, figsize=(4.2 * across, 2.9 * down), squeeze=False)
    colours = ListedColormap([colour for colour, _ in LOOKS.values()])
    names = list(LOOKS)
    for axis, sheet in zip(axes.flat, sheets + [None] * (across * down - len(sheets))):
        if sheet is None:
            axis.axis("off")
            continue
        of, panel, cells = sheet
        rows = [value for value in of.row[1] if any(r == value for r, _ in cells)]
        columns = [value for value in of.column[1] if any(c == value for _, c in cells)]
        grid = [[names.index(cells[(r, c)]) if (r, c) in cells else 0 for c in columns] for r in rows]
        axis.imshow(grid, cmap=colours, vmin=-0.5, vmax=len(names) - 0.5, aspect="auto", origin="lower")
        for i, r in enumerate(rows):
            for k, c in enumerate(columns):
                if (r, c) in cells and cells[(r, c)] != "stable":
                    axis.text(k, i, LOOKS[cells[(r, c)]][1], ha="center", va="center", fontsize=7)
        axis.set_xticks(range(len(columns)), [label(c).replace(", ", "\n") for c in columns],
                        fontsize=4.5 if any(", " in label(c) for c in columns) else 6)
        axis.set_yticks(range(len(rows)), [label(r) for r in rows], fontsize=6)
        axis.set_xticks([k + 0.5 for k in range(len(columns) - 1)], minor=True)
        axis.set_yticks([k + 0.5 for k in range(len(rows) - 1)], minor=True)
        axis.grid(which="minor", color="#CCCCCC", linewidth=0.5)
        axis.tick_params(which="minor", length=0)
        axis.set_xlabel(of.column[0], fontsize=7)
        axis.set_ylabel(of.row[0], fontsize=7)
        axis.set_title(f"{of.name}: {label(panel)}", fontsize=8)
    figure.legend(handles=[Patch(facecolor=colour, edgecolor="#888888", label=f"{letter}  {ENDS[end]}") for end, (colour, letter) in LOOKS.items()],
                  loc="lower center", ncol=4, fontsize=8, frameon=False)
    figure.tight_layout(rect=(0, 0.6 / (2.9 * down), 1, 1))
    figure.savefig(path, dpi=80)
    plt.close(figure)


def counts(ends):
    """'12 stable, 3 grows and was caught' of some ends."""
    found = Counter(ends)
    return ", ".join(f"{found[end]} {ENDS[end]}" for end in ENDS if found[end])


def verdict(extreme, tests, map_ends):
    """(verdict, what was measured) of one of the forty: tests are {pattern: (passed, measure)}."""
    found = [(name, tests[name]) for name in (*extreme.tests, *extreme.slow) if name in tests]
    failed = [name for name, (passed, _) in found if not passed]
    ends = [end for name in extreme.maps for end in map_ends.get(name, [])]
    measured = "; ".join(measure for _, (passed, measure) in found if measure)
    if ends:
        measured += ("; " if measured else "") + "maps: " + counts(ends)
    if failed:
        return "fails", "fails: " + ", ".join(failed)
    if any(end in FAILURES for end in ends):
        return "fails", measured
    return extreme.verdict, measured


def extremes_table(extremes, tests, map_ends):
    """The forty as a table."""
    lines = ["| | question | bound, and why | measured: worst of each test over its bound | verdict | held by |", "| --- | --- | --- | --- | --- | --- |"]
    for extreme in extremes:
        said, measured = verdict(extreme, tests, map_ends)
        advice = f"; {extreme.advice}" if extreme.advice else ""
        held = ", ".join([f"`{name}`" for name in (*extreme.tests, *extreme.slow)] + [f"map {name}" for name in extreme.maps])
        lines.append(f"| {extreme.number} | {extreme.question} | {extreme.bound} | {measured} | *{said}*{advice} | {held} |")
    return "\n".join(lines)
