"""Of a report: the motion as applied, histories of gauges and free field, response spectra, numbers."""
from dataclasses import dataclass

import numpy as np

import plot_histories
import report_html as html
import spectrum
from plot_common import Missing, array, label, open_history
from settings import gauge_positions

MEASURES = ("", "PGA (g)", "at (s)", "PGV (m/s)", "Arias (m/s)", "CAV (m/s)", "D5-95 (s)")
PERIODS = (0.1, 0.2, 0.3, 0.5, 1.0, 2.0, 3.0, 4.0)  # s, of the tables
MOST_SPREAD = 10.0  # of the greatest over the middle of values that are drawn on one scale
COMPONENTS = ("horizontal (x)", "vertical (y)")


@dataclass
class Motion:
    """A motion with even steps."""

    name: str
    dt: float  # s
    acceleration: np.ndarray  # m/s2 [time, component]
    velocity: np.ndarray  # m/s [time, component]
    free_field: bool = False

    def component(self, k):
        """Acceleration of a component, and its step."""
        return self.acceleration[:, k], self.dt

    @property
    def time(self):
        """Of the samples (s)."""
        return self.dt * np.arange(len(self.acceleration))


def outcrop_of(file):
    """The outcrop motion, twice the upgoing one as applied."""
    time, velocity, acceleration = plot_histories.read_motion(file)
    return Motion("outcrop", float(time[1] - time[0]), 2.0 * acceleration, 2.0 * velocity)


def surface_of(file):
    """Motions of gauges and free-field surfaces: acceleration is the slope of the velocity's spline."""
    found = []
    for name, time, velocity in plot_histories.surface_motions(file):
        (x, dt), (y, _) = (spectrum.acceleration_of(time, column) for column in velocity.T)
        even = [np.interp(time[0] + dt * np.arange(len(x)), time, column) for column in velocity.T]
        found.append(Motion(name, dt, np.stack([x, y], axis=1), np.stack(even, axis=1), name.startswith("free field, ")))
    return found


def read(run):
    """The outcrop motion, None without one, and the motions of the surface."""
    with open_history(run.folder) as file:
        return outcrop_of(file) if "motion" in file else None, surface_of(file)


def shaken(outcrop):
    """Components in which there is a motion."""
    return [k for k in range(2) if np.any(outcrop.velocity[:, k])] or [0]


def of_record(run):
    """What the records were, and what was done to them."""
    rows = []
    for name, motion in run.summary.get("motion", {}).items():
        samples = f"{motion.get('samples', '–')} samples of {motion.get('dt', '–')} s"
        rows += [(f"{name} record", f"{motion.get('source', '–')}, {samples}, scale {motion.get('scale', 1):g}, "
                  f"recorded as {motion.get('recorded_as', '–')}")]
        done = motion.get("correction", {})
        rows += [(f"{name} correction", f"baseline {done.get('baseline', '–')}, high pass {done.get('high_pass', 0):g} Hz, "
                  f"taper {done.get('taper', 0):g} s")]
    if run.summary.get("motion_ended") is not None:
        rows += [("motion ended", f"{run.summary['motion_ended']:.2f} s")]
    return html.words(rows) if rows else ""


def applied(run):
    """The motion as applied, beside its spectrum."""
    with open_history(run.folder) as file:
        motion, record = plot_histories.read_motion(file), plot_histories.factor_of_record(file)
        outcrop = outcrop_of(file)
    components = shaken(outcrop)

    def spectra(axis):
        for k in components:
            colour = f"C{k}" if len(components) > 1 else "k"
            plot_histories.draw_spectra(axis, k, (outcrop.acceleration, outcrop.dt), [], colour, f"outcrop, {COMPONENTS[k]}")
        axis.set(xlabel="period (s)", title="")
        axis.legend()

    return of_record(run) + html.grid([
        html.panel(lambda axes: plot_histories.draw_input(axes, motion, components, record),
                   "The upgoing motion as it entered at the base.", (5.2, 5.2), 3),
        html.panel(spectra, "Response spectrum, 5 % damping, of the outcrop motion, twice the upgoing one.", (5.2, 5.2))])


def rows_of(motions, values, ylabel, own_scales):
    """Draws one row for each motion, all on one scale or each on its own."""
    greatest = {motion.name: np.abs(values(motion)).max() or 1.0 for motion in motions}

    def draw(axes):
        for axis, motion in zip(np.atleast_1d(axes), motions):
            most = greatest[motion.name] if own_scales else max(greatest.values())
            axis.plot(motion.time, values(motion), "k" if motion.name == "outcrop" else "C0", lw=0.6)
            axis.set_ylim(-1.08 * most, 1.08 * most)
            axis.set_title(motion.name, loc="left", pad=2)
        axis.figure.supylabel(ylabel, fontsize="medium")
        axis.set_xlabel("time (s)")

    return draw


