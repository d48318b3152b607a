"""Pictures of histories: gauges, the motion as applied with response spectra, the slide."""
from textwrap import fill

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, NullFormatter

import spectrum
from plot_common import WIDTH, Missing, array, group_of, label, open_history, text, titled

DIRECTIONS = ("horizontal (x)", "vertical (y)")


def read_gauges(file):
    """Times (s), gauge names and the histories [time, gauge, component] of displacement (m) and velocity (m/s)."""
    gauges = group_of(file, "gauges")
    names = [text(name) for name in array(gauges, "gauge")]
    return array(gauges, "time"), names, {field: gauges[field][...] for field in ("displacement", "velocity")
                                          if field in gauges}


def read_motion(file):
    """Times (s), upgoing velocity (m/s) and acceleration (m/s2) [time, component] of the motion as applied.

    Times are even and no sample of the record lies between them, so that accelerations are linear in between.
    """
    motion = group_of(file, "motion")
    time, velocity, acceleration = (array(motion, name) for name in ("time", "upgoing_velocity", "upgoing_acceleration"))
    if len(time) < 4:
        raise Missing("the motion has fewer than four samples")
    return time, velocity, acceleration


def factor_of_record(file):
    """What makes the record's kind of motion of the upgoing one, and what it is called: twice it is an outcrop's."""
    kind = text(group_of(file, "motion").attrs.get("recorded_as", "outcrop"))
    return (1.0, "upgoing motion") if kind == "upgoing" else (2.0, "outcrop motion (2 × upgoing)")


def read_outline(file):
    """x and heights of the free surface at the start and at the end (m)."""
    group = group_of(file, "outline")
    return array(group, "x"), array(group, "start"), array(group, "end")


def surface_motions(file):
    """(label, time in s, velocity in m/s [time, component]) of the gauges and of the free-field surfaces."""
    found = []
    if "gauges" in file and "gauges/velocity" in file:
        time, names, histories = read_gauges(file)
        found += [(label(name), time, histories["velocity"][:, k]) for k, name in enumerate(names)]
    for side in ("left", "right"):
        if f"free_field/{side}" in file:
            column = file[f"free_field/{side}"]
            velocity = array(column, "velocity", "surface/velocity", "surface_velocity")
            time = array(file, "free_field/time", f"free_field/{side}/time")
            found.append((f"free field, {side}", time, velocity))
    return [motion for motion in found if len(motion[1]) >= 4 and np.isfinite(motion[2]).all()]


