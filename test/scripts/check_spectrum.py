"""Checks scripts/spectrum.py against closed forms and scipy; prints 'N passed, N failed', exit 1 on a failure."""
import os
import sys

import numpy as np
from scipy.signal import lsim

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import spectrum
from checking import report

DAMPING = 0.05
EPSILON = np.finfo(float).eps


def synthetic_motion(dt, duration=20.0):
    """A decaying sum of seeded sines from 0.3 to 12 Hz (m/s2), not zero at its first sample."""
    random = np.random.default_rng(1)
    time = np.arange(0.0, duration, dt)
    waves = [np.cos(2 * np.pi * f * time + random.uniform(0, 2 * np.pi)) for f in np.geomspace(0.3, 12.0, 25)]
    return time, np.exp(-((time - 6.0) / 5.0) ** 2) * np.sum(waves, axis=0)


def resonance():
    """A harmonic at the oscillator's own period is amplified 1/(2 xi) once steady.

    Tolerance: the start has left exp(-2 pi xi n) of the transient after n cycles, 100 samples a cycle miss up to
    1 - cos(pi/100) of a peak, and their chords are low by (2 pi/100)^2/12.
    """
    cycles, samples, period = 40, 100, 0.5
    time = np.arange(cycles * samples + 1) * period / samples
    value = spectrum.pseudo_acceleration(np.sin(2 * np.pi * time / period), period / samples, [period], DAMPING)[0]
    missed = 1 - np.cos(np.pi / samples)
    tolerance = np.exp(-2 * np.pi * DAMPING * cycles) + missed + (2 * np.pi / samples) ** 2 / 12
    return abs(value * 2 * DAMPING - 1), tolerance


def stiff_limit():
    """A very stiff oscillator follows the ground: Sa(T -> 0) = PGA.

    Tolerance: the ramp response lags by 2 xi/w, and each kink of the chords, a change of slope s, rings with s/w.
    """
    dt, period = 0.005, 1e-4
    _, acceleration = synthetic_motion(dt)
    pga = np.abs(acceleration).max()
    slope = np.abs(np.diff(acceleration)).max() / dt
    value = spectrum.pseudo_acceleration(acceleration, dt, [period], DAMPING)[0]
    return abs(value / pga - 1), (2 * DAMPING + 2) * slope * period / (2 * np.pi) / pga


def against_lsim(period, quantity):
    """Each history equals scipy's own exact integration of the same chords.

    Tolerance: both round once a step with relative error eps; a two-term recurrence passes a rounding on multiplied
    by up to 1/(w dt)^2, and it is remembered for 1/(xi w dt) steps.
    """
    dt = 0.005
    time, acceleration = synthetic_motion(dt)
    w = 2 * np.pi / period
    rows = {"displacement": [w**2, 0.0], "velocity": [0.0, w], "acceleration": [-(w**2), -2 * DAMPING * w]}
    system = ([[0, 1], [-(w**2), -2 * DAMPING * w]], [[0], [-1]], [rows[quantity]], [[0]])
    expected = lsim(system, acceleration, time)[1]
    ours = spectrum.oscillator(acceleration, dt, period, DAMPING, quantity)
    growth = (1 + 1 / (w * dt) ** 2) * (1 + 1 / (DAMPING * w * dt))
    return np.abs(ours - expected).max() / np.abs(acceleration).max(), 10 * EPSILON * growth


def refinement():
    """Refining a record does not change the response at its own samples (same chords, exact step)."""
    dt, period, parts = 0.02, 0.3, 7
    _, acceleration = synthetic_motion(dt)
    fine, step = spectrum.refine(acceleration, dt, dt / parts)
    coarse = spectrum.oscillator(acceleration, dt, period, DAMPING)
    difference = np.abs(spectrum.oscillator(fine, step, period, DAMPING)[::parts] - coarse).max()
    angle = 2 * np.pi * step / period
    growth = (1 + 1 / angle**2) * (1 + 1 / (DAMPING * angle))
    return difference / np.abs(acceleration).max(), 10 * EPSILON * growth


def intensity():
    """A constant acceleration: Arias intensity pi a^2 t/(2 g) and D5-95 of 90 % of the time, to rounding."""
    acceleration, dt = np.full(1001, 2.0), 0.01
    arias = 0.5 * np.pi / spectrum.GRAVITY * 4.0 * 10.0
    errors = [spectrum.arias_intensity(acceleration, dt) / arias - 1,
              spectrum.significant_duration(acceleration, dt) / 9.0 - 1]
    return np.abs(errors).max(), 1001 * EPSILON


def peak_values():
    """One full cycle of A sin(w t): PGA A, PGV 2A/w, PGD A T/w, to the (w dt)^2/12 of the trapezoidal rule."""
    samples, period = 400, 2.0
    dt, w = period / samples, 2 * np.pi / period
    got = spectrum.peaks(3.0 * np.sin(w * dt * np.arange(samples + 1)), dt)
    return np.abs(np.array(got) / [3.0, 6.0 / w, 3.0 * period / w] - 1).max(), (w * dt) ** 2 / 12 * 1.01


def slope_of_velocity():
    """The spline's slope is the derivative of a sine, on uneven samples, to about (w dt)^4."""
    w = 2 * np.pi
    time = np.linspace(0.0, 4.0, 401)
    time[1:-1] += 0.002 * np.sin(37.0 * np.arange(399))
    acceleration, dt = spectrum.acceleration_of(time, np.sin(w * time) / w, dt=0.01)
    return np.abs(acceleration - np.cos(w * dt * np.arange(len(acceleration))))[5:-5].max(), (w * 0.014) ** 4


def checks():
    """Name and (error, tolerance) of every check."""
    yield "a harmonic at resonance is amplified 1/(2 xi)", resonance()
    yield "Sa(T -> 0) is PGA", stiff_limit()
    for period in (0.05, 0.5, 5.0):
        for quantity in ("displacement", "velocity", "acceleration"):
            yield f"{quantity} at T = {period} s as scipy.signal.lsim", against_lsim(period, quantity)
    yield "refining the record changes nothing", refinement()
    yield "Arias intensity and D5-95 of a constant", intensity()
    yield "PGA, PGV and PGD of one sine cycle", peak_values()
    yield "acceleration from uneven velocity samples", slope_of_velocity()


if __name__ == "__main__":
    sys.exit(report(checks()))
