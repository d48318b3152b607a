"""Numerical uncertainty of a number that was computed with cells of three sizes, some of them on shifted grids.

The grid convergence index (Roache 1998, Verification and Validation in Computational Science and Engineering; Celik et al.
2008, J. Fluids Eng. 130, 078001; ASME V&V 20-2009) for what the cells' size does, with the safety factor of Eca and
Hoekstra (2014, J. Comput. Phys. 262, 104-130) where no order is seen; Student's t for what the grid's place does.
"""
from dataclasses import dataclass

import numpy as np
from scipy.stats import t as student

SMOOTH, ROUGH = 1.25, 3.0    # safety factors with an observed order, and without
LOWEST, HIGHEST = 0.5, 3.0   # orders used: interfaces and bands have 1, waves 2 to 3 (cases/verification/layer)
TOO_HIGH = 4.0               # an order beyond it is none of the scheme's: the coarsest cells do not carry the answer
CONFIDENCE = 0.95
DOUBT = 0.5                  # of the 95 % scatter of a difference, by which it is taken against the order that it tells
SCATTER_POWER = 0.75         # of h, with which shifted grids deviate: misplaced interfaces ask for 1, bands on a row of cells for 0
FLOOR = 1e-4                 # of the value: what time steps, sampling and a record's own digits leave


@dataclass(frozen=True)
class Estimate:
    """A value and its uncertainty at 95 %, the observed order (None: none is seen) and how its answers converge.

    kind: "asymptotic"; "fast" (order beyond 4); "oscillating" (finer cells turn the other way); "slow" (order below a half,
    or diverging); "scatter" (cells of all sizes agree as well as shifted grids do); "two grids"; "one grid".
    error, scatter: the parts that cells' size and the grid's place have in it.
    """
    value: float
    uncertainty: float
    order: float | None
    kind: str
    error: float
    scatter: float


def scatter_of(levels):
    """Standard deviation of shifted grids over h^SCATTER_POWER, of all sizes of cells, and its degrees of freedom."""
    squares = sum(np.sum((values - np.mean(values, axis=0))**2, axis=0) / h**(2 * SCATTER_POWER) for h, values in levels)
    freedom = sum(len(values) - 1 for _, values in levels)
    return np.sqrt(squares / freedom) if freedom else 0.0 * squares, freedom


def observed_order(spacings, steps):
    """Order p with steps in the ratio of the differences of h^p, by halving; None below 0, at most 20.

    steps: differences of the answers on cells of three sizes, finest first, without their signs (Celik et al., step 3).
    """
    h = np.asarray(spacings) / spacings[0]
    if steps[1] <= steps[0] * np.log(h[2] / h[1]) / np.log(h[1]):  # the ratio for p = 0
        return None
    low, high = 0.0, 20.0
    for _ in range(50):
        p = 0.5 * (low + high)
        low, high = (p, high) if (h[2]**p - h[1]**p) * steps[0] < (h[1]**p - 1.0) * steps[1] else (low, p)
    return high


def extrapolated(spacings, step, order):
    """Error of the finest cells by Richardson: from the difference to the next, with an order within its limits."""
    order = min(max(order or 0.0, LOWEST), HIGHEST)
    return step / ((spacings[1] / spacings[0])**order - 1.0)


def fitted(spacings, means):
    """Error of the finest cells by least squares, m = m0 + a h with weights 1 / h^2."""
    h = np.asarray(spacings) / spacings[0]
    basis = np.stack([np.ones_like(h), h], axis=1) / h[:, None]
    return np.abs(np.linalg.lstsq(basis, (np.asarray(means).T / h).T, rcond=None)[0][1])


def order_of(spacings, steps, doubt):
    """How answers converge, the observed order, the one to extrapolate with, and its safety factor.

    steps: differences between sizes of cells, without their signs; doubt: their 95 % scatter.
    """
    if len(steps) == 1:
        return "two grids", None, 1.0, ROUGH
    order = observed_order(spacings, steps)
    if np.all(steps <= doubt):
        return "scatter", None, 1.0, ROUGH
    if order is None or order < LOWEST:
        return "slow", order, 1.0, ROUGH
    doubtful = observed_order(spacings, (steps[0] + DOUBT * doubt[0], steps[1] - DOUBT * doubt[1])) or 0.0
    return "fast" if order > TOO_HIGH else "asymptotic", order, max(doubtful, min(order, 1.0)), SMOOTH


def parts(levels):
    """Sizes of cells, means on each, their 95 % scatter, and that of one answer on the finest cells."""
    spacings = [spacing for spacing, _ in levels]
    deviation, freedom = scatter_of(levels)
    half = deviation * spacings[0]**SCATTER_POWER * (student.ppf(0.5 + CONFIDENCE / 2, freedom) if freedom else 0.0)
    spread = [half * (spacing / spacings[0])**SCATTER_POWER / np.sqrt(len(values)) for spacing, values in levels]
    return spacings, np.array([np.mean(values, axis=0) for _, values in levels]), np.array(spread), half


def estimate(levels):
    """The estimate from [(h, answers of that size of cells)], finest first; the very first answer is the case's own."""
    levels = [(spacing, np.asarray(values, dtype=float)) for spacing, values in levels]
    spacings, means, spread, half = parts(levels)
    value, kind, order, error = float(levels[0][1][0]), "one grid", None, 0.0
    if len(levels) > 1:
        signed, doubt = np.diff(means), np.hypot(spread[1:], spread[:-1])
        kind, order, used, factor = order_of(spacings, np.abs(signed), doubt)
        if kind == "scatter":
            error = factor * fitted(spacings, means)
        else:
            more = DOUBT * doubt[0] if kind in ("asymptotic", "fast") else 0.0
            error = factor * extrapolated(spacings, abs(signed[0]) + more, used)
        if kind in ("asymptotic", "fast") and signed[0] * signed[1] < 0:
            kind = "oscillating"
    uncertainty = max(float(np.hypot(error, half)), FLOOR * abs(value))
    return Estimate(value, uncertainty, order, kind, float(error), float(half))


def band(levels):
    """Uncertainties of a history from [(h, answers [grid, time])], finest first: one order for all of it, by its rms.

    An order point by point is noise where curves cross (Celik et al., section on profiles).
    """
    levels = [(spacing, np.asarray(values, dtype=float)) for spacing, values in levels]
    spacings, means, spread, half = parts(levels)
    error = 0.0 * half
    if len(levels) > 1:
        signed, doubt = np.diff(means, axis=0), np.hypot(spread[1:], spread[:-1])
        rms = lambda values: np.sqrt(np.nanmean(np.square(values), axis=1))
        kind, _, used, factor = order_of(spacings, rms(signed), rms(doubt))
        error = factor * (fitted(spacings, means) if kind == "scatter" else extrapolated(spacings, np.abs(signed[0]), used))
    return np.hypot(error, half)
