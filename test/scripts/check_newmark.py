"""Checks the rigid block and the slip circle against closed forms; prints 'N passed, N failed', exit 1 on a failure."""
import argparse
import json
import os
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import newmark
import slip_circle
import spectrum
from checking import report
from plot_common import Missing
from rigid_block import STANDARD_GRAVITY as GRAVITY, Block, constant, exponential, linear, slide

EPSILON = np.finfo(float).eps


def shaken(time, horizontal, vertical=0.0):
    """Acceleration [time, (x, y)] of the ground; x points downhill."""
    return np.stack([horizontal + 0.0 * time, vertical + 0.0 * time], axis=1)


def rectangular_pulse():
    """On level ground of yield acceleration N a pulse A of length T moves it by (A T)^2 / 2 (1 / N - 1 / A).

    Tolerance: the pulse's edges take e = 1e-6 of its length each, which changes the displacement by less than 4 e; the
    interval integration itself is exact.
    """
    pulse, length, yields, edge = 4.0, 0.5, 1.0, 1e-6
    time = length * np.array([0.0, edge, 1.0, 1.0 + edge, 2.0, 3.0, 5.0, 8.0])
    slip, speed = slide(Block(0.0, constant(yields / GRAVITY)), time, -shaken(time, pulse * np.array([0, 1, 1, 0, 0, 0, 0, 0])))
    exact = 0.5 * (pulse * length) ** 2 * (1 / yields - 1 / pulse)
    return abs(slip[-1] / exact - 1) + speed[-1], 4 * edge


def half_sine():
    """A half sine of peak A: slips from sin(w t) = N / A until its velocity is spent; double integral in closed form.

    Tolerance: chords of the sine miss up to (w dt)^2 / 8 of the acceleration, and the slip is N / (A - N) times as
    sensitive to it as to the pulse's share above N, twice.
    """
    peak, yields, w, samples = 3.0, 1.2, 2 * np.pi, 2000
    begin = np.arcsin(yields / peak) / w
    speed = lambda t: peak / w * (np.cos(w * begin) - np.cos(w * min(t, np.pi / w))) - yields * (t - begin)
    end = brentq(speed, 0.3, 3.0)
    way = lambda t: peak / w * (np.cos(w * begin) * (t - begin) - (np.sin(w * t) - np.sin(w * begin)) / w) \
        - 0.5 * yields * (t - begin) ** 2
    half = np.pi / w
    exact = way(half) + speed(half) * (end - half) - 0.5 * yields * (end - half) ** 2
    time = np.linspace(0.0, 4 * half, 4 * samples + 1)
    ground = -shaken(time, np.where(time < half, peak * np.sin(w * time), 0.0))
    slip, _ = slide(Block(0.0, constant(yields / GRAVITY)), time, ground)
    return abs(slip[-1] / exact - 1), 4 * (w * half / samples) ** 2 / 8 * peak / (peak - yields) * (1 + yields / (peak - yields))


def steep_plane():
    """Beyond its friction angle it slides with g (sin A - mu cos A), and with (g + a) under a steady lift a."""
    angle, friction, lift = 0.6, 0.3, 1.5
    time = np.linspace(0.0, 3.0, 31)
    slip, _ = slide(Block(angle, constant(friction)), time, shaken(time, 0.0, lift))
    exact = 0.5 * (GRAVITY + lift) * (np.sin(angle) - friction * np.cos(angle)) * time**2
    return np.abs(slip - exact).max() / exact[-1], 100 * EPSILON * len(time)


def yield_of_plane():
    """On a plane the yield acceleration is g tan(phi - A), Newmark's; just below it stays, just above it slides."""
    angle, phi = 0.2, 0.5
    block = Block(angle, constant(np.tan(phi)))
    exact = GRAVITY * np.tan(phi - angle)
    time = np.array([0.0, 1.0])
    still, _ = slide(block, time, shaken(time, -exact * (1 - 1e-9)))
    moved, _ = slide(block, time, shaken(time, -exact * (1 + 1e-6)))
    return abs(block.yield_acceleration() / exact - 1) + still[-1] + (moved[-1] <= 0), 100 * EPSILON


