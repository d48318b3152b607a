"""How one motion is amplified over another: ratios of response spectra and of smoothed Fourier spectra.

Amplitude spectra are smoothed after Konno, K. and Ohmachi, T. (1998), "Ground-motion characteristics estimated from spectral
ratio between horizontal and vertical components of microtremor", Bull. Seism. Soc. Am. 88(1), 228-241, before they are
divided. Accelerations in m/s2, times in s, frequencies in Hz.
"""
import numpy as np

import spectrum

BANDWIDTH = 40.0  # b of Konno and Ohmachi: the window falls to half its weight at 6 % of the frequency to either side
SAMPLES_PER_CYCLE = 4  # fewer tell nothing


def fourier_amplitude(acceleration, dt, least_duration=0.0):
    """Frequencies (Hz) without 0, and |integral of a exp(-i w t) dt| (m/s), of a motion padded with zeros."""
    count = max(len(acceleration), int(np.ceil(least_duration / dt)))
    return np.fft.rfftfreq(count, dt)[1:], dt * np.abs(np.fft.rfft(acceleration, count))[1:]


def window(frequencies, centre, bandwidth=BANDWIDTH):
    """Weights (sin(b log10(f/fc)) / (b log10(f/fc)))^4, 1 in all."""
    weights = np.sinc(bandwidth * np.log10(frequencies / centre) / np.pi) ** 4
    return weights / weights.sum()


def smoothed(frequencies, amplitudes, centres, bandwidth=BANDWIDTH):
    """The amplitude spectrum as smoothed, at the centre frequencies (Hz)."""
    return np.array([window(frequencies, centre, bandwidth) @ amplitudes for centre in centres])


def band(motions):
    """Frequencies (Hz) that all motions, (acceleration, dt), tell about: 160, evenly spaced in the logarithm.

    Four cycles within the shortest and four samples a cycle in the coarsest, at most from 0.1 to 25 Hz.
    """
    lowest = max(0.1, *(4.0 / (len(acceleration) * dt) for acceleration, dt in motions))
    highest = min(25.0, *(1.0 / (SAMPLES_PER_CYCLE * dt) for _, dt in motions))
    return np.geomspace(lowest, highest, 160) if lowest < highest else np.empty(0)


def transfer_function(motion, reference, frequencies):
    """Amplification |motion| / |reference| of the smoothed amplitude spectra of two motions, (acceleration, dt)."""
    duration = max(len(acceleration) * dt for acceleration, dt in (motion, reference))
    over, under = (smoothed(*fourier_amplitude(*part, duration), frequencies) for part in (motion, reference))
    return over / np.where(under > 0.0, under, np.nan)


def spectral_ratio(motion, reference, periods, damping=0.05):
    """Ratio of the pseudo-acceleration spectra of two motions, (acceleration, dt), at the periods (s)."""
    over, under = (spectrum.pseudo_acceleration(*part, periods, damping) for part in (motion, reference))
    return over / np.where(under > 0.0, under, np.nan)
