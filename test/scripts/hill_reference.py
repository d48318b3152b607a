"""Makes cases/verification/hill/reference.csv, or checks the program behind it.

    test/scripts/hill_reference.py                 # writes reference.csv (elements of 0.125 m; 3 min)
    test/scripts/hill_reference.py --check         # checks the program against closed forms, and halves the mesh
"""
import argparse
import os
import sys

import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import q4

CASE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "cases", "verification", "hill")
ROCK, SOIL = q4.Material(2200, 250e6, 0.25), q4.Material(1800, 40e6, 0.35)
DURATION, EVERY = 2.5, 0.005  # s
PEAK, FREQUENCY, CENTRE = 0.01, 3.0, 0.5  # outcrop velocity: a Ricker wavelet, m/s, Hz, s


def rockhead(x):
    return 10 + 15 * numpy.where(x < 50, 1, numpy.exp(-(((x - 50) / 30) ** 2)))


def ground(x):
    return rockhead(x) + 10


# Where the histories are taken, m; the gauges of case.yaml stand at the same places.
GAUGES = {
    "left": (0, 35), "behind": (30, 35), "crest": (50, 35), "middle": (71, ground(71)), "toe": (100, ground(100)),
    "right": (140, ground(140)), "interface": (50, 25), "rock": (71, rockhead(71) / 2),
}


def outcrop(t):
    a = (numpy.pi * FREQUENCY * (t - CENTRE)) ** 2
    return PEAK * (1 - 2 * a) * numpy.exp(-a)


def hill_mesh(size):
    """Elements of `size` m in the soil and up to twice as high in the rock, whose waves are 2.35 times as long."""
    x = numpy.linspace(0, 140, round(140 / size) + 1)
    return q4.Mesh(x, [lambda x: 0, rockhead, ground], [round(12 / size), round(10 / size)], [ROCK, SOIL])


def shake_hill(size):
    """Histories [time, gauge, 2] every EVERY s, with the gauges at nodes (size = 1, 1/2, 1/4 ...)."""
    mesh = hill_mesh(size)
    nodes = [mesh.nearest(*place) for place in GAUGES.values()]
    for node, place in zip(nodes, GAUGES.values()):
        assert abs(mesh.x.ravel()[node] - place[0]) < 1e-9 and abs(mesh.y.ravel()[node] - place[1]) < 1e-9, place
    time, velocity = q4.shake(mesh, lambda t: (0.5 * outcrop(t), 0), DURATION, nodes)
    return sample(time, velocity)


def sample(time, velocity):
    from scipy.interpolate import CubicSpline

    at = numpy.arange(1, round(DURATION / EVERY)) * EVERY
    return at, CubicSpline(time, velocity)(at)


def write():
    time, velocity = shake_hill(0.125)
    names = ["time"] + [f"{name}_{direction}" for name in GAUGES for direction in "xy"]
    remark = "# Velocity in m/s, by test/scripts/hill_reference.py (elements of 0.125 m)\n"
    table = numpy.column_stack([time, velocity.reshape(len(time), -1)])
    table[numpy.abs(table) < 1e-9] = 0  # what is not there yet, and rounding
    save("reference.csv", remark + ",".join(names), ",", table, ["%.3f"] + ["%.4e"] * (len(names) - 1))
    at = numpy.arange(0, 1.0 + 1e-9, 0.0025)
    remark = "# s, m/s: outcrop velocity, a Ricker wavelet of 3 Hz at 0.5 s"
    save("ricker.txt", remark, " ", numpy.column_stack([at, outcrop(at)]), ["%.4f", "%.9e"])


def save(name, head, delimiter, table, formats):
    numpy.savetxt(os.path.join(CASE, name), table, fmt=formats, delimiter=delimiter, header=head, comments="")


def level(vertical, size=0.5, width=10):
    """Greatest error of the amplification of 10 m of soil on rock below 7 Hz over its peak, and greatest difference
    between the middle of a level model and its side."""
    x = numpy.linspace(0, width, round(width / size) + 1)
    mesh = q4.Mesh(x, [lambda x: 0, lambda x: 10, lambda x: 20], [round(5 / size), round(10 / size)], [ROCK, SOIL])
    component = 1 if vertical else 0
    direction = numpy.array([1 - component, component])
    nodes = [mesh.nearest(width / 2, 20), mesh.nearest(0, 20)]
    time, velocity = q4.shake(mesh, lambda t: 0.5 * outcrop(t) * direction, 6, nodes)
    surface = velocity[:, 0, component]
    apart = numpy.abs(velocity[:, 0] - velocity[:, 1]).max() / numpy.abs(velocity).max()
    modulus = [m.lame + 2 * m.shear if vertical else m.shear for m in (ROCK, SOIL)]
    impedance = [numpy.sqrt(m.density * M) for m, M in zip((ROCK, SOIL), modulus)]
    speed = numpy.sqrt(modulus[1] / SOIL.density)
    f = numpy.arange(0.5, 7, 0.05)
    kernel = numpy.exp(-2j * numpy.pi * f[:, None] * time)
    found = numpy.abs(kernel @ surface) / numpy.abs(kernel @ outcrop(time))
    k = 2 * numpy.pi * f / speed * 10
    exact = 1 / numpy.hypot(numpy.cos(k), impedance[1] / impedance[0] * numpy.sin(k))
    return numpy.abs(found - exact).max() / exact.max(), apart


def check():
    failed = 0
    for vertical in (False, True):
        errors = [level(vertical, size) for size in (1, 0.5, 0.25)]
        order = numpy.log2(errors[1][0] / errors[2][0])
        text = ", ".join(f"{error:.1e}" for error, _ in errors)
        print(f"level, {'P' if vertical else 'S'} waves: error of the amplification at 1, 0.5, 0.25 m: {text} "
              f"(order {order:.2f}); model and column differ by {max(apart for _, apart in errors):.0e}")
        # The scheme is of second order, and a level model is its own column up to rounding.
        failed += order < 1.8 or errors[2][0] > 0.02 or max(apart for _, apart in errors) > 1e-9
    runs = [shake_hill(size)[1] for size in (1, 0.5, 0.25)]
    scale = numpy.sqrt((runs[-1] ** 2).sum(axis=2).mean(axis=0))
    steps = [numpy.sqrt(((a - b) ** 2).sum(axis=2).mean(axis=0)) / scale for a, b in zip(runs, runs[1:])]
    print("hill, rms difference between meshes over the gauge's rms")
    for k, name in enumerate(GAUGES):
        print(f"  {name:10s} 1 to 0.5 m {steps[0][k]:.2e}, 0.5 to 0.25 m {steps[1][k]:.2e}, "
              f"order {numpy.log2(steps[0][k] / steps[1][k]):.2f}")
    failed += numpy.log2(steps[0] / steps[1]).min() < 1.7
    print("checked" if not failed else f"{failed} checks failed")
    return failed


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    if parser.parse_args().check:
        sys.exit(1 if check() else 0)
    write()