def uphill():
    """Shaking that pushes it uphill does not move it."""
    time = np.linspace(0.0, 1.0, 11)
    slip, speed = slide(Block(0.3, constant(0.5)), time, shaken(time, 30.0))
    return slip[-1] + speed[-1], 0.0


def slip_weakening():
    """Exponential weakening over a plane of 14 degrees after a pulse, as an adaptive integrator of high order.

    Tolerance: RK4 with 5 ms steps on rates of change below 2 / s leaves (0.01)^4 a step, 1e-8 over 20 s; the start within
    a step is taken with the excess as linear, which shifts it by (5 ms)^2.
    """
    block = Block(np.radians(14.0), exponential(0.3, 0.07, 1.7))
    time = np.linspace(0.0, 20.0, 4001)
    pulse = np.where(time < 1.0, -2.0 * np.sin(np.pi * np.minimum(time, 1.0)) ** 2, 0.0)
    slip, _ = slide(block, time, shaken(time, pulse))
    start = time[np.argmax(slip > 0)]
    first = slip[time <= start][-1], 0.0
    rates = lambda t, s: (s[1], block.acceleration(s[0], (np.interp(t, time, pulse), 0.0)))
    moving = brentq(lambda t: block.acceleration(0.0, (np.interp(t, time, pulse), 0.0)), 0.01, 0.5)
    found = solve_ivp(rates, (moving, time[-1]), first, rtol=1e-10, atol=1e-12, max_step=0.01)
    return abs(slip[-1] / found.y[0, -1] - 1), 1e-5


def energy_of_weakening():
    """Linear weakening: the kinetic energy is the work of gravity less that of friction, int mu = closed form."""
    angle, length = 0.5, 2.0
    block = Block(angle, linear(0.5, 0.1, length))
    time = np.linspace(0.0, 6.0, 6001)
    slip, speed = slide(block, time, shaken(time, 0.0))
    work = np.where(slip < length, 0.5 * slip - 0.1 * slip**2, 0.1 * slip + 0.2 * length)
    exact = GRAVITY * (np.sin(angle) * slip - np.cos(angle) * work)
    # The kink of the strength is met within a step of 1 ms: d' dt of slip at most is integrated with the wrong branch.
    return np.abs(0.5 * speed**2 - exact).max() / exact[-1], 1e-5


def pendulum():
    """Without strength a block on an arc swings as far beyond the bottom as it began before it, then stays.

    Tolerance: steps of 1 ms on a period of some seconds: RK4 leaves (2 pi / 3000)^4 a step, and it stops on a chord.
    """
    radius, angle = 10.0, 0.7
    time = np.linspace(0.0, 12.0, 12001)
    slip, _ = slide(Block(angle, gain=1.0, radius=radius), time, shaken(time, 0.0))
    return abs(slip[-1] / (2 * angle * radius) - 1), 1e-6


def raster(height, size, cut, strength=30e3):
    """Homogeneous ground of 2000 kg/m3: a face of `height` m whose surface is cut(x), on as much below."""
    x = np.arange(-3 * height, 3 * height, size) + 0.5 * size
    surface = cut(x)
    cells = (len(x), int(np.ceil((surface.max() + height) / size)))
    return slip_circle.Ground(x, surface, -height, size, np.full(cells, 2000.0), np.full(cells, strength))


def vertical_cut():
    """A vertical cut with gamma H / s_u = 3.83 just stands on its weakest circle (Fellenius): no yield acceleration.

    Tolerance: columns of H / 60 end the arc up to a column off at either end, which is 2 % of an arc of 1.4 H, and the
    search stops within a quarter of a column; the yield acceleration is (F - 1) g offset / depth, about (F - 1) g.
    """
    height = 6.0
    ground = raster(height, 0.1, lambda x: np.where(x < 0, height, 0.0), 2000.0 * GRAVITY * height / 3.83)
    circle = slip_circle.weakest(ground, 1)
    return max(abs(circle.yield_acceleration / GRAVITY), abs(circle.safety - 1)), 0.03