def histories(folder, heading):
    """Displacement and velocity of the gauges, x on the left and y on the right."""
    with open_history(folder) as file:
        time, names, fields = read_gauges(file)
    if not fields or not names or not len(time):
        raise Missing("history.h5 has no gauge displacement or velocity")
    figure, axes = plt.subplots(len(fields), 2, figsize=(WIDTH, 3.0 * len(fields) + 0.8), sharex=True, squeeze=False,
                                layout="constrained")
    for row, (field, values) in zip(axes, fields.items()):
        unit = {"displacement": "m", "velocity": "m/s"}[field]
        for component, axis in enumerate(row):
            axis.plot(time, values[:, :, component], lw=0.9, label=[label(name) for name in names])
            axis.set_ylabel(f"{field} {'xy'[component]} ({unit})")
            axis.grid(alpha=0.3)
    for axis in axes[-1]:
        axis.set_xlabel("time (s)")
    axes[0, 0].legend(fontsize=8, ncols=1 + len(names) // 8)
    return titled(figure, heading)


def measures(acceleration, velocity, dt):
    """One line with PGA (g), PGV (m/s), Arias intensity (m/s) and D5-95 (s), as the log has it."""
    return (f"PGA {np.abs(acceleration).max() / spectrum.GRAVITY:#.3g} g, PGV {np.abs(velocity).max():#.3g} m/s, "
            f"Arias {spectrum.arias_intensity(acceleration, dt):#.3g} m/s, "
            f"D5-95 {spectrum.significant_duration(acceleration, dt):.1f} s")


def draw_input(axes, motion, components, record):
    """Upgoing acceleration, velocity and displacement of the given components, one above the other.

    record: factor and name of the record's kind of motion, whose measures are told, as the log and summary.json do.
    """
    time, velocity, acceleration = motion
    dt, (factor, kind) = time[1] - time[0], record
    notes = []
    for component in components:
        a, v = acceleration[:, component], velocity[:, component]
        for axis, values in zip(axes, (a, v, spectrum.integral(v, dt))):
            axis.plot(time, values, lw=0.8, color=f"C{component}", label=DIRECTIONS[component])
        notes.append(f"{'xy'[component]}: {measures(factor * a, factor * v, dt)}")
    axes[0].set_title(f"upgoing motion as applied; as {kind} it has\n" + "\n".join(notes), fontsize=8)
    for axis, what in zip(axes, ("acceleration (m/s²)", "velocity (m/s)", "displacement (m)")):
        axis.set_ylabel(what)
        axis.grid(alpha=0.3)
    axes[-1].set_xlabel("time (s)")
    axes[1].legend(fontsize=8)


def line_of(name):
    """How a motion's line is drawn; its colour, and dashes where colours repeat, are the next of the cycle."""
    return {"lw": 1.0} | ({"ls": "-."} if name.startswith("free field, ") else {})


def draw_spectra(axis, component, outcrop, others, colour="k", name="outcrop = 2 × upgoing"):
    """5 % pseudo-acceleration spectra (g) of the outcrop motion and of the surface motions, one component.

    outcrop: acceleration (m/s2) [time, component] and its step (s), drawn in this colour and under this name.
    """
    periods = spectrum.default_periods()
    motions = [(name, outcrop[0][:, component], outcrop[1])]
    motions += [(name, *spectrum.acceleration_of(time, velocity[:, component])) for name, time, velocity in others]
    for k, (name, acceleration, dt) in enumerate(motions):
        # Periods the samples cannot resolve are left out.
        shown = periods[periods >= 4.0 * dt]
        style = {"color": colour, "lw": 1.8, "ls": "-"} if k == 0 else line_of(name)
        axis.semilogx(shown, spectrum.pseudo_acceleration(acceleration, dt, shown) / spectrum.GRAVITY, label=name,
                      **style)
    axis.set_xlim(periods[0], periods[-1])
    axis.xaxis.set_major_formatter(FuncFormatter(lambda period, _: f"{period:g}"))
    axis.xaxis.set_minor_formatter(NullFormatter())
    axis.set_ylim(bottom=0.0)
    axis.set_ylabel("5 % Sa (g)")
    axis.set_title(f"response spectra, {DIRECTIONS[component]}", fontsize=9)
    axis.grid(alpha=0.3, which="both")


def motion(folder, heading):
    """The motion as applied; beside it its response spectrum with those of gauges and free field."""
    with open_history(folder) as file:
        time, velocity, acceleration = read_motion(file)
        record, others = factor_of_record(file), surface_motions(file)
    components = [k for k in range(velocity.shape[1]) if np.any(velocity[:, k])] or [0]
    figure = plt.figure(figsize=(WIDTH * 1.25, 7.5), layout="constrained")
    left, right = figure.subfigures(1, 2, width_ratios=(1.1, 1.0))
    draw_input(left.subplots(3, 1, sharex=True), (time, velocity, acceleration), components, record)
    axes = right.subplots(len(components), 1, sharex=True, squeeze=False)[:, 0]
    for axis, component in zip(axes, components):
        draw_spectra(axis, component, (2.0 * acceleration, time[1] - time[0]), others)
    axes[-1].set_xlabel("period (s)")
    axes[0].legend(fontsize=8)
    return titled(figure, heading)


def slide(folder, heading):
    """Every series of /slide over time."""
    with open_history(folder) as file:
        group = group_of(file, "slide")
        time = array(group, "time")
        series = {name: (data[...], text(data.attrs.get("units", ""))) for name, data in group.items()
                  if name not in ("time", "component") and data.shape[:1] == time.shape}
    if not series:
        raise Missing("/slide of history.h5 has no series")
    figure, axes = plt.subplots(len(series), 1, figsize=(WIDTH, 2.0 * len(series) + 0.8), sharex=True, squeeze=False,
                                layout="constrained")
    for axis, (name, (values, unit)) in zip(axes[:, 0], series.items()):
        axis.plot(time, values, lw=1.0, label=["x", "y"][:values.shape[1]] if values.ndim == 2 else None)
        axis.set_ylabel(fill(name.replace("_", " ") + (f" ({unit})" if unit else ""), 20))
        axis.grid(alpha=0.3)
        if values.ndim == 2:
            axis.legend(fontsize=8)
    axes[-1, 0].set_xlabel("time (s)")
    return titled(figure, heading)
