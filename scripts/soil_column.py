"""S waves that travel up and down in level layers with damping, as SHAKE has them (Schnabel, Lysmer and Seed 1972).

A layer is (thickness in m, density in kg/m3, speed of S waves in m/s), from the surface down; the last is the half-space, whatever
its thickness. A complex speed is that of a layer with damping. Frequencies in Hz.
"""
import csv

import numpy as np

HEADS = ("thickness (m)", "density (kg/m3)", "shear wave speed (m/s)", "damping (%)")
LONGEST = 1000  # m


class BadColumn(Exception):
    """Says what is wrong with a table of layers; the program ends with 65."""


def damped(speed, damping):
    """The complex speed (m/s) of a layer with a ratio of damping: its modulus is G (1 - 2 xi^2 + 2 i xi sqrt(1 - xi^2)), of magnitude G."""
    return speed * np.sqrt(1.0 - 2.0 * damping**2 + 2.0j * damping * np.sqrt(1.0 - damping**2))


def read(path):
    """The layers of a table of HEADS, from the surface down; the thickness of the last, the half-space, is empty."""
    with open(path, newline="", encoding="utf8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    if len(rows) < 2 or not set(HEADS) <= set(rows[0]):
        raise BadColumn(f"{path}: a table of layers has the columns {', '.join(HEADS)}, and two rows or more")
    layers = []
    for k, row in enumerate(rows, 1):
        try:
            thickness, density, speed, damping = (float(row[head] or (0 if head == HEADS[0] and k == len(rows) else "nan")) for head in HEADS)
        except (ValueError, TypeError):
            thickness = density = speed = damping = np.nan
        if not (thickness > 0 or k == len(rows)) or not (density > 0 and speed > 0 and 0 <= damping < 50):
            raise BadColumn(f"{path}: layer {k}: wanted are a thickness (of all but the last), density and speed above 0, a damping from 0 to 50 %")
        layers.append((thickness, density, damped(speed, damping / 100)))
    return layers


def waves(layers, frequency):
    """Up- and downgoing waves at the top of each layer, where both are 1 at the surface."""
    up = down = np.ones(len(frequency), dtype=complex)
    found = [(up, down)]
    for (thickness, density, speed), (_, below, faster) in zip(layers, layers[1:]):
        ratio, phase = density * speed / (below * faster), np.exp(2j * np.pi * frequency * thickness / speed)
        up, down = (0.5 * (up * (1 + ratio) * phase + down * (1 - ratio) / phase),
                    0.5 * (up * (1 - ratio) * phase + down * (1 + ratio) / phase))
        found.append((up, down))
    return found


def motion_at(layers, frequency, place):
    """Motion at a place, over half of that of the surface: "surface", "outcrop" of the half-space, or within, at a depth in m."""
    found = waves(layers, frequency)
    if place == "surface":
        return found[0][0] + found[0][1]
    if place == "outcrop":
        return 2.0 * found[-1][0]
    depth = float(place)
    for (thickness, _, speed), (up, down) in zip(layers[:-1], found):
        if depth <= thickness:
            phase = np.exp(2j * np.pi * frequency * depth / speed)
            return up * phase + down / phase
        depth -= thickness
    phase = np.exp(2j * np.pi * frequency * depth / layers[-1][2])
    return found[-1][0] * phase + found[-1][1] / phase


def travel_time(layers):
    """How long an S wave needs from the half-space to the surface, s."""
    return sum(thickness / abs(speed) for thickness, _, speed in layers[:-1])