def mirrored():
    """The mirror image of a slope has the mirrored circle, to the search's own precision."""
    height = 8.0
    right = slip_circle.weakest(raster(height, 0.4, lambda x: np.clip(height * (1 - x / 4), 0, height)), 1)
    left = slip_circle.weakest(raster(height, 0.4, lambda x: np.clip(height * (1 + x / 4), 0, height)), -1)
    return abs(left.yield_acceleration / right.yield_acceleration - 1), 5e-3


def record():
    """A decaying sum of seeded sines from 0.5 to 15 Hz in 10 ms steps (s, m/s2): 8 s, peak 2.5 m/s2."""
    random = np.random.default_rng(3)
    time = 0.01 * np.arange(801)
    waves = sum(np.sin(2 * np.pi * f * time + random.uniform(0, 2 * np.pi)) for f in np.geomspace(0.5, 15.0, 20))
    acceleration = np.exp(-((time - 3.0) / 1.5) ** 2) * waves
    return time, 2.5 * acceleration / np.abs(acceleration).max()


def write_run(folder, settings=None):
    """A run of that outcrop motion, whose gauges are sampled ten times as coarsely; returns its folder."""
    time, acceleration = record()
    with h5py.File(folder / "history.h5", "w") as file:
        motion = file.create_group("motion")
        motion["time"] = time
        motion["upgoing_acceleration"] = np.stack([0.5 * acceleration, 0.0 * time], axis=1)
        motion["upgoing_velocity"] = np.stack([spectrum.integral(0.5 * acceleration, 0.01), 0.0 * time], axis=1)
        file.create_group("gauges")["time"] = time[::10]
    (folder / "identity.json").write_text(json.dumps(settings or {}))
    return folder


def sliding(time, acceleration, yields, step):
    """Slip (m) of a block that resists with `yields` (m/s2) on level ground: trapezoidal velocity, clipped at rest."""
    fine = step * np.arange(int(round(time[-1] / step)) + 1)
    drive = -np.interp(fine, time, acceleration) - yields
    slip = speed = 0.0
    for gain in 0.5 * step * (drive[1:] + drive[:-1]):
        before, speed = speed, max(0.0, speed + gain)
        slip += 0.5 * step * (before + speed)
    return slip


def slip_of_run(yields):
    """Slip of the block beside a run, in g and m/s2 of 9.81, as a fine integration of the record itself.

    Tolerance: with steps of 20 us a block starts and stops up to a step off, of slips that last 20 ms or more, which
    changes their velocity by (1e-3)^2 and their way by 1e-3 of that at the end, where it is the least.
    """
    with tempfile.TemporaryDirectory() as folder:
        settings = {"static.gravity": "9.81 m/s2"}
        given = argparse.Namespace(folder=write_run(Path(folder), settings), angle=0.0, yields=yields, friction=None,
                                   material=None)
        result = newmark.analyse(given.folder, newmark.block_on_plane(given), 1, "block")
    exact = sliding(*record(), yields * GRAVITY, 2e-5)
    return abs(result["displacement"] / exact - 1), 1e-4


def gravity_of_case():
    """On the moon a plane yields at 1.62 m/s2 tan(phi - A); --yield stays in units of 9.80665 m/s2. To rounding."""
    angle, phi = np.radians(10.0), np.radians(25.0)
    given = argparse.Namespace(angle=10.0, yields=None, friction=np.tan(phi), slip=None, material=None)
    with tempfile.TemporaryDirectory() as folder:
        given.folder = write_run(Path(folder), {"static.gravity": "162 cm/s2"})
        friction = newmark.block_on_plane(given).yield_acceleration() / (1.62 * np.tan(phi - angle)) - 1
        given.friction, given.yields = None, 0.1
        yields = newmark.block_on_plane(given).yield_acceleration() / (0.1 * GRAVITY) - 1
        (given.folder / "identity.json").write_text("{}")  # a case that says nothing has 9.81
        given.friction, given.yields = np.tan(phi), None
        usual = newmark.block_on_plane(given).yield_acceleration() / (9.81 * np.tan(phi - angle)) - 1
    return np.abs([friction, yields, usual]).max(), 1e-12


