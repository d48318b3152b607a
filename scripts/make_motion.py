#!/usr/bin/env python3
"""Makes the synthetic outcrop motion of the default cases.

    scripts/make_motion.py [--out FILE] [--seed N] [--pga G]

Stochastic method (Boore 2003): white noise under a time envelope, shaped in the frequency domain to the acceleration
spectrum of an omega-squared source with path and site damping. A smooth window at low frequency stands for the
baseline correction of a real record; the padded start and end and a low-order correction in the displacement leave the
ground at rest where it began. The Python standard library suffices; the same seed gives the same file.
"""

import cmath
import math
import pathlib
import random

from options import Parser

G = 9.80665  # m/s2
DT = 0.01  # s
COUNT = 4000
CORNER = 0.35  # Hz, of the source
KAPPA = 0.040  # s, of path and site
LOW_CUT = 0.10  # Hz
START, RISE, LENGTH = 2.0, 0.20, 34.0  # s, share of length, s: the envelope


def fft(x, sign):
    """Discrete Fourier transform of a list whose length is a power of two, unscaled."""
    if len(x) == 1:
        return x
    even, odd = fft(x[0::2], sign), fft(x[1::2], sign)
    half = len(x) // 2
    turned = [cmath.exp(sign * 1j * math.pi * k / half) * odd[k] for k in range(half)]
    return [even[k] + turned[k] for k in range(half)] + [even[k] - turned[k] for k in range(half)]


def envelope(t):
    """Saragoni-Hart: 1 at START + RISE * LENGTH, 0.05 at START + LENGTH."""
    s = (t - START) / LENGTH
    if s <= 0:
        return 0.0
    b = -RISE * math.log(0.05) / (1 + RISE * (math.log(RISE) - 1))
    c = b / RISE
    return (s / RISE) ** b * math.exp(-c * (s - RISE))


def spectrum(f):
    """Shape of the acceleration spectrum at f in Hz."""
    source = f**2 / (1 + (f / CORNER) ** 2)
    low_cut = (f / LOW_CUT) ** 8 / (1 + (f / LOW_CUT) ** 8)
    return source * math.exp(-math.pi * KAPPA * f) * low_cut


def noise(seed):
    """Gaussian white noise under the envelope (Box-Muller on the one stream that Python keeps stable)."""
    uniform = random.Random(seed).random
    out = []
    for i in range(COUNT):
        radius = math.sqrt(-2 * math.log(1 - uniform()))
        out.append(radius * math.cos(2 * math.pi * uniform()) * envelope(i * DT))
    return out


def shaped(x):
    """x with the spectrum's shape; zero pads keep the ends from meeting."""
    size = 4 * 2 ** math.ceil(math.log2(COUNT))
    before = (size - COUNT) // 2
    transform = fft([0.0] * before + x + [0.0] * (size - COUNT - before), -1)
    for k in range(size):
        transform[k] *= spectrum(min(k, size - k) / (size * DT))
    return [value.real / size for value in fft(transform, 1)][before : before + COUNT]


def tapered(x, length):
    """x with cosine tapers of `length` in s at both ends."""
    out = list(x)
    for i in range(int(length / DT)):
        w = 0.5 * (1 - math.cos(math.pi * i * DT / length))
        out[i] *= w
        out[-1 - i] *= w
    return out


def integral(x):
    """Running integral over time by trapezoids, 0 at first."""
    out = [0.0]
    for left, right in zip(x, x[1:]):
        out.append(out[-1] + 0.5 * DT * (left + right))
    return out


def at_rest(a):
    """a less two smooth pulses, so that velocity and displacement end at 0."""
    total = (COUNT - 1) * DT
    pulses = []
    for n in (1, 2):
        pulses.append([(1 - math.cos(2 * math.pi * i / (COUNT - 1))) * (1 if n == 1 else i * DT / total) for i in range(COUNT)])
    ends = [(integral(p)[-1], integral(integral(p))[-1]) for p in pulses]
    v_end, u_end = integral(a)[-1], integral(integral(a))[-1]
    (p1, q1), (p2, q2) = ends
    det = p1 * q2 - p2 * q1
    c1, c2 = (v_end * q2 - p2 * u_end) / det, (p1 * u_end - v_end * q1) / det
    return [value - c1 * x - c2 * y for value, x, y in zip(a, *pulses)]


def peak(x):
    """Greatest magnitude."""
    return max(abs(value) for value in x)


def motion(seed, pga):
    """Acceleration in g."""
    a = at_rest(tapered(shaped(noise(seed)), 1.0))
    return [pga * value / peak(a) for value in a]


def at2(values, seed):
    """Text of a PEER file (.AT2) of the accelerations (g)."""
    lines = [
        "SYNTHETIC MOTION, NOT A RECORDING: SCRIPTS/MAKE_MOTION.PY, SEED %d" % seed,
        "OUTCROP, STOCHASTIC METHOD, OMEGA-SQUARED SOURCE WITH CORNER %.2f HZ, KAPPA %.3f S" % (CORNER, KAPPA),
        "ACCELERATION TIME SERIES IN UNITS OF G",
        "NPTS= %6d, DT= %7.4f SEC" % (len(values), DT),
    ]
    for i in range(0, len(values), 5):
        lines.append("".join(" % .7E" % (value + 0.0) for value in values[i : i + 5]))
    return "\n".join(lines) + "\n"


def measures(a):
    """PGA in g, PGV in m/s, PGD in m, D5-95 in s, final v in m/s and u in m."""
    v = integral([G * value for value in a])
    u = integral(v)
    husid = integral([value**2 for value in a])
    time = lambda part: DT * next(i for i, value in enumerate(husid) if value >= part * husid[-1])
    return peak(a), peak(v), peak(u), time(0.95) - time(0.05), v[-1], u[-1]


def main():
    """Makes the motion, writes it and prints its measures."""
    root = pathlib.Path(__file__).resolve().parent.parent
    parser = Parser(prog="make_motion", description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, default=root / "cases" / "motions" / "synthetic.AT2")
    parser.add_argument("--seed", type=int, default=8)
    parser.add_argument("--pga", type=float, default=0.25, help="in g")
    options = parser.parse_args()
    values = motion(options.seed, options.pga)
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text(at2(values, options.seed))
    print("%s: PGA %.3f g, PGV %.3f m/s, PGD %.3f m, D5-95 %.1f s, at the end v %.1e m/s, u %.1e m" % (options.out, *measures(values)))


if __name__ == "__main__":
    main()
