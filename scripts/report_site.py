"""Of a report: amplification over the outcrop and over the free field, and profiles with depth."""
import h5py
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

import amplification
import plot_histories
import report_html as html
import spectrum
from plot_common import ENVELOPES, Missing, array, envelopes, group_of, open_history
from report_motion import COMPONENTS, read, shaken
from settings import gauge_positions


def logarithmic(axis):
    """Makes an axis logarithmic, with plain numbers at 1, 2 and 5."""
    (axis.axes.set_xscale if axis.axis_name == "x" else axis.axes.set_yscale)("log")
    axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def carried(run):
    """The frequency (Hz) up to which all materials carry S waves, None where the run does not say it."""
    materials = run.summary.get("resolution", {}).get("materials", {})
    return min((material["S"]["carried_to"] for material in materials.values()), default=None)


def ratios(run, k, motions, reference, over):
    """The ratio of response spectra and the transfer function of the motions over what `reference` gives for each."""
    limit = carried(run)

    def draw(axis, quantity):
        for motion in motions:
            parts = motion.component(k), reference(motion).component(k)
            if quantity == "transfer":
                at = amplification.band(parts)
                values = amplification.transfer_function(*parts, at)
            else:
                at = np.geomspace(max(0.04, 4 * max(dt for _, dt in parts)), 5.0, 120)
                values = amplification.spectral_ratio(*parts, at)
            axis.plot(at, values, label=motion.name, **plot_histories.line_of(motion.name))
        axis.axhline(1.0, color="k", lw=0.6)
        if limit and limit < 25:
            axis.axvline(limit if quantity == "transfer" else 1.0 / limit, color="k", lw=0.9, ls=":")
        logarithmic(axis.xaxis)
        logarithmic(axis.yaxis)
        axis.set(xlabel="frequency (Hz)" if quantity == "transfer" else "period (s)",
                 ylim=(max(0.05, axis.get_ylim()[0]), None), ylabel=f"{'|A|' if quantity == 'transfer' else 'Sa'} over {over}")
        html.legend(axis)

    dotted = f" Dotted: {limit:.1f} Hz, up to which the grid carries S waves in all materials." if limit else ""
    return [html.panel(lambda axis: draw(axis, "Sa"), f"Ratio of 5 % response spectra over {over}, {COMPONENTS[k]}.{dotted}"),
            html.panel(lambda axis: draw(axis, "transfer"), f"Transfer function over {over}, {COMPONENTS[k]}: ratio of Fourier "
                       f"amplitudes, each smoothed first (Konno and Ohmachi, b = {amplification.BANDWIDTH:g}).{dotted}")]


def amplified(run):
    """Amplification over the outcrop, and of the gauges over the free field of the nearer side."""
    outcrop, motions = read(run)
    if outcrop is None or not motions:
        raise Missing("amplification needs a motion, and a gauge or a free field")
    columns = {motion.name.rsplit(" ", 1)[-1]: motion for motion in motions if motion.free_field}
    gauges = [motion for motion in motions if not motion.free_field]
    positions, parts = gauge_positions(run.settings), []
    left, right = run.sides()

    def nearer(motion):
        """The free field on the gauge's side of the middle."""
        x = positions.get(motion.name.strip(), (left, 0))[0]
        side = "left" if x <= 0.5 * (left + right) else "right"
        return columns.get(side) or next(iter(columns.values()))

    for k in shaken(outcrop):
        parts += ratios(run, k, motions, lambda motion: outcrop, "the outcrop")
        if columns and gauges:
            parts += ratios(run, k, gauges, nearer, "the nearer free field")
    return html.grid(parts) + html.paragraph(
        "Whole records are taken, without a window: once the ground slides, what a gauge on it shows is no longer site response.")


