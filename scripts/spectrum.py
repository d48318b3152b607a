"""Response spectra and intensity measures of ground motions.

Accelerations in m/s2, times and periods in s. The oscillator u'' + 2 xi w u' + w^2 u = -a(t), at rest at the first
sample, is advanced exactly for an acceleration that is linear between samples (Nigam & Jennings 1969).
"""
import numpy as np
from scipy.integrate import cumulative_trapezoid
from scipy.interpolate import CubicSpline
from scipy.linalg import expm
from scipy.signal import lfilter

GRAVITY = 9.80665  # m/s2
STEPS_PER_PERIOD = 20  # a peak between two samples is then missed by at most 1 - cos(pi/20) = 1.2 %


def default_periods(count=160):
    """Periods (s) from 0.02 s to 5 s, evenly spaced in the logarithm."""
    return np.geomspace(0.02, 5.0, count)


def refine(acceleration, dt, longest_step):
    """The same piecewise-linear acceleration (m/s2) with a step (s) of at most longest_step; returns also that step."""
    parts = max(1, int(np.ceil(dt / longest_step - 1e-9)))
    if parts == 1:
        return acceleration, dt
    coarse = np.arange(len(acceleration))
    fine = np.arange((len(acceleration) - 1) * parts + 1) / parts
    return np.interp(fine, coarse, acceleration), dt / parts


def exact_step(angle, damping):
    """Matrices of x_1 = A x_0 + b_0 a_0 + b_1 a_1 over one step of phase angle w dt (rad).

    The state x is (u w^2, u' w), both in m/s2, the acceleration is linear from a_0 to a_1.
    """
    rates = np.zeros((4, 4))  # state, acceleration, and its increase over the step
    rates[0, 1] = angle
    rates[1, :3] = -angle, -2.0 * damping * angle, -angle
    rates[2, 3] = 1.0
    step = expm(rates)
    return step[:2, :2], step[:2, 2] - step[:2, 3], step[:2, 3]


def oscillator(acceleration, dt, period, damping=0.05, quantity="displacement"):
    """History of one oscillator at the given samples, in m/s2.

    quantity: "displacement" (w^2 times the relative one, the pseudo-acceleration), "velocity" (w times the relative
    one) or "acceleration" (the absolute one).
    """
    row = {"displacement": (1.0, 0.0), "velocity": (0.0, 1.0), "acceleration": (-1.0, -2.0 * damping)}[quantity]
    matrix, before, after = exact_step(2.0 * np.pi * dt / period, damping)
    # The recurrence of the state, written for one quantity alone: y(z)/a(z) = row (z I - A)^-1 (b_0 + z b_1).
    turned = matrix - np.trace(matrix) * np.eye(2)
    numerator = [row @ after, row @ (before + turned @ after), row @ (turned @ before)]
    denominator = [1.0, -np.trace(matrix), np.linalg.det(matrix)]
    at_rest = -acceleration[0] * np.array([row @ after, row @ (turned @ after)])
    return lfilter(numerator, denominator, acceleration, zi=at_rest)[0]


def pseudo_acceleration(acceleration, dt, periods, damping=0.05):
    """Pseudo-acceleration spectrum w^2 max|u| (m/s2) at the periods (s)."""
    acceleration = np.asarray(acceleration, dtype=float)
    values = np.empty(len(periods))
    for k, period in enumerate(periods):
        fine, step = refine(acceleration, dt, period / STEPS_PER_PERIOD)
        values[k] = np.abs(oscillator(fine, step, period, damping)).max()
    return values


def acceleration_of(time, velocity, dt=None):
    """Acceleration (m/s2) from a velocity history (m/s) as the slope of its cubic spline; returns it and its step (s).

    Samples may be uneven; the result is even, with step dt (default: the median of the given steps).
    """
    dt = float(np.median(np.diff(time))) if dt is None else dt
    even = time[0] + dt * np.arange(int(np.floor((time[-1] - time[0]) / dt + 1e-6)) + 1)
    return CubicSpline(time, velocity)(np.minimum(even, time[-1]), 1), dt


def integral(values, dt):
    """Running integral by the trapezoidal rule, 0 at the first sample."""
    return cumulative_trapezoid(values, dx=dt, initial=0.0)


def arias_history(acceleration, dt):
    """Arias intensity up to each sample, pi/(2 g) times the integral of a^2 (m/s)."""
    return 0.5 * np.pi / GRAVITY * integral(np.square(acceleration), dt)


def arias_intensity(acceleration, dt):
    """Arias intensity (m/s)."""
    return arias_history(acceleration, dt)[-1]


def significant_duration(acceleration, dt, start=0.05, end=0.95):
    """Time (s) between the given fractions of the Arias intensity; D5-95 by default, 0 for a motion that is nil."""
    history = arias_history(acceleration, dt)
    if history[-1] == 0.0:
        return 0.0
    first, last = np.interp([start, end], history / history[-1], dt * np.arange(len(history)))
    return last - first


def cumulative_absolute_velocity(acceleration, dt):
    """CAV, the integral of |a| (m/s), exact for an acceleration that is linear between samples."""
    before, after = acceleration[:-1], acceleration[1:]
    size = np.abs(before) + np.abs(after)
    crossing = before * after < 0.0  # two triangles
    areas = np.where(crossing, (before**2 + after**2) / np.where(crossing, size, 1.0), size)
    return 0.5 * dt * areas.sum()


def intensity_measures(acceleration, velocity, dt):
    """PGA (m/s2) and its time (s), PGV (m/s), Arias intensity (m/s), CAV (m/s) and D5-95 (s) of a motion, by name."""
    at = int(np.abs(acceleration).argmax())
    return {"pga": abs(acceleration[at]), "pga_time": at * dt, "pgv": np.abs(velocity).max(),
            "arias": arias_intensity(acceleration, dt), "cav": cumulative_absolute_velocity(acceleration, dt),
            "d5_95": significant_duration(acceleration, dt)}


def peaks(acceleration, dt):
    """PGA (m/s2), PGV (m/s) and PGD (m), the velocity and displacement by trapezoidal integration from rest."""
    velocity = integral(acceleration, dt)
    return tuple(np.abs(history).max() for history in (acceleration, velocity, integral(velocity, dt)))
