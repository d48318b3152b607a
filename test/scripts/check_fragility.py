"""Checks fragility curves against drawn data of known truth and against plain search; prints 'N passed, N failed'."""
import os
import sys

import numpy as np
from scipy.stats import chi2

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import fragility
from checking import report

MEDIAN, BETA = 0.3, 0.4


def drawn(generator, count):
    """Intensities about the median and whether the slope failed, by the true curve."""
    im = np.exp(generator.normal(np.log(MEDIAN), 0.6, count))
    return im, generator.random(count) < fragility.ndtr(np.log(im / MEDIAN) / BETA)


def truth():
    """Of 40 000 runs the truth comes out; errors in ln(median) and ln(beta) are 0.4 and 1 % by their standard error."""
    curve = fragility.fit(*drawn(np.random.default_rng(1), 40000))
    return max(abs(np.log(curve.median / MEDIAN)) / 0.004, abs(np.log(curve.beta / BETA)) / 0.01), 3.0


def coverage():
    """Limits at 90 % hold the truth in 90 % of 200 sets of 60 runs: within three standard errors, 6.4 %, and 2 % for few runs."""
    generator, median, beta, count = np.random.default_rng(2), 0, 0, 0
    while count < 200:
        try:
            curve = fragility.fit(*drawn(generator, 60))
        except fragility.NoFit:
            continue
        low, high = fragility.median_limits(curve, 0.9)
        median += low <= MEDIAN <= high
        low, high = fragility.beta_limits(curve, 0.9)
        beta += low <= BETA <= high
        count += 1
    return max(abs(median / count - 0.9), abs(beta / count - 0.9)), 0.084


def searched():
    """The maximum and the limits of both parameters by a search over a fine grid; its spacing is 0.2 and 0.5 %."""
    im, failed = drawn(np.random.default_rng(3), 80)
    curve = fragility.fit(im, failed)
    medians, betas = np.exp(np.arange(np.log(0.2), np.log(0.45), 0.002)), np.exp(np.arange(np.log(0.2), np.log(1.2), 0.005))
    a, b = -np.log(medians)[:, None] / betas, 1 / betas
    sign = np.where(failed, 1.0, -1.0)
    values = sum(fragility.log_ndtr(s * (a + b * x)) for s, x in zip(sign, np.log(im)))
    within = values > values.max() - 0.5 * chi2.ppf(0.95, 1)
    searched_median, searched_beta = medians[within.any(axis=1)], betas[within.any(axis=0)]
    found = np.log([*fragility.median_limits(curve), *fragility.beta_limits(curve)])
    error = np.abs(found - np.log([searched_median[0], searched_median[-1], searched_beta[0], searched_beta[-1]]))
    return max(error[:2].max() / 0.004, error[2:].max() / 0.01, (values.max() - curve.log_likelihood) / 1e-9), 1.0


def banded():
    """The band at the median is where the limits of the median say; at 50 % both are one question."""
    curve = fragility.fit(*drawn(np.random.default_rng(4), 80))
    low, high = fragility.median_limits(curve)
    edges = fragility.band(curve, np.array([low, high]))
    return abs(edges[1, 0] - 0.5) + abs(edges[0, 1] - 0.5), 1e-4


def without():
    """Data without a maximum are told so: all failed, none, a clean cut, one that does not grow, too few, one intensity."""
    x = np.arange(1.0, 7.0)
    wrong = 0
    for failed in ([1] * 6, [0] * 6, [0, 0, 0, 1, 1, 1], [1, 1, 0, 1, 0, 0]):
        try:
            fragility.fit(x, np.array(failed, dtype=bool))
            wrong += 1
        except fragility.NoFit:
            pass
    for few in (x[:2], np.ones(6)):
        try:
            fragility.fit(few, np.arange(len(few)) % 2 == 1)
            wrong += 1
        except fragility.NoFit:
            pass
    return float(wrong), 0.0


def by_records():
    """Draws of records give about the limits of the likelihood where each has one run, and wider ones where five say the same."""
    im, failed = drawn(np.random.default_rng(5), 100)
    curve = fragility.fit(im, failed)
    low, high = fragility.median_limits(curve)
    (drawn_low, drawn_high), _, _ = fragility.bootstrap(im, failed, np.arange(100), 300)
    again, _, _ = fragility.bootstrap(im, failed, np.arange(100), 300)
    one = np.repeat(np.arange(100), 5)
    (five_low, five_high), _, _ = fragility.bootstrap(im[one], failed[one], one, 300)
    narrow = fragility.median_limits(fragility.fit(im[one], failed[one]))
    width = np.log(high / low)
    assert again == (drawn_low, drawn_high), "the same seed gives the same limits"
    assert np.log(narrow[1] / narrow[0]) < 0.5 * width, "five times the runs seem to tell more"
    return max(abs(np.log(drawn_high / drawn_low) / width - 1), abs(np.log(five_high / five_low) / width - 1)), 0.15


def checks():
    """Name and (error, tolerance) of every check."""
    yield "drawn data give back their curve", truth()
    yield "limits hold the truth as often as they say", coverage()
    yield "maximum and limits by a plain search", searched()
    yield "the band meets the limits of the median", banded()
    yield "data that have no curve", without()
    yield "limits by records", by_records()


if __name__ == "__main__":
    sys.exit(report(checks()))
