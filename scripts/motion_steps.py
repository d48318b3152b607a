"""What is done to a motion, one step after the other; each is told in words. Accelerations in m/s2, times in s."""
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np
from scipy.fft import next_fast_len
from scipy.signal import butter, resample_poly, sosfiltfilt

import soil_column
import spectral_match
import spectrum
from peer import GRAVITY, BadRecord

ORDER = 4  # of the Butterworth filter, which goes forth and back
NOTHING = 1e-4  # of the greatest acceleration and velocity
LOUD, MOST_LOUD = 10.0, 1e-3  # an amplification that a deconvolution stops at, and the share of the energy that may lie beyond
RINGING = 1e-4  # share of the energy that may lie behind a convolved motion's end
ANGLES = np.arange(180)  # degrees, of RotD


@dataclass(frozen=True)
class Motion:
    """Acceleration (m/s2) every dt (s); its first sample lies `start` (s) behind the record's first; and what was done to it."""
    acceleration: np.ndarray
    dt: float
    start: float = 0.0
    done: tuple = ()

    def then(self, words, **changed):
        """The motion, changed, and that it was."""
        return replace(self, done=(*self.done, words), **changed)

    def padded(self, before, behind):
        """With so many zeros at its ends."""
        zeros = np.zeros(before), np.zeros(behind)
        return replace(self, acceleration=np.concatenate([zeros[0], self.acceleration, zeros[1]]), start=self.start - before * self.dt)


def along(east, north, azimuth):
    """Component of (east, north) along an azimuth, in degrees clockwise from north."""
    angle = np.radians(azimuth)
    return np.sin(angle) * east + np.cos(angle) * north


def rotated_spectra(east, north, dt, periods, damping=0.05):
    """Pseudo-acceleration (m/s2) of the components at all ANGLES of azimuth: a row for each period."""
    rows = []
    for period in periods:
        (first, step), (second, _) = (spectrum.refine(part, dt, period / spectrum.STEPS_PER_PERIOD) for part in (east, north))
        pair = [spectrum.oscillator(part, step, period, damping) for part in (first, second)]
        rows.append([np.abs(along(*pair, angle)).max() for angle in ANGLES])
    return np.array(rows)


def rotd_azimuth(east, north, dt, percentile, period):
    """The azimuth (degrees) whose Sa(period) is nearest to that percentile of those of all angles (Boore 2010)."""
    values = rotated_spectra(east, north, dt, [period])[0]
    return int(ANGLES[np.abs(values - np.percentile(values, percentile)).argmin()])


def cut(motion, begin, end):
    """From time begin on and before time end (s of the record); None: to the end."""
    first = round(begin / motion.dt)
    last = len(motion.acceleration) if end is None else round(end / motion.dt)
    if not 0 <= first < last <= len(motion.acceleration):
        raise BadRecord(f"nothing lies from {begin:g} s to {last * motion.dt:g} s: the record is {len(motion.acceleration) * motion.dt:g} s long")
    return motion.then(f"cut from {begin:g} s to {last * motion.dt:g} s", acceleration=motion.acceleration[first:last], start=first * motion.dt)


def resampled(motion, dt):
    """With another step (s), by a linear-phase low-pass below both Nyquist frequencies."""
    ratio = Fraction(motion.dt / dt).limit_denominator(1000)
    if ratio <= 0 or abs(ratio * dt / motion.dt - 1) > 1e-9:
        raise BadRecord(f"{motion.dt:g} s over {dt:g} s is no ratio of whole numbers up to 1000; choose another step")
    return motion.then(f"resampled from {motion.dt:g} s to {dt:g} s", dt=dt,
                       acceleration=resample_poly(motion.acceleration, ratio.numerator, ratio.denominator))


def filtered(motion, low, high):
    """Butterworth of 4th order from low to high (Hz; None: open), forth and back, so that there is no delay and corners keep a half.

    Zeros are put to both ends for what it spreads (Boore and Bommer 2005), and taken off again as far as nothing has come there.
    """
    nyquist, corners = 0.5 / motion.dt, [corner for corner in (low, high) if corner is not None]
    if not corners or corners != sorted(set(corners)) or corners[0] <= 0 or corners[-1] >= nyquist:
        raise BadRecord(f"a band has 0 < LOW < HIGH < {nyquist:g} Hz, which the record's step carries; one of both may be left out")
    kind = "bandpass" if len(corners) == 2 else "highpass" if low else "lowpass"
    sections = butter(ORDER, corners if len(corners) == 2 else corners[0], kind, fs=1 / motion.dt, output="sos")
    pad = int(np.ceil(1.5 * ORDER / corners[0] / motion.dt))
    values = sosfiltfilt(sections, motion.padded(pad, pad).acceleration, padtype=None)
    velocity = spectrum.integral(values, motion.dt)
    busy = np.flatnonzero((np.abs(values) > NOTHING * np.abs(values).max()) | (np.abs(velocity) > NOTHING * np.abs(velocity).max()))
    before, behind = max(0, pad - busy[0]), max(0, busy[-1] + 1 - pad - len(motion.acceleration))
    words = (f"Butterworth of order {ORDER}, zero phase, from {low or 0:g} to {high or nyquist:g} Hz, {before * motion.dt:g} s put before and "
             f"{behind * motion.dt:g} s behind")
    return motion.padded(before, behind).then(words, acceleration=values[pad - before : pad + len(motion.acceleration) + behind])


