"""Pictures of a numerical uncertainty: every history as a band, every measure as a bar."""
import json

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter

from newmark import run_of
from plot_common import WIDTH, Missing, label, save

TITLES = {"moved_area": "moved area", "run_out": "displacement of its centre of mass",
          "peak_velocity": "speed of the moved ground, 99th percentile", "outline": "the free surface at the end"}
MOST_BARS = 60  # measures that the picture shows; the table has all
MOST = 1000.0   # % of its value, at which a bar ends


def in_words(name):
    """A measure's name for people: GAUGE.what, or a measure of the slide."""
    gauge, point, what = name.partition(".")
    return label(f"{gauge}: {what}" if point else name.replace("_", " "))


def stored(folder):
    """uncertainty.json of a run folder; None where there is none of this run."""
    path = folder / "uncertainty.json"
    if not path.exists():
        return None
    result = json.loads(path.read_text())
    if result.get("run") == run_of(folder):
        return result
    raise Missing("uncertainty.json is of another run, or of this one before it went on; run scripts/uncertainty again")


def half_text(entry):
    """An uncertainty with two digits and its unit."""
    remark = " (bifurcates)" if entry["kind"] == "bifurcates" else ""
    return f"{float(format(entry['uncertainty'], '.2g')):g} {entry['unit']}{remark}"


def arrays(history):
    """Abscissa, values and uncertainties of a history; NaN where there is none."""
    return tuple(np.array([np.nan if value is None else value for value in history[key]], dtype=float)
                 for key in ("along", "value", "uncertainty"))


def shade(axis, result, name, colour):
    """The band of a history on a page that shows the history itself; nothing where there is none."""
    history = (result or {}).get("histories", {}).get(name)
    if history:
        along, value, half = arrays(history)
        axis.fill_between(along, np.maximum(value - half, 0.0), value + half, color=colour, alpha=0.2, lw=0)


def draw_band(axis, name, history):
    """One history with its band; displacements, areas and speeds have none below zero."""
    along, value, half = arrays(history)
    low = value - half if name == "outline" else np.maximum(value - half, 0.0)
    axis.fill_between(along, low, value + half, alpha=0.3, lw=0)
    axis.plot(along, value, lw=1.0)
    axis.set_title(f"{TITLES.get(name) or in_words(name)} ({history['unit']})", fontsize=9)
    axis.set_xlabel("x (m)" if name == "outline" else "time (s)", fontsize=8)
    axis.tick_params(labelsize=8)
    axis.grid(alpha=0.3)


def draw_bars(axis, measures):
    """Uncertainty of each measure over its value (%), in another colour where it is not asymptotic."""
    names = [name for name, entry in measures.items() if entry["value"]][:MOST_BARS]
    share = [min(MOST, 100.0 * measures[name]["uncertainty"] / abs(measures[name]["value"])) for name in names]
    sound = [measures[name]["kind"] in ("asymptotic", "scatter") for name in names]
    axis.barh(range(len(names)), share, color=["C0" if good else "C1" for good in sound])
    axis.set_yticks(range(len(names)), [in_words(name) for name in names], fontsize=7)
    axis.margins(y=0.01)
    axis.invert_yaxis()
    axis.set_xscale("log")
    for which in (axis.xaxis.set_major_formatter, axis.xaxis.set_minor_formatter):
        which(FuncFormatter(lambda share, _: f"{share:g}" if f"{share:e}"[0] in "125" else ""))
    axis.set_xlabel("uncertainty (% of the value); orange: not asymptotic", fontsize=8)
    axis.tick_params(axis="x", which="both", labelsize=8)
    axis.grid(alpha=0.3, axis="x", which="both")


def draw(result, out):
    """uncertainty.png: bands of the histories, two beside each other, and the measures' bars below."""
    bands = {name: history for name, history in result["histories"].items() if any(history["value"]) or any(history["uncertainty"])}
    rows = (len(bands) + 1) // 2
    heights = 2.3 * rows, 0.6 + 0.19 * min(MOST_BARS, len(result["measures"]))
    figure = plt.figure(figsize=(WIDTH, sum(heights) + 0.5), layout="constrained")
    above, below = figure.subfigures(2, 1, height_ratios=heights)
    axes = above.subplots(rows, 2, squeeze=False).ravel()
    for axis, (name, history) in zip(axes, bands.items()):
        draw_band(axis, name, history)
    for axis in axes[len(bands):]:
        axis.remove()
    draw_bars(below.subplots(), result["measures"])
    spacings = sorted({grid["spacing"] for grid in result["grids"]})
    save(figure, out / "uncertainty.png", f"Numerical uncertainty at {100 * result['confidence']:.0f} %, from "
         f"{len(result['grids'])} grids with cells of {', '.join(f'{h:.3g}' for h in spacings)} m"
         + ("; the answer bifurcates" if result["bifurcates"] else ""))