def column_at_end(file, side):
    """Heights (m) of a column; displacement relative to the lowest (m), shear stress (kPa) and plastic strain there."""
    column = group_of(file, f"free_field/{side}")
    reference, position = array(column, "particles/reference"), array(column, "particles/position")
    strain = np.zeros(len(reference))
    for part in column["materials"].values():
        if "plastic_strain" in part:
            strain[int(part.attrs["begin"]):int(part.attrs["end"])] = part["plastic_strain"][...]
    height = reference[:, 1]
    levels, level = np.unique(np.round(height, 6), return_inverse=True)
    mean = lambda values: np.bincount(level, values) / np.bincount(level)
    moved = mean((position - reference)[:, 0])
    return levels, moved - moved[0], mean(array(column, "particles/stress")[:, 3] / 1e3), mean(strain)


def greatest(run):
    """Greatest acceleration, shear strain and shear stress of the columns with depth."""
    with open_history(run.folder) as file:
        columns = {side: found for side in ("left", "right") if (found := envelopes(file, side))}
    if not columns:
        return html.paragraph("The history holds no greatest values of the columns with depth: the run is of an older version.", "note")

    def draw(axis, quantity, factor, name):
        for side, column in columns.items():
            depth, values = column[quantity]
            axis.plot(factor * values, depth, lw=1.2, label=f"free field, {side}")
        axis.set(xlabel=name, ylabel="depth (m)", xlim=(0, None), ylim=(max(column[quantity][0].max() for column in columns.values()), 0))
        axis.locator_params(axis="x", nbins=4)
        axis.legend()

    kinds = zip(ENVELOPES, (1 / spectrum.GRAVITY, 100, 1e-3), ("greatest horizontal acceleration (g)", "greatest shear strain (%)",
                                                               "greatest shear stress (kPa)"))
    return html.grid([html.panel(lambda axis, k=kind: draw(axis, *k), f"Free field, over the whole run: {kind[2]}.", (3.9, 3.6))
                      for kind in kinds], True)


def profiles(run):
    """Profiles of the free field: greatest values, what the state holds of the columns, and gauges that stand below each other."""
    state = run.state()
    with h5py.File(state, "r") as file:
        time = float(file["clock"].attrs["time"])
        columns = {side: column_at_end(file, side) for side in ("left", "right") if f"free_field/{side}" in file}
    if not columns:
        raise Missing("the run has no free-field columns")

    def draw(axis, quantity, name):
        for side, column in columns.items():
            axis.plot(column[quantity], column[0], lw=1.2, label=f"free field, {side}")
        axis.set(xlabel=name, ylabel="y (m)")
        axis.locator_params(axis="x", nbins=4)
        axis.legend()

    kinds = ((1, "displacement relative to the base, x (m)"), (2, "shear stress τxy (kPa)"), (3, "plastic strain"))
    panels = [html.panel(lambda axis, q=q, n=n: draw(axis, q, n), f"Free field at t = {time:.2f} s: {n}.", (3.9, 3.6))
              for q, n in kinds]
    return greatest(run) + html.grid(panels, True) + arrays(run)


def arrays(run):
    """Greatest acceleration, displacement and mean shear strain of gauges that stand below each other."""
    positions, (_, motions) = gauge_positions(run.settings), read(run)
    by_name = {motion.name.strip(): motion for motion in motions}
    columns = {}
    for name, (x, y) in positions.items():
        if name in by_name:
            columns.setdefault(round(x, 6), []).append((y, name))
    parts = []
    with open_history(run.folder) as file:
        if "gauges" not in file:
            return ""
        _, names, fields = plot_histories.read_gauges(file)
    for x, gauges in columns.items():
        if len(gauges) < 2:
            continue
        gauges, rows, below = sorted(gauges, reverse=True), [], None
        for k, (y, name) in enumerate(gauges):
            moved = fields["displacement"][:, names.index(name), 0]
            strain = ""
            if k + 1 < len(gauges):
                below = gauges[k + 1]
                strain = html.number(np.abs(moved - fields["displacement"][:, names.index(below[1]), 0]).max() / (y - below[0]))
            rows.append([name, f"{y:g}", html.number(np.abs(by_name[name].acceleration[:, 0]).max() / spectrum.GRAVITY), strain])
        parts.append(html.table(["", "y (m)", "greatest acceleration (g)", "greatest mean shear strain to the next below"], rows,
                                f"Gauges below each other at x = {x:g} m"))
    return "".join(parts)