def straightened(motion, kind):
    """With the velocity's polynomial through the origin taken off, so that it ends at zero: what `baseline` of a case does."""
    s = np.linspace(0.0, 1.0, len(motion.acceleration))
    length = motion.dt * (len(s) - 1)
    velocity = spectrum.integral(motion.acceleration, motion.dt)
    slope = np.full(len(s), velocity[-1] / length)
    shapes = [(s * (s - 1), 2 * s - 1), (s * (s - 1) * (2 * s - 1), 6 * s**2 - 6 * s + 1)][: ("linear", "quadratic", "cubic").index(kind)]
    if shapes:
        base = np.stack([shape for shape, _ in shapes], axis=1)
        amounts = np.linalg.lstsq(base, velocity - velocity[-1] * s, rcond=None)[0]
        slope = slope + sum(amount * rate for amount, (_, rate) in zip(amounts, shapes)) / length
    return motion.then(f"baseline {kind}", acceleration=motion.acceleration - slope)


def tapered(motion, seconds):
    """With the velocity brought to rest by half a cosine at both ends."""
    time = motion.dt * np.arange(len(motion.acceleration))
    if not 0 < 2 * seconds < time[-1]:
        raise BadRecord(f"two tapers of {seconds:g} s do not fit into {time[-1]:g} s")
    near = np.minimum(time, time[-1] - time) / seconds
    inside = near < 1
    weight = np.where(inside, 0.5 - 0.5 * np.cos(np.pi * near), 1.0)
    rate = np.where(inside, 0.5 * np.pi / seconds * np.sin(np.pi * near), 0.0) * np.where(time < 0.5 * time[-1], 1, -1)
    velocity = spectrum.integral(motion.acceleration, motion.dt)
    return motion.then(f"velocity tapered over {seconds:g} s at both ends", acceleration=weight * motion.acceleration + rate * velocity)


def moved(motion, layers, recorded, wanted):
    """The motion at another place of a column of layers (soil_column.motion_at), with zeros for the time that waves take.

    Going down amplifies the more, the higher the frequency: from where it is LOUD for good nothing is taken, and little may be there.
    """
    count, dt = len(motion.acceleration), motion.dt
    before = behind = int(np.ceil(soil_column.travel_time(layers) / dt)) + 1
    while True:
        size = next_fast_len(2 * (count + before + behind), real=True)
        frequency = np.fft.rfftfreq(size, dt)
        ratio = soil_column.motion_at(layers, frequency, wanted) / soil_column.motion_at(layers, frequency, recorded)
        transformed = np.fft.rfft(motion.padded(before, behind).acceleration, size)
        loud = frequency > frequency[np.abs(ratio) <= LOUD].max(initial=0.0)
        share = np.sum(np.abs(transformed[loud]) ** 2) / np.sum(np.abs(transformed) ** 2)
        if share > MOST_LOUD:
            raise BadRecord(f"{100 * share:.2g} % of the motion's energy is above {frequency[loud][0]:.3g} Hz, which would be amplified more than "
                            f"{LOUD:g} times, with its noise: take it off by --band ,HIGH")
        result = np.fft.irfft(transformed * np.where(loud, 0.0, ratio), size)
        kept = count + before + behind
        total = np.sum(result**2)
        if np.sum(result[kept:] ** 2) <= RINGING * total:
            break
        behind *= 2
        if behind > 8 * count:
            raise BadRecord(f"the motion does not die away in the column: give its layers damping ({wanted} from {recorded})")
    words = f"{wanted} motion of {recorded} motion by 1D wave propagation, {before * dt:g} s put before" + (
        f", nothing above {frequency[loud][0]:.3g} Hz" if loud.any() else "")
    return motion.padded(before, behind).then(words, acceleration=result[:kept])


def matched(motion, periods, target):
    """With its spectrum matched to the target (m/s2); the words tell how well."""
    result, dt, before = spectral_match.matched(motion.acceleration, motion.dt, periods, target)
    mean, most = spectral_match.mismatch(result, dt, periods, target)
    words = (f"5 % spectrum matched from {periods[0]:g} to {periods[-1]:g} s by wavelets (Al Atik and Abrahamson 2010), step {dt:g} s, "
             f"{before * dt:g} s of zeros put before: off by {100 * mean:.1f} % on average, {100 * most:.1f} % at most")
    return motion.then(words, acceleration=result, dt=dt, start=motion.start - before * dt)


def scaled(motion, factor=None, pga=None, sa=None):
    """By a factor, or to a PGA (g), or to a 5 % Sa (period in s, g)."""
    words = f"scaled by {factor:g}" if factor is not None else ""
    if pga is not None:
        factor, words = pga * GRAVITY / np.abs(motion.acceleration).max(), f"scaled to PGA {pga:g} g"
    if sa is not None:
        factor = sa[1] * GRAVITY / spectrum.pseudo_acceleration(motion.acceleration, motion.dt, [sa[0]])[0]
        words = f"scaled to Sa({sa[0]:g} s) {sa[1]:g} g"
    return motion.then(words + ("" if pga is None and sa is None else f", by {factor:.4g}"), acceleration=factor * motion.acceleration)
