"""Makes cases/verification/line_load/reference.csv: a line load on a small and a large box, by finite elements.

    test/scripts/line_load_reference.py          # elements of 0.25 m; prints also how the mesh and the box matter
"""
import os
import sys

import numpy
from scipy.interpolate import CubicSpline

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import q4

ROCK = q4.Material(2200, 250e6, 0.25)
DURATION, EVERY, FREQUENCY, HALF_WIDTH = 0.46, 0.002, 5.0, 4.0  # s, s, Hz, m
GAUGES = {"surface": (10, 0), "edge": (19, 0), "below": (0, -15), "diagonal": (12, -12)}


def box(half, depth, size):
    x = numpy.linspace(-half, half, round(2 * half / size) + 1)
    mesh = q4.Mesh(x, [lambda x: -depth, lambda x: 0], [round(depth / size)], [ROCK])
    share = numpy.where(abs(x) < HALF_WIDTH, size / (2 * HALF_WIDTH) * (1 + numpy.cos(numpy.pi * x / HALF_WIDTH)), 0)

    def load(t):
        a = (numpy.pi * (FREQUENCY * t - 1)) ** 2
        return -(1 - 2 * a) * numpy.exp(-a) * share

    nodes = [mesh.nearest(*place) for place in GAUGES.values()]
    time, velocity = q4.shake(mesh, lambda t: (0, 0), DURATION + EVERY, nodes, load=load)
    at = numpy.arange(1, round(DURATION / EVERY) + 1) * EVERY
    return CubicSpline(time, velocity)(at).transpose(1, 2, 0)  # [gauge, direction, time]


def greatest(a, b):
    """Greatest difference of each gauge over its peak in b."""
    return numpy.hypot(*(a - b).swapaxes(0, 1)).max(axis=1) / numpy.hypot(*b.swapaxes(0, 1)).max(axis=1)


def main():
    coarse, small, large = box(20, 20, 0.5), box(20, 20, 0.25), box(80, 80, 0.25)
    for name, mesh, echo in zip(GAUGES, greatest(coarse, small), greatest(small, large)):
        print(f"{name:9s} elements of 0.5 against 0.25 m {mesh:.1e}, small against large box {echo:.4f}")
    rows = [numpy.arange(1, small.shape[2] + 1) * EVERY]
    names = ["time"]
    for g, name in enumerate(GAUGES):
        for kind, run in (("small", small), ("large", large)):
            rows += [run[g, 0], run[g, 1]]
            names += [f"{name}_{kind}_x", f"{name}_{kind}_y"]
    head = "# Velocity in m/s under 1 N/m, by test/scripts/line_load_reference.py (elements of 0.25 m)\n" + ",".join(names)
    folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "cases", "verification", "line_load")
    numpy.savetxt(os.path.join(folder, "reference.csv"), numpy.array(rows).T, fmt=["%.3f"] + ["%.4e"] * (len(names) - 1),
                  delimiter=",", header=head, comments="")


if __name__ == "__main__":
    main()
