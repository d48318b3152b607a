"""The page of a sweep: what the slides came to against the intensity of the shaking, fragility curves, all runs in a table."""
import base64
import html
from io import BytesIO

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, NullLocator

import fragility

LABELS = {"pga": "PGA (g)", "pgv": "PGV (m/s)", "arias": "Arias intensity (m/s)", "displacement": "displacement (m)",
          "toe_advance": "run-out of the toe (m)", "moved_mass": "moved mass (t/m)", "trigger_time": "trigger (s)",
          "moved_area": "moved area (m²)", "newmark_displacement": "rigid block (m)", "newmark_trigger": "its trigger (s)"}
DRAWN = {"displacement": 1.0, "toe_advance": 1.0, "moved_mass": 1e-3, "trigger_time": 1.0}  # and the factor to the unit of the label
OURS, BLOCK, LOST = "#0072B2", "#D55E00", "#000000"  # told apart by the colour-blind (Okabe and Ito 2008)
STYLE = """body{font:15px/1.45 sans-serif;max-width:75em;margin:1em auto;padding:0 1em;color:#111}img{max-width:100%}
table{border-collapse:collapse;font-size:13px}td,th{border-bottom:1px solid #ccc;padding:.15em .5em;text-align:right;white-space:nowrap}
td:first-child,th:first-child{text-align:left}.wide{overflow-x:auto}.lost{color:#a00}"""


def label_of(name):
    """What an intensity is called on an axis."""
    return f"Sa({name[3:]} s) (g)" if name.startswith("sa_") else LABELS.get(name, name)


def words_of(told, confidence):
    """A fragility curve in a line."""
    start = f"{told['limit']}, {label_of(told['intensity'])}: {told['failures']} of {told['runs']} failed"
    if not told["curve"]:
        return f"{start}; no curve: {told['why_not']}"
    line = (f"{start}; median {told['median']:.3g} ({told['median_low']:.3g} to {told['median_high']:.3g}), "
            f"beta {told['beta']:.2f} ({told['beta_low']:.2f} to {told['beta_high']:.2f})")
    if "median_low_records" in told:
        line += f"; by records median {told['median_low_records']:.3g} to {told['median_high_records']:.3g}"
    return f"{line}, at {100 * confidence:g} %"


def log_axis(axis, values):
    """An axis of intensities with plain numbers."""
    axis.set_xscale("log")
    axis.set_xlim(0.85 * values.min(), values.max() / 0.85)
    ratio = values.max() / values.min()
    steps = (1, 1.5, 2, 3, 5, 7) if ratio < 6 else (1, 2, 5) if ratio < 100 else (1,)
    ticks = [m * 10.0**e for e in range(-6, 4) for m in steps]
    axis.set_xticks([tick for tick in ticks if 0.85 * values.min() <= tick <= values.max() / 0.85])
    axis.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.xaxis.set_minor_locator(NullLocator())
    axis.grid(alpha=0.3)


def column(rows, name):
    """A column of the rows."""
    return np.array([row[name] for row in rows], dtype=float)


def drawn_intensities(rows, names):
    """Intensities with values to draw."""
    return [name for name in names if name != "d5_95" and (column(rows, name) > 0.0).any()]


def draw_measures(rows, names):
    """Every measure against every intensity; runs without a result stand below the axis."""
    done = [row for row in rows if row["exit"] == 0]
    lost = [row for row in rows if row["exit"] != 0]
    figure, axes = plt.subplots(len(DRAWN), len(names), figsize=(2.6 * len(names) + 0.6, 2.1 * len(DRAWN) + 0.4), squeeze=False,
                                sharex="col", sharey="row", layout="constrained")
    for line, (measure, factor) in zip(axes, DRAWN.items()):
        block = {"displacement": "newmark_displacement", "trigger_time": "newmark_trigger"}.get(measure)
        for axis, name in zip(line, names):
            if block:
                axis.plot(column(done, name), column(done, block), "o", ms=4, mfc="none", color=BLOCK, lw=0, alpha=0.7, label="rigid block")
            axis.plot(column(done, name), factor * column(done, measure), "o", ms=4, color=OURS, lw=0, alpha=0.7, label="run")
            if lost:
                axis.plot(column(lost, name), np.full(len(lost), 0.03), "x", color=LOST, transform=axis.get_xaxis_transform(),
                          label="no result")
            log_axis(axis, column(rows, name)[column(rows, name) > 0.0])
        line[0].set_ylabel(LABELS[measure])
        line[0].set_ylim(bottom=-0.04 * line[0].get_ylim()[1])
    for axis, name in zip(axes[-1], names):
        axis.set_xlabel(label_of(name))
    axes[0, 0].legend(fontsize=7)
    return figure


