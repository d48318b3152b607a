"""Checks the fields of sections against closed forms, and films of them; prints 'N passed, N failed'."""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.ndimage import label

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts")
sys.path.insert(0, SCRIPTS)
import plot_fields
import plot_sections
from check_plots import write_frame
from checking import report

SETTINGS = {
    "materials.rock.model": "elastic",
    "materials.clay.model": "von_mises", "materials.clay.strength.peak": "60 kPa", "materials.clay.strength.residual": "20000 Pa",
    "materials.clay.softening.displacement": "0.3 m", "materials.clay.softening.band_width": "3 m",
    "materials.sand.model": "mohr_coulomb", "materials.sand.friction_angle.peak": "30 deg", "materials.sand.cohesion.peak": "10 kPa",
    "materials.zone.model": "slip_weakening", "materials.zone.friction.peak": "0.5", "materials.zone.friction.residual": "0.1",
    "materials.zone.critical_slip": "50 cm", "materials.zone.thickness": "2 m"}


def used(name, stress, strain=0.0):
    """Strength that one point uses."""
    return plot_fields.used_of_material(SETTINGS, name, np.array([stress], dtype=float), np.array([strain]))[0]


def von_mises():
    """Simple shear tau has q = sqrt(3) tau; half-way through softening the strength is half-way: 40 of 60 and 20 kPa."""
    half = 0.5 * 0.3 / (np.sqrt(3) * 3.0)
    errors = [used("clay", [-5e4, -5e4, -5e4, 1e4]) - np.sqrt(3) * 1e4 / 6e4,
              used("clay", [0, 0, 0, 1e4], half) - np.sqrt(3) * 1e4 / 4e4,
              used("clay", [0, 0, 0, 1e4], 1.0) - np.sqrt(3) * 1e4 / 2e4, used("clay", [0, 0, 0, 1e5]) - 1]
    return np.abs(errors).max(), 1e-12


def mohr_coulomb():
    """Under a lateral pressure s3 a column carries s3 N + 2 c sqrt(N), N = tan2(45 + phi / 2): 3 at 30 degrees."""
    lateral = 2e4
    most = 3 * lateral + 2 * 1e4 * np.sqrt(3)
    at_limit = used("sand", [-lateral, -most, -lateral, 0])
    # Halfway in the sense of the law: (s1 - s3) over 2 c cos(phi) - (s1 + s3) sin(phi).
    below = used("sand", [-lateral, -2 * lateral, -lateral, 0])
    return max(abs(at_limit - 1), abs(below - lateral / (2e4 * np.sqrt(0.75) + 1.5 * lateral))), 1e-12


def slip_weakening():
    """After the critical slip 5 % of the drop in friction are left; sin(atan(mu)) p is what sqrt(J2) may be."""
    strain = 0.5 / (np.sqrt(3) * 2.0)
    errors = []
    for e, mu in ((0.0, 0.5), (strain, 0.1 + 0.05 * 0.4)):
        errors.append(used("zone", [-1e5, -1e5, -1e5, 5e3], e) - 5e3 / (np.sin(np.arctan(mu)) * 1e5))
    return np.abs(errors).max(), 1e-12


def elastic():
    """Ground that cannot yield uses no strength, and one under tension that has friction alone uses all."""
    return float(not np.isnan(used("rock", [0, 0, 0, 1e9]))) + abs(used("zone", [1e3, 1e3, 1e3, 0]) - 1), 0


def gaps():
    """A band that slip has drawn out to four times the distance between particles is drawn without a hole."""
    x, y = (part.ravel() for part in np.meshgrid(np.arange(0, 60, 0.5), np.arange(0, 20, 0.5)))
    in_band = (np.abs(y - 10) < 1) & (np.round(2 * x) % 4 == 0)  # every fourth particle of four rows
    keep = in_band | (np.abs(y - 10) >= 1)
    particles = {"position": np.stack([x, y], axis=1)[keep], "size": np.full(keep.sum(), 0.5)}
    plot_sections.add_pixels(particles, plot_sections.common_extent([particles]), 600)
    return float(label(particles["pixels"] < 0)[1] - 1), 0  # one piece: what is around


def area():
    """Ground is drawn as large as its particles are, to the half pixel that is added all around."""
    x, y = (part.ravel() for part in np.meshgrid(np.arange(0, 60, 0.5), np.arange(0, 20, 0.5)))
    particles = {"position": np.stack([x, y], axis=1), "size": np.full(len(x), 0.5)}
    left, right, low, high = extent = plot_sections.common_extent([particles])
    plot_sections.add_pixels(particles, extent, 600)
    pixel = (right - left) / 600
    drawn = (particles["pixels"] >= 0).mean() * (right - left) * (high - low)
    return abs(drawn / (60 * 20) - 1), 160 * pixel / (60 * 20)


def films():
    """A film has a frame for each of the run's, all of one size; it is not replaced unasked."""
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        (folder / "identity.json").write_text(json.dumps(SETTINGS))
        for number in range(4):
            write_frame(folder, number, 0.5 * number)

        def film(*words):
            """Exit code of the script, and what it says."""
            done = subprocess.run([sys.executable, os.path.join(SCRIPTS, "film.py"), *map(str, words)], capture_output=True,
                                  text=True, check=False)
            return done.returncode, done.stderr

        out = folder / "pictures" / "displacement.webp"
        wrong += [film(folder, "--field", "displacement")[0] != 0]
        with Image.open(out) as made:
            wrong += [made.n_frames != 4, made.format != "WEBP"]
        wrong += [film(folder, "--field", "displacement")[0] != 73, "--field" not in film(folder, "--feild", "q")[1],
                  film(folder, "--out", folder / "a.gif")[0] != 64, film(folder, "--from", "9", "--field", "q")[0] != 66,
                  film(folder / "none")[0] != 66, film(folder, "--field", "velocity")[0] != 66]  # the frames have none
        return float(sum(wrong)), 0


def checks():
    """Name and (error, tolerance) of every check."""
    for check in (von_mises, mohr_coulomb, slip_weakening, elastic, gaps, area, films):
        yield check.__doc__, check()


if __name__ == "__main__":
    sys.exit(report(checks()))
