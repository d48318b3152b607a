"""The energy balance of a run: what came in, over what became of it; and the residual, which should be nothing."""
import h5py
import matplotlib.pyplot as plt
import numpy as np

from plot_common import AREAS, WIDTH, Missing, array, group_of, open_history, text, titled

BECOME = ("kinetic", "elastic", "plastic", "radiated_base", "radiated_sides", "departed", "damping",
          "transfer")


def read_energy_balance(file):
    """Times (s), the terms (kJ/m) by name, and the label of their unit."""
    group = group_of(file, "energy")
    time = array(group, "time")
    terms = {name: data[...] / 1e3 for name, data in group.items()
             if isinstance(data, h5py.Dataset) and name != "time" and data.shape == time.shape}
    if not len(time) or "residual" not in terms:
        raise Missing("/energy of history.h5 holds no energy balance")
    unit = text(group["residual"].attrs.get("units", "J/m"))
    return time, terms, f"k{unit}"


def sources(terms):
    """What came in (kJ/m), by name. Gravity and the static reaction, which cancel but for the ground's descent and
    deformation, are one."""
    found = {name: terms[name] for name in ("incoming", "free_field") if name in terms}
    found["gravity and static reaction"] = terms.get("static_reaction", 0) - terms.get("gravitational", 0)
    return {name: values for name, values in found.items() if np.any(values)}


def stacked(axis, time, terms, colours):
    """Areas on each other; what is negative goes below zero."""
    above, below = np.zeros_like(time), np.zeros_like(time)
    for (name, values), colour in zip(terms.items(), colours):
        up, down = np.maximum(values, 0), np.minimum(values, 0)
        label = name.replace("_", " ")
        axis.fill_between(time, above, above + up, color=colour, lw=0, label=label)
        axis.fill_between(time, below, below + down, color=colour, lw=0)
        above, below = above + up, below + down
    axis.axhline(0, color="k", lw=0.6)


def energy(folder, heading):
    """What came in as a line over what became of it as areas, and the residual."""
    with open_history(folder) as file:
        time, terms, unit = read_energy_balance(file)
    brought = sources(terms)
    become = {name: terms[name] for name in BECOME if name in terms and np.any(terms[name])}
    figure, (top, middle, bottom) = plt.subplots(3, 1, figsize=(WIDTH, 9.5), sharex=True, height_ratios=(2.4, 1.4, 0.9),
                                                 layout="constrained")
    stacked(top, time, become, AREAS)
    top.plot(time, sum(brought.values()), "k-", lw=1.2, label="all that came in")
    top.set_ylabel(f"what became of it ({unit})")
    for name, values in brought.items():
        middle.plot(time, values, lw=1.0, label=name.replace("_", " "))
    middle.set_ylabel(f"what came in ({unit})")
    largest = max(np.abs(values).max() for name, values in terms.items() if name != "residual")
    bottom.plot(time, 100 * terms["residual"] / (largest or 1.0), "C1", lw=1.0)
    bottom.set_ylabel("residual\n(% of the largest term)")
    bottom.set_xlabel("time (s)")
    for axis in (top, middle):
        axis.legend(fontsize=8, loc="upper left")
    for axis in (top, middle, bottom):
        axis.grid(alpha=0.3)
    return titled(figure, heading)