def draw_curves(rows, curves, confidence):
    """Fragility curves with the band of their likelihood; runs as marks at 0 and 1, those without a result between."""
    limits = list(dict.fromkeys(told["limit"] for told in curves))
    names = list(dict.fromkeys(told["intensity"] for told in curves))
    figure, axes = plt.subplots(len(limits), len(names), figsize=(2.6 * len(names) + 0.6, 2.6 * len(limits) + 0.4), squeeze=False,
                                sharey=True, layout="constrained")
    for told in curves:
        axis = axes[limits.index(told["limit"]), names.index(told["intensity"])]
        values = column(rows, told["intensity"])
        log_axis(axis, values[values > 0.0])
        failed = column(rows, told["measure"]) >= told["value"]
        done = np.array([row["exit"] == 0 for row in rows])
        axis.plot(values[done], failed[done], "|", color=OURS, ms=9, alpha=0.7, label="slope failed, or stood")
        if not done.all():
            axis.plot(values[~done], np.full((~done).sum(), 0.5), "x", color=LOST, label="run without a result")
        if told["curve"]:
            x = np.geomspace(*axis.get_xlim(), 100)
            low, high = fragility.band(told["curve"], x, confidence)
            axis.fill_between(x, low, high, color=OURS, alpha=0.2, lw=0, label=f"{100 * confidence:g} %, likelihood")
            axis.plot(x, told["curve"].probability(x), color=OURS, lw=1.5, label="most likely")
            axis.set_title(f"median {told['median']:.3g}, β {told['beta']:.2f}", fontsize=8)
        else:
            axis.set_title("no curve: see below", fontsize=8)
        axis.set_xlabel(label_of(told["intensity"]))
        axis.set_ylim(-0.05, 1.05)
    for line, limit in zip(axes, limits):
        line[0].set_ylabel(f"P({limit.replace('_', ' ').replace('>=', '≥').replace('m2', 'm²')})")
    axes[0, 0].legend(fontsize=6, loc="center left")
    return figure


def picture(figure, path, alt):
    """Writes a picture to its file; an element of the page that holds it too."""
    data = BytesIO()
    figure.savefig(data, dpi=130, format="png")
    plt.close(figure)
    path.write_bytes(data.getvalue())
    return f'<p><img alt="{html.escape(alt)}" src="data:image/png;base64,{base64.b64encode(data.getvalue()).decode()}"></p>'


def told(value):
    """An entry of a table."""
    if isinstance(value, float):
        return "" if np.isnan(value) else f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"
    return html.escape(str(value))


def table(columns, rows, units):
    """Rows of the page's table of runs; units of the settings."""
    head = "".join(f"<th>{html.escape(label_of(name) + (f' ({units[name]})' if units.get(name) else ''))}</th>" for name in columns)
    lines = []
    for row in rows:
        cells = "".join(f"<td>{told(row[name])}</td>" for name in columns)
        lines.append(f"<tr{'' if row['exit'] == 0 else ' class=lost'}>{cells}</tr>")
    return f"<div class=wide><table><tr>{head}</tr>{''.join(lines)}</table></div>"


def table_of_curves(curves, confidence):
    """The fragility curves in numbers."""
    def limits(told, name, ending=""):
        """LOW to HIGH of a parameter, empty where they are not known."""
        low, high = told.get(f"{name}_low{ending}"), told.get(f"{name}_high{ending}")
        return "" if low is None else f"{low:.3g} to {high:.3g}"

    share = f"{100 * confidence:g} %"
    head = "".join(f"<th>{words}</th>" for words in ("failure", "intensity", "failed", "median", share, f"{share}, by records", "β", share,
                                                     f"{share}, by records"))
    lines = []
    for curve in curves:
        cells = [curve["limit"], label_of(curve["intensity"]), f"{curve['failures']} of {curve['runs']}"]
        if curve["curve"]:
            cells += [f"{curve['median']:.3g}", limits(curve, "median"), limits(curve, "median", "_records"), f"{curve['beta']:.2f}",
                      limits(curve, "beta"), limits(curve, "beta", "_records")]
        row = "".join(f"<td>{html.escape(cell)}</td>" for cell in cells)
        lines.append(f"<tr>{row}{'' if curve['curve'] else '<td colspan=6>' + html.escape(curve['why_not']) + '</td>'}</tr>")
    return f"<div class=wide><table><tr>{head}</tr>{''.join(lines)}</table></div>"


def write(given, plan, rows, columns, curves):
    """Writes DIR/summary.html and the pictures in it; columns: names of the intensities, and units of settings that differ."""
    names, settings = columns
    pictures = given.folder / "pictures"
    pictures.mkdir(exist_ok=True)
    done = sum(row["exit"] == 0 for row in rows)
    parts = [f"<h1>{html.escape(given.folder.resolve().name)}</h1>",
             f"<p>{html.escape(plan['case'])}: {len(rows)} runs, {done} done, {len(rows) - done} without a result. Intensities are "
             "those of the horizontal outcrop motion as applied; displacement is that of the centre of mass of the ground that has slid.</p>"]
    drawn = drawn_intensities(rows, names)
    if done and drawn:
        parts.append(picture(draw_measures(rows, drawn), pictures / "measures.png", "measures of the slide against intensities"))
        parts.append("<h2>Fragility</h2>")
        shown = [told for told in curves if told["intensity"] in drawn]
        parts.append(picture(draw_curves(rows, shown, given.confidence), pictures / "fragility.png", "fragility curves"))
    parts.append(table_of_curves(curves, given.confidence))
    parts.append("<p>Intervals of the likelihood take runs for independent; those by records draw whole records, so that one record at "
                 "several scales counts once. Runs without a result (×) are in no curve.</p><h2>Runs</h2>")
    parts += [f"<p class=lost>{html.escape(row['run'])}: {html.escape(row['state'])}. {html.escape(row['reason'])}</p>"
              for row in rows if row["exit"] != 0]
    parts.append(table(["run", "scale", *settings, "state", *drawn, "displacement", "toe_advance", "moved_area", "trigger_time",
                        "newmark_displacement", "newmark_trigger"], rows, settings))
    page = f"<!doctype html><html lang=en><meta charset=utf-8><meta name=viewport content='width=device-width'>" \
           f"<title>{html.escape(given.folder.resolve().name)}</title><style>{STYLE}</style><body>{''.join(parts)}</body></html>\n"
    (given.folder / "summary.html").write_text(page, encoding="utf-8")
