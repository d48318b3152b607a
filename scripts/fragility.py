"""Fragility curves: the probability that a slope fails at an intensity of the shaking, and how sure that is.

P(failure | im) = Phi(ln(im / median) / beta), with median and logarithmic standard deviation beta of greatest likelihood: each
run is a Bernoulli trial at its intensity (Baker, J. W. (2015), "Efficient analytical fragility function fitting using dynamic
structural analysis", Earthquake Spectra 31, 579-599). With a = -ln(median) / beta, b = 1 / beta it is a probit line a + b ln(im),
whose log-likelihood is concave, so that Newton's method finds the one maximum. Intervals are those of the likelihood's profile: all values
for which twice the drop of the log-likelihood, maximised over the other parameter, is below the quantile of chi squared with
one degree of freedom. They take runs for independent; those of one record at several scales are not, for which `bootstrap`
draws whole records.
"""
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq
from scipy.special import log_ndtr, ndtr
from scipy.stats import chi2

FAR = 12.0  # in ln(im): how far limits are sought, a factor of 160 000


class NoFit(Exception):
    """Says why the data have no curve of greatest likelihood."""


@dataclass
class Curve:
    """A fitted curve and the data that it is of."""

    median: float  # in the unit of the intensity
    beta: float
    log_likelihood: float
    x: np.ndarray  # ln(im) of the runs
    failed: np.ndarray  # bool

    def probability(self, intensity):
        """P(failure) at intensities."""
        return ndtr(np.log(np.asarray(intensity) / self.median) / self.beta)


def likelihood(a, b, x, failed):
    """Log-likelihood of the probit line a + b x."""
    return log_ndtr(np.where(failed, 1.0, -1.0) * (a + b * x)).sum()


def greatest(x, failed, design, offset=0.0):
    """Greatest log-likelihood of offset + design @ parameters, and the parameters, by Newton's method with halved steps."""
    sign = np.where(failed, 1.0, -1.0)
    parameters = np.zeros(design.shape[1])
    best = log_ndtr(sign * (offset + design @ parameters)).sum()
    for _ in range(100):
        eta = sign * (offset + design @ parameters)
        ratio = np.exp(-0.5 * eta * eta - log_ndtr(eta)) / np.sqrt(2 * np.pi)  # phi / Phi
        curvature = design.T @ ((ratio * (ratio + eta))[:, None] * design)
        step = np.linalg.lstsq(curvature, design.T @ (sign * ratio), rcond=None)[0]
        for _ in range(40):
            now = log_ndtr(sign * (offset + design @ (parameters + step))).sum()
            if now >= best:
                break
            step = 0.5 * step
        parameters = parameters + step
        gain, best = now - best, max(now, best)
        if abs(gain) < 1e-12 * (1.0 + abs(best)):
            break
    return best, parameters


def fit(intensity, failed):
    """The curve of greatest likelihood of runs with intensities above 0; NoFit tells why there is none."""
    x, failed = np.log(np.asarray(intensity, dtype=float)), np.asarray(failed, dtype=bool)
    if len(x) < 3:
        raise NoFit(f"{len(x)} runs are too few")
    if failed.all() or not failed.any():
        raise NoFit("all runs failed" if failed.all() else "no run failed")
    if np.ptp(x) < 1e-6:
        raise NoFit("all runs have the same intensity")
    low, high = np.exp(x[~failed].max()), np.exp(x[failed].min())
    if high >= low:
        raise NoFit(f"all runs up to {low:.3g} stood and all from {high:.3g} on failed: the median lies between, beta cannot be told")
    middle = x.mean()
    best, (a, b) = greatest(x, failed, np.stack([np.ones_like(x), x - middle], axis=1))
    if b <= 0.0 or np.exp(x[~failed].min()) >= np.exp(x[failed].max()):
        raise NoFit("failure does not grow with the intensity")
    return Curve(float(np.exp(middle - a / b)), float(1.0 / b), float(best), x, failed)


def profile_at(curve, ln_intensity, eta):
    """Greatest log-likelihood of all lines through eta at an intensity."""
    return greatest(curve.x, curve.failed, (curve.x - ln_intensity)[:, None], eta)[0]


def limits(drop, centre, step):
    """Where a drop from its zero at centre reaches the threshold of 0, on both sides; infinite if beyond FAR."""
    found = []
    for sense in (-1.0, 1.0):
        near, far, width = centre, centre + sense * step, step
        while drop(far) < 0.0 and abs(far - centre) < FAR:
            width *= 1.6
            near, far = far, far + sense * width
        found.append(brentq(drop, near, far, xtol=1e-6) if drop(far) >= 0.0 else sense * np.inf)
    return tuple(found)


def median_limits(curve, level=0.95):
    """Limits of the median by the profile of the likelihood."""
    most = 0.5 * chi2.ppf(level, 1)
    drop = lambda t: curve.log_likelihood - profile_at(curve, t, 0.0) - most
    return tuple(float(np.exp(t)) for t in limits(drop, np.log(curve.median), 0.1 * curve.beta))


def beta_limits(curve, level=0.95):
    """Limits of beta likewise; an infinite one says that failure might not depend on the intensity."""
    most, x = 0.5 * chi2.ppf(level, 1), curve.x - np.log(curve.median)
    ones = np.ones((len(x), 1))
    drop = lambda t: curve.log_likelihood - greatest(x, curve.failed, ones, x * np.exp(-t))[0] - most
    return tuple(float(np.exp(t)) for t in limits(drop, np.log(curve.beta), 0.1))


def band(curve, intensity, level=0.95):
    """Limits of the probability at each intensity, [2, intensity], by the profile of the likelihood there."""
    most = 0.5 * chi2.ppf(level, 1)
    found = []
    for value in np.log(intensity):
        eta = (value - np.log(curve.median)) / curve.beta
        drop = lambda e: curve.log_likelihood - profile_at(curve, value, e) - most
        found.append(ndtr(limits(drop, eta, 0.1)))
    return np.array(found).T


def bootstrap(intensity, failed, record, count=500, seed=1, level=0.95):
    """Limits of median and beta by drawing whole records with replacement; and the share of draws that have no curve."""
    intensity, failed, record = np.asarray(intensity), np.asarray(failed), np.asarray(record)
    parts = [np.flatnonzero(record == name) for name in np.unique(record)]
    generator, found = np.random.default_rng(seed), []
    for _ in range(count):
        rows = np.concatenate([parts[k] for k in generator.integers(len(parts), size=len(parts))])
        try:
            curve = fit(intensity[rows], failed[rows])
            found.append((curve.median, curve.beta))
        except NoFit:
            pass
    if len(found) < 0.5 * count:
        raise NoFit(f"{count - len(found)} of {count} draws of records have no curve")
    outer = 50.0 * (1.0 - level)
    low, high = np.percentile(found, [outer, 100.0 - outer], axis=0)
    return (low[0], high[0]), (low[1], high[1]), 1.0 - len(found) / count