def written_settings():
    """Numbers with units as a case or a program writes them; a residual of 0 Pa is none, and not the peak. Exact."""
    key = "materials.soil"
    soil = {f"{key}.model": "von_mises", f"{key}.strength.peak": "70kPa", f"{key}.softening.displacement": "0.2 m"}
    none = newmark.strengths(soil | {f"{key}.strength.residual": "0 Pa"}, "soil")
    left_out = newmark.strengths(soil, "soil")
    half = newmark.strengths(soil | {f"{key}.strength.residual": "3.5e4 Pa"}, "soil")
    wrong = [none[1], left_out[1] - left_out[0], half[1] / half[0] - 0.5, half[0] * np.sqrt(3) / 70e3 - 1,
             newmark.quantity({"a": "1.8 g/cm^3"}, "a") - 1800, newmark.quantity({"a": "0.56"}, "a") - 0.56]
    try:
        newmark.quantity({"a": "70 ksi"}, "a")
        wrong.append(1.0)
    except Missing:
        pass
    return np.abs(wrong).max(), 1e-12


def friction_of_material():
    """A slip_weakening material mobilises sin(atan(mu)) with match mc and mu with plane, at first and after its slip."""
    key = "materials.zone"
    zone = {f"{key}.model": "slip_weakening", f"{key}.friction.peak": "0.56", f"{key}.friction.residual": "0.07",
            f"{key}.critical_slip": "1.7 m"}
    after = 0.07 + 0.05 * (0.56 - 0.07)
    wrong = []
    for match, mobilised in (("mc", lambda mu: np.sin(np.arctan(mu))), ("plane", lambda mu: mu)):
        friction = newmark.mobilised_friction(zone | {f"{key}.match": match}, "zone")
        wrong += [friction(0.0) - mobilised(0.56), friction(1.7) - mobilised(after)]
    return np.abs(wrong).max(), 1e-12


def left_over():
    """An analysis that an earlier run left in the folder is not shown beside this one."""
    with tempfile.TemporaryDirectory() as folder:
        given = argparse.Namespace(folder=write_run(Path(folder)), angle=0.0, yields=0.05, friction=None, material=None)
        stored = newmark.analyse(given.folder, newmark.block_on_plane(given), 1, "block")
        (given.folder / "newmark.json").write_text(json.dumps(stored))
        kept = newmark.stored_or_estimated(given.folder)["block"] == "block"
        write_run(given.folder, {"another": "run"})
        try:
            newmark.stored_or_estimated(given.folder)
            told = False
        except Missing:  # there is no ground to estimate it from
            told = True
    return float(not kept or not told), 0.0


def checks():
    """Name and (error, tolerance) of every check."""
    yield "a rectangular pulse: (A T)^2 / 2 (1 / N - 1 / A)", rectangular_pulse()
    yield "a half sine in closed form", half_sine()
    yield "a plane beyond its friction angle, lifted", steep_plane()
    yield "the yield acceleration g tan(phi - A)", yield_of_plane()
    yield "it never moves uphill", uphill()
    yield "slip weakening as an adaptive integrator", slip_weakening()
    yield "energy of linear weakening", energy_of_weakening()
    yield "a pendulum without strength", pendulum()
    yield "the circle of a vertical cut: 3.83", vertical_cut()
    yield "a mirrored slope", mirrored()
    yield "slip of decimetres beside a run", slip_of_run(0.05)
    yield "slip of millimetres beside a run", slip_of_run(0.15)
    yield "slip of tenths of a millimetre beside a run", slip_of_run(0.2)
    yield "the case's gravity", gravity_of_case()
    yield "settings as they are written", written_settings()
    yield "friction that a material mobilises", friction_of_material()
    yield "an analysis of another run", left_over()


if __name__ == "__main__":
    sys.exit(report(checks()))
