"""Checks that the colours of the pictures are told apart by the colour-blind; prints 'N passed, N failed'.

Colour blindness is simulated in linear sRGB after Machado, Oliveira and Fernandes (2009), "A physiologically-based model for
simulation of color vision deficiency", IEEE Trans. Vis. Comput. Graph. 15(6), 1291-1298, table 1 at severity 1. Distances
are Euclidean in CIELAB (CIE 1976, white D65): about 2.3 is just seen when the two lie side by side.
"""
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import matplotlib
from matplotlib.colors import to_rgb

import plot_common
from checking import report

SEEN_AS = {
    "normal vision": np.eye(3),
    "protanopia": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deuteranopia": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritanopia": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}
XYZ = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]])
LEAST = 15.0  # between any two lines, which stand apart in a picture and in its legend
MAPS = ("inferno_r", "viridis_r", "viridis")  # of the sections


def cielab(colours, vision):
    """L*, a*, b* of sRGB colours (0 to 1) as they are seen."""
    colours = np.asarray(colours, dtype=float)
    linear = np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)
    xyz = np.clip(linear @ np.transpose(SEEN_AS[vision]), 0, 1) @ XYZ.T / XYZ.sum(1)
    f = np.where(xyz > (6 / 29) ** 3, np.cbrt(xyz), xyz * (29 / 6) ** 2 / 3 + 4 / 29)
    return np.stack([116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])], axis=-1)


def least_distance(colours, vision):
    """Between any two of the colours."""
    lab = cielab([to_rgb(colour) for colour in colours], vision)
    return np.linalg.norm(lab[:, None] - lab, axis=-1)[np.triu_indices(len(lab), 1)].min()


def short_of(colours, vision):
    """By how much the least distance falls short of what is wanted, and that nothing is allowed."""
    found = least_distance(colours, vision)
    print(f"     {vision}: {found:.1f}")
    return max(0.0, LEAST - found), 0.0


def conversion():
    """White, mid grey and red have the L*, a*, b* of the standard's tables."""
    known = {(1, 1, 1): (100, 0, 0), (119 / 255,) * 3: (50.03, 0, 0), (1, 0, 0): (53.24, 80.09, 67.20)}
    return max(np.abs(cielab(rgb, "normal vision") - lab).max() for rgb, lab in known.items()), 0.02


def measure():
    """matplotlib's own first colours are found to be too close, as they were: 7.3 under deuteranopia."""
    return abs(least_distance(matplotlib.colormaps["tab10"].colors[:6], "deuteranopia") - 7.3), 0.1


def steady(name, vision):
    """A colour map grows darker or brighter all the way (L* with a tolerance of the table's rounding, 1/255 of 100)."""
    brightness = cielab(matplotlib.colormaps[name](np.linspace(0, 1, 65))[:, :3], vision)[:, 0]
    steps = np.diff(brightness) * np.sign(brightness[-1] - brightness[0])
    return max(0.0, -steps.min()), 0.4


def checks():
    """Name and (error, tolerance) of every check."""
    yield conversion.__doc__, conversion()
    yield measure.__doc__, measure()
    drawn = matplotlib.rcParams["axes.prop_cycle"].by_key()["color"][:len(plot_common.COLOURS)]
    yield "Lines are drawn in the colours that are checked.", (float(tuple(drawn) != plot_common.COLOURS), 0)
    for vision in SEEN_AS:
        yield f"Any two lines are {LEAST:g} apart: {vision}.", short_of(plot_common.COLOURS, vision)
        yield f"Any two areas are {LEAST:g} apart: {vision}.", short_of(plot_common.AREAS, vision)
        for name in MAPS:
            yield f"{name} changes its brightness steadily: {vision}.", steady(name, vision)


if __name__ == "__main__":
    sys.exit(report(checks()))