def histories(run):
    """Accelerations and velocities row by row; displacements relative to the base."""
    outcrop, motions = read(run)
    if not motions:
        raise Missing("the run has no gauge and no free field")
    stacked = ([outcrop] if outcrop else []) + motions
    size = (5.2, 0.75 + 0.95 * len(stacked))
    parts = []
    for quantity, unit in (("acceleration", "m/s²"), ("velocity", "m/s")):
        for k in range(2):
            values = lambda motion, q=quantity, c=k: getattr(motion, q)[:, c]
            spread = np.array([np.abs(values(motion)).max() for motion in stacked if np.any(values(motion))] or [1.0])
            own = spread.max() > MOST_SPREAD * np.median(spread)
            draw = rows_of(stacked, values, f"{quantity}, {'xy'[k]} ({unit})", own)
            told = f"{quantity.capitalize()}, {COMPONENTS[k]}, {'each on its own scale' if own else 'all on one scale'}."
            parts.append(html.panel(draw, told, size, len(stacked)))
    return html.grid(parts) + displacements(run)


def displacements(run):
    """Displacements of gauges and free-field surfaces relative to the base of the left free field."""
    with open_history(run.folder) as file:
        series, base, where = [], 0.0, "in total, since there is no free field whose base it could be told from"
        if "free_field/left/base_displacement" in file:
            base, where = file["free_field/left/base_displacement"][...], "relative to the base of the left free field"
        if "gauges" in file:
            time, names, fields = plot_histories.read_gauges(file)
            series += [(label(name), time, fields["displacement"][:, k] - base) for k, name in enumerate(names)]
        for side in ("left", "right"):
            if f"free_field/{side}" in file:
                column = file[f"free_field/{side}"]
                series.append((f"free field, {side}", array(column, "time"), array(column, "surface_displacement") - base))

    def draw(axis, k):
        for name, time, values in series:
            axis.plot(time, values[:, k], label=name, **plot_histories.line_of(name))
        axis.set(xlabel="time (s)", ylabel=f"displacement, {'xy'[k]} (m)")
        html.legend(axis)

    return html.grid([html.panel(lambda axis, k=k: draw(axis, k), f"Displacement, {COMPONENTS[k]}, {where}.") for k in range(2)])


def spectra(run):
    """Response spectra of gauges and free field over that of the outcrop."""
    outcrop, motions = read(run)
    if outcrop is None:
        raise Missing("the run has no motion")
    others = [(motion.name, motion.dt * np.arange(len(motion.velocity)), motion.velocity) for motion in motions]

    def draw(axis, k):
        plot_histories.draw_spectra(axis, k, (outcrop.acceleration, outcrop.dt), others)
        axis.set(xlabel="period (s)", title="")
        html.legend(axis)

    told = [f"Response spectra, 5 % damping, {component}." for component in COMPONENTS]
    return html.grid([html.panel(lambda axis, k=k: draw(axis, k), told[k], (5.2, 3.8)) for k in range(2)])


def numbers(run):
    """Intensity measures and spectral accelerations of all motions."""
    outcrop, motions = read(run)
    motions = ([outcrop] if outcrop else []) + motions
    if not motions:
        raise Missing("the run has no motion, no gauge and no free field")
    parts = []
    for k, component in enumerate(COMPONENTS):
        rows, spectral = [], []
        for motion in motions:
            acceleration, dt = motion.component(k)
            if not np.any(acceleration):
                continue
            m = spectrum.intensity_measures(acceleration, motion.velocity[:, k], dt)
            rows.append([motion.name, *map(html.number, (m["pga"] / spectrum.GRAVITY,)), f"{m['pga_time']:.2f}",
                         *map(html.number, (m["pgv"], m["arias"], m["cav"])), f"{m['d5_95']:.1f}"])
            known = [period for period in PERIODS if period >= 4 * dt]
            values = spectrum.pseudo_acceleration(acceleration, dt, known) / spectrum.GRAVITY
            spectral.append([motion.name] + ["–"] * (len(PERIODS) - len(known)) + [html.number(value) for value in values])
        parts += [html.table(MEASURES, rows, component.capitalize()),
                  html.table(["5 % Sa (g) at T ="] + [f"{period:g} s" for period in PERIODS], spectral)]
    left_out = [name for name in gauge_positions(run.settings) if name not in [motion.name.strip() for motion in motions]]
    if left_out:
        told = f"Left out, since the histories have gaps or are too short: {', '.join(left_out)}."
        parts.insert(0, html.paragraph(told, "note"))
    return "".join(parts)
