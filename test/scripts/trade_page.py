"""Tables, fronts and the picture of the trade between speed and accuracy; see trade_study.py."""
import sys

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import LogFormatter, NullFormatter
from plot_common import COLOURS
from trade_norms import SLIDES, WAVES

MARKS = "<!-- tables -->", "<!-- end of tables -->"
PAGE = "TRADE.md"
CHEAPER = 0.95  # of another's particle-steps: costs that are nearer are equal


def floors(rows, shifts):
    """Noise floor of each norm: twice the standard deviation over shifted grids, in which the default is one."""
    names = rows[0][4]
    return {name: 2 * np.std([shift[name] for shift in shifts], ddof=1) if len(shifts) > 1 else 0.0 for name in names}


def on_front(rows, norm, floor):
    """Whether each row is on the front of a norm: no other is cheaper and as accurate, or as cheap and more accurate."""
    cost, error = np.array([row[2] for row in rows], dtype=float), np.array([row[4][norm] for row in rows])
    return [bool(np.isfinite(e)) and not np.any((cost <= c) & (error <= e + floor) & ((cost < CHEAPER * c) | (error < e - floor)))
            for c, e in zip(cost, error)]


def shown(norm, value):
    """An error as text: per cent, or the norm's unit."""
    if not np.isfinite(value):
        return "–"
    return f"{value:.3g}" if norm.endswith(")") else f"{100 * value:.2g} %"


def table(scene, rows, shifts, failures):
    """Markdown lines of a scene, cheapest first; what is on a norm's front is bold."""
    rows = sorted(rows, key=lambda row: row[2])
    norms, least = (WAVES if scene.gauges else SLIDES), floors(rows, shifts)
    fronts = {norm: on_front(rows, norm, least[norm]) for norm in norms}
    yield f"### {scene.name}\n"
    yield "| | cells (m) | 1e6 particle-steps | core-seconds | " + " | ".join(norms) + " |"
    yield "| --- " * (4 + len(norms)) + "|"
    for k, (knob, spacing, work, seconds, errors) in enumerate(rows):
        cells = [f"**{shown(n, errors[n])}**" if fronts[n][k] else shown(n, errors[n]) for n in norms]
        yield f"| {knob} | {spacing:g} | {work / 1e6:.3g} | {seconds:.3g} | " + " | ".join(cells) + " |"
    yield f"| noise floor, {len(shifts)} shifts | {scene.turned:g} | | | " + " | ".join(shown(n, least[n]) for n in norms) + " |\n"
    for knob, spacing, code in failures:
        yield f"{knob}, {spacing:g} m: ended with exit code {code}.\n"


def verdicts(known):
    """Markdown lines: where each knob is on a front."""
    places = {}
    for scene, rows, shifts, _ in known:
        least = floors(rows, shifts)
        for norm in WAVES if scene.gauges else SLIDES:
            for row, front in zip(rows, on_front(rows, norm, least[norm])):
                places.setdefault(row[0], set())
                if front:
                    places[row[0]].add((scene.name, norm))
    yield "| | on the front of | in |"
    yield "| --- | --- | --- |"
    for knob, found in places.items():
        scenes = sorted({scene for scene, _ in found})
        yield f"| {knob} | {len(found)} | {', '.join(scenes) or 'none'} |"


def panel(axis, scene, rows, shifts, _):
    """One scene. Knobs that change little are dots without a name: error within a fifth, or the noise floor, of the default's."""
    norm = (WAVES if scene.gauges else SLIDES)[0]
    floor = floors(rows, shifts)[norm]
    usual = next((row[4][norm] for row in rows if row[:2] == ("default", scene.turned)), np.nan)
    for (knob, marker), colour in zip((("default", "o-"), ("paper's method", "s--"), ("paper's method, 3 x 3", "D:")), COLOURS):
        line = sorted((row[2], row[4][norm]) for row in rows if row[0] == knob)
        axis.plot(*np.transpose(line) if line else ([], []), marker, color=colour, label=knob, zorder=3)
    for knob, _, work, _, errors in rows:
        if not knob.startswith(("default", "paper")) and np.isfinite(errors[norm]):
            axis.plot(work, errors[norm], "k.", ms=5)
            if not abs(errors[norm] - usual) <= max(floor, usual / 5) or knob.startswith("Courant"):
                axis.annotate(knob, (work, errors[norm]), fontsize=7.5, xytext=(4, 2), textcoords="offset points")
    axis.axhline(floor, color="grey", lw=0.8, ls="-.", label="noise floor")
    axis.set(xscale="log", yscale="log", title=scene.name, xlabel="particle-steps", ylabel=f"error of {norm}")
    for side in (axis.xaxis, axis.yaxis):
        side.set_major_formatter(LogFormatter())
        side.set_minor_formatter(NullFormatter())
    axis.grid(alpha=0.3, which="both")


def draw(known, path):
    """A panel for each scene: error in its first norm over particle-steps."""
    figure, panels = plt.subplots(2, (len(known) + 1) // 2, figsize=(15, 9), layout="constrained", squeeze=False)
    for axis, entry in zip(panels.flat, known):
        panel(axis, *entry)
    for axis in panels.flat[len(known):]:
        axis.set_axis_off()
    panels.flat[0].legend(fontsize=8)
    figure.savefig(path, dpi=80)
    plt.close(figure)


def write(scenes, folder):
    """Puts the tables between the marks of TRADE.md in the folder, and draws trade.png beside it.

    scenes: {name: (scene, rows, norms of shifts, failures)}; those without rows are told as not run.
    """
    known = [entry for entry in scenes.values() if entry[1]]
    text = (folder / PAGE).read_text(encoding="utf-8")
    if any(mark not in text for mark in MARKS):
        sys.exit(f"trade: {folder / PAGE} lacks {MARKS[0]} or {MARKS[1]}")
    lines = [*verdicts(known), "", *(line for entry in known for line in table(*entry))]
    lines += [f"{name}: not run.\n" for name, entry in scenes.items() if not entry[1]]
    before, after = text.split(MARKS[0])[0], text.split(MARKS[1])[1]
    (folder / PAGE).write_text(before + MARKS[0] + "\n" + "\n".join(lines).rstrip() + "\n" + MARKS[1] + after, encoding="utf-8")
    draw(known, folder / "trade.png")
