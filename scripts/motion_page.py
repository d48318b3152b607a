"""The picture of a motion before and after: histories and 5 % response spectra."""
import matplotlib.pyplot as plt
import numpy as np

import spectrum
from peer import GRAVITY
from plot_common import COLOURS, save


def draw(record, motion, columns, path):
    """Draws both motions and the spectra of a table, (head, values), to a file."""
    figure = plt.figure(figsize=(10.0, 5.6), layout="constrained")
    left, right = figure.subfigures(1, 2, width_ratios=(1.35, 1.0))
    axes = left.subplots(3, 1, sharex=True)
    for part, name, style in ((record, "record", {"color": "0.55", "lw": 1.4}), (motion, "motion", {"color": COLOURS[0], "lw": 0.8})):
        time = part.start + part.dt * np.arange(len(part.acceleration))
        velocity = spectrum.integral(part.acceleration, part.dt)
        for axis, values in zip(axes, (part.acceleration / GRAVITY, velocity, spectrum.integral(velocity, part.dt))):
            axis.plot(time, values, label=name, linestyle="-", **style)
    for axis, name in zip(axes, ("acceleration (g)", "velocity (m/s)", "displacement (m)")):
        axis.set_ylabel(name)
        axis.grid(alpha=0.3)
    axes[-1].set_xlabel("time of the record (s)")
    axes[0].legend(fontsize=8)
    axis = right.subplots()
    styles = {"Sa of the record (g)": {"color": "0.55", "lw": 1.6, "ls": "-"}, "Sa of the motion (g)": {"color": COLOURS[0], "lw": 1.2, "ls": "-"},
              "target (g)": {"color": "k", "lw": 1.2, "ls": "--"}, "RotD50 of the record (g)": {"color": COLOURS[1], "lw": 1.0, "ls": "--"},
              "RotD100 of the record (g)": {"color": COLOURS[1], "lw": 1.0, "ls": ":"}}
    (_, periods), *spectra = columns
    for head, values in spectra:
        axis.loglog(periods, values, label=head.replace(" (g)", ""), **styles[head])
    for part in (axis.xaxis, axis.yaxis):
        part.set_major_formatter(lambda value, _: f"{value:g}")
    axis.set(xlabel="period (s)", ylabel="5 % Sa (g)")
    axis.grid(alpha=0.3, which="both")
    axis.legend(fontsize=8)
    save(figure, path, motion.done[0])
