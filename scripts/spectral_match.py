"""Adds wavelets to a motion until its response spectrum is a wanted one.

Al Atik, L. and Abrahamson, N. (2010), "An improved method for nonstationary spectral matching", Earthquake Spectra 26(3), 601-617:
tapered cosines, which leave no drift, each where an oscillator has its greatest response; their amplitudes solve a linear system,
again and again, since greatest responses wander. Accelerations in m/s2, times and periods in s.
"""
import numpy as np

import spectrum

COUNT = 80  # periods that are matched, evenly spaced in the logarithm
ROUNDS = 20  # at most
GOOD_ENOUGH = 0.01  # greatest misfit at these periods
OFF_DIAGONAL = 0.7  # by which influences on other periods are multiplied: Al Atik and Abrahamson, for stability
WIDTHS = 3.0  # of a wavelet's taper that have to lie within the motion: exp(-9) is left beyond


def taper(period):
    """Width gamma of a wavelet (s): 1.178 f^-0.93, of the paper."""
    return 1.178 * period**0.93


def offset(period, damping):
    """How long the middle of a wavelet lies before the response that it changes most (s)."""
    root = np.sqrt(1.0 - damping**2)
    return np.arctan(root / damping) * period / (2.0 * np.pi * root)


def wavelets(time, periods, peaks, damping):
    """A row for each period: the wavelet whose oscillator responds most at its peak's time."""
    since = time - (peaks - offset(periods, damping))[:, None]
    return np.cos(2.0 * np.pi * np.sqrt(1.0 - damping**2) / periods[:, None] * since) * np.exp(-((since / taper(periods)[:, None]) ** 2))


def responses(acceleration, dt, periods, damping):
    """Index and value (m/s2, with its sign) of the greatest response of each oscillator."""
    histories = [spectrum.oscillator(acceleration, dt, period, damping) for period in periods]
    places = np.array([np.abs(history).argmax() for history in histories])
    return places, np.array([history[place] for history, place in zip(histories, places)])


def influences(count, dt, periods, places, damping):
    """A row for each period: what every sample of acceleration adds to its oscillator's response at the given place."""
    impulse = np.zeros(count + 1)
    impulse[1] = 1.0
    rows = np.zeros((len(periods), count))
    for row, period, place in zip(rows, periods, places):
        row[: place + 1] = spectrum.oscillator(impulse, dt, period, damping)[1 : place + 2][::-1]
    return rows


def room(acceleration, dt, periods, damping):
    """How many zeros the wavelets need before and behind the motion."""
    places, _ = responses(acceleration, dt, periods, damping)
    middle, width = places * dt - offset(periods, damping), WIDTHS * taper(periods)
    return [max(0, int(np.ceil(lacking.max() / dt))) for lacking in (width - middle, middle + width - dt * (len(acceleration) - 1))]


def matched(acceleration, dt, periods, target, damping=0.05):
    """The motion, matched between the first and the last of the periods to the target (m/s2); its step, and the zeros put before it.

    The step becomes a twentieth of the shortest period, where it was longer.
    """
    wanted = np.geomspace(periods[0], periods[-1], COUNT)
    aim = np.exp(np.interp(np.log(wanted), np.log(periods), np.log(target)))
    motion, dt = spectrum.refine(np.asarray(acceleration, dtype=float), dt, wanted[0] / spectrum.STEPS_PER_PERIOD)
    before, behind = room(motion, dt, wanted, damping)
    motion = np.concatenate([np.zeros(before), motion, np.zeros(behind)])
    motion *= np.exp(np.mean(np.log(aim / np.abs(responses(motion, dt, wanted, damping)[1]))))
    time = dt * np.arange(len(motion))
    best, least = motion, np.inf
    for _ in range(ROUNDS):
        places, values = responses(motion, dt, wanted, damping)
        misfit = np.abs(np.abs(values) / aim - 1.0).max()
        if misfit < least:
            best, least = motion, misfit
        if least < GOOD_ENOUGH:
            break
        rows = wavelets(time, wanted, dt * places, damping)
        matrix = influences(len(motion), dt, wanted, places, damping) @ rows.T
        matrix[~np.eye(COUNT, dtype=bool)] *= OFF_DIAGONAL
        motion = motion + np.linalg.solve(matrix, np.sign(values) * aim - values) @ rows
    return best, dt, before


def mismatch(acceleration, dt, periods, target, damping=0.05):
    """Mean and greatest |Sa / target - 1| at three times as many periods as are matched."""
    checked = np.geomspace(periods[0], periods[-1], 3 * COUNT + 1)
    aim = np.exp(np.interp(np.log(checked), np.log(periods), np.log(target)))
    off = np.abs(spectrum.pseudo_acceleration(acceleration, dt, checked, damping) / aim - 1.0)
    return off.mean(), off.max()
