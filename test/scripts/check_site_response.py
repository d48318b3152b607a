"""Checks the response of a level site against closed forms of an elastic layer on rock; prints 'N passed, N failed'."""
import csv
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
from checking import report
from site_response import BAND, closed_form, transforms

ROOT = Path(__file__).resolve().parent.parent.parent
PROGRAMS = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build"
CASE = ROOT / "cases" / "verification" / "layer" / "case.yaml"
SOIL, ROCK = (10.0, 1800.0, np.sqrt(40e6 / 2.7 / 1800.0)), (10.0, 2200.0, np.sqrt(100e6 / 2200.0))  # thickness, density, c_s
RATIO = SOIL[1] * SOIL[2] / (ROCK[1] * ROCK[2])


def one_layer(frequency):
    """Kramer (1996), section 7.2.1: 1 / sqrt(cos^2 kH + alpha^2 sin^2 kH)."""
    phase = 2 * np.pi * frequency * SOIL[0] / SOIL[2]
    return 1 / np.sqrt(np.cos(phase) ** 2 + (RATIO * np.sin(phase)) ** 2)


def layered():
    """Layers by up- and downgoing waves: one layer, and the same cut in three; rounding."""
    frequency = np.linspace(0.1, 20.0, 200)
    third = (SOIL[0] / 3, *SOIL[1:])
    return max(np.abs(closed_form(layers, frequency) - one_layer(frequency)).max()
               for layers in ([SOIL, ROCK], [third, third, third, ROCK])), 1e-12


def transformed():
    """The transform of exp(-t) is 1 / sqrt(1 + (2 pi f)^2); a band of 5 % about 0.5 Hz and the step change that by 1 %."""
    time = np.arange(0.0, 20.0, 0.002)
    return abs(transforms(np.array([0.5]), 0.002, np.exp(-time))[0, 0] * np.sqrt(1 + np.pi**2) - 1), 0.01


def column(path, heading):
    """A column of a table, without what is empty."""
    with open(path, newline="") as file:
        return np.array([float(row[heading]) for row in csv.DictReader(file) if row[heading]])


def shaken(folder):
    """Amplification of the layer, and strain v / c_s and stress rho c_s v of the pulse that passes its middle."""
    command = [str(ROOT / "scripts" / "site-response"), str(CASE), "--out", str(folder), "--programs", str(PROGRAMS),
               "--set", "grid.particles_per_cell=2"]
    first = subprocess.run(command, capture_output=True, text=True, check=False)
    assert first.returncode == 0, first.stderr
    second = subprocess.run(command, capture_output=True, text=True, check=False)
    other = subprocess.run([*command, "--set", "materials.soil.density=1700 kg/m3"], capture_output=True, text=True, check=False)
    assert (second.returncode, other.returncode) == (0, 73) and second.stdout == first.stdout, second.stderr + other.stderr
    frequency = column(folder / "amplification.csv", "frequency (Hz)")
    model = column(folder / "amplification.csv", "surface / outcrop")
    low = frequency < 10.0
    exact = np.sqrt(np.mean([one_layer(share * frequency) ** 2 for share in BAND], axis=0))
    amplification = np.abs(model - exact)[low].max() / exact.max()
    velocity = 0.01 * 2.0 / (1.0 + RATIO)  # m/s, of the pulse once it has passed into the soil
    depth, strain = (column(folder / "profile.csv", heading) for heading in ("depth of the strain (m)", "greatest shear strain"))
    stress = column(folder / "profile.csv", "greatest shear stress (Pa)")
    middle = np.abs(depth - 5.0) < 1.5
    return (amplification, np.abs(strain[middle] / (velocity / SOIL[2]) - 1).max(),
            np.abs(stress[middle] / (SOIL[1] * SOIL[2] * velocity) - 1).max())


def checks():
    """Name and (error, tolerance) of every check."""
    yield "closed form of layers", layered()
    yield "Fourier transforms", transformed()
    with tempfile.TemporaryDirectory() as folder:
        amplification, strain, stress = shaken(Path(folder))
    yield "amplification of a layer on rock up to 10 Hz", (amplification, 0.02)
    yield "shear strain of a pulse", (strain, 0.02)
    yield "shear stress of a pulse", (stress, 0.05)


if __name__ == "__main__":
    os.environ["OMP_NUM_THREADS"] = "1"
    sys.exit(report(checks()))
