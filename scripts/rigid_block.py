"""A rigid block that slides downhill on ground that shakes (Newmark 1965), with strength that may weaken with slip.

SI units; x points downhill. On a plane of inclination A, or turning on a circular arc, the slip d obeys

    d'' = gain ((g + a_y) sin A - a_x cos A - mu(d) n) - r(d),  n = max(0, (g + a_y) cos A + a_x sin A),

a_x, a_y being the ground's acceleration, mu friction and r a resistance per mass. On an arc of radius R, A = A_0 - d / R
is the inclination of the path of the centre of mass and gain = R r_g / k^2 (r_g its distance from the centre of the
circle, k^2 = I / M about it); on a plane R is infinite and gain is 1. The block never moves uphill.
"""
from dataclasses import dataclass, field

import numpy as np

STANDARD_GRAVITY = 9.80665  # m/s2, 1 g


def constant(value):
    """A strength that does not change with slip."""
    return lambda slip: value


def linear(peak, residual, length):
    """A strength that falls linearly from peak to residual over a slip of length (m)."""
    return lambda slip: peak - (peak - residual) * min(slip / length, 1.0)


def exponential(peak, residual, length):
    """A strength that falls to residual, 5 % of the drop being left at a slip of length (m)."""
    return lambda slip: residual + (peak - residual) * 0.05 ** (slip / length)


@dataclass
class Block:
    """See the module's equation."""

    angle: float  # rad, at the start
    friction: object = field(default_factory=lambda: constant(0.0))  # of slip in m
    resistance: object = field(default_factory=lambda: constant(0.0))  # m/s2, of slip
    gain: float = 1.0
    radius: float = np.inf  # m
    gravity: float = STANDARD_GRAVITY  # m/s2, that the block feels

    def acceleration(self, slip, ground):
        """d'' (m/s2) while it slides, for the ground's acceleration (a_x, a_y)."""
        angle = self.angle - slip / self.radius
        sine, cosine = np.sin(angle), np.cos(angle)
        down = self.gravity + ground[1]
        normal = max(0.0, down * cosine + ground[0] * sine)
        return self.gain * (down * sine - ground[0] * cosine - self.friction(slip) * normal) - self.resistance(slip)

    def yield_acceleration(self, slip=0.0):
        """Horizontal acceleration of the ground (m/s2, uphill) that just moves it; negative: it slides by itself."""
        angle, friction = self.angle - slip / self.radius, self.friction(slip)
        sine, cosine = np.sin(angle), np.cos(angle)
        resisting = self.resistance(slip) / self.gain - self.gravity * (sine - friction * cosine)
        return resisting / (cosine + friction * sine)


def rk4(block, slip, speed, length, ground):
    """Slip and speed after a step of length (s); the ground's acceleration goes linearly from ground[0] to ground[1]."""
    def rates(d, v, share):
        """Time derivatives of slip and speed at a share of the step."""
        return v, block.acceleration(d, ground[0] + share * (ground[1] - ground[0]))

    v1, a1 = rates(slip, speed, 0.0)
    v2, a2 = rates(slip + 0.5 * length * v1, speed + 0.5 * length * a1, 0.5)
    v3, a3 = rates(slip + 0.5 * length * v2, speed + 0.5 * length * a2, 0.5)
    v4, a4 = rates(slip + length * v3, speed + length * a3, 1.0)
    return slip + length / 6 * (v1 + 2 * v2 + 2 * v3 + v4), speed + length / 6 * (a1 + 2 * a2 + 2 * a3 + a4)


def stop_share(speed, before, after, length):
    """Share of the step at which the speed passes 0 from above; the acceleration goes linearly from before to after."""
    roots = np.roots([0.5 * (after - before) * length, before * length, speed])
    real = [root.real for root in roots if abs(root.imag) < 1e-9 and 1e-12 < root.real <= 1.0]
    return min(real, default=1.0)


def slide_over(block, slip, speed, length, ground):
    """Slip and speed after one interval (s), with its starts and stops."""
    done = 0.0  # share of the interval
    for _ in range(8):  # a start, a stop, and again; more cannot be within a linear piece
        here = ground[0] + done * (ground[1] - ground[0])
        begin, end = block.acceleration(slip, here), block.acceleration(slip, ground[1])
        if speed <= 0.0:
            if begin <= 0.0 and end <= 0.0:
                return slip, 0.0
            if begin <= 0.0:  # it starts where the linear excess passes 0
                done += (1.0 - done) * begin / (begin - end)
                here = ground[0] + done * (ground[1] - ground[0])
        rest = (1.0 - done) * length
        new_slip, new_speed = rk4(block, slip, speed, rest, (here, ground[1]))
        if new_speed >= 0.0:
            return new_slip, new_speed
        share = stop_share(speed, block.acceleration(slip, here), block.acceleration(new_slip, ground[1]), rest)
        slip, _ = rk4(block, slip, speed, share * rest, (here, here + share * (ground[1] - here)))
        speed, done = 0.0, done + share * (1.0 - done)
        if done >= 1.0:
            break
    return slip, 0.0


def slide(block, time, ground):
    """Slip (m) and speed (m/s) of the block at the times (s) of the ground's acceleration [time, (x, y)].

    Between samples the acceleration is linear; for strengths that do not change with slip the result is exact then.
    """
    ground = np.asarray(ground, dtype=float)
    slip, speed = np.zeros(len(time)), np.zeros(len(time))
    for k in range(1, len(time)):
        slip[k], speed[k] = slide_over(block, slip[k - 1], speed[k - 1], time[k] - time[k - 1], ground[k - 1:k + 1])
    return slip, speed
