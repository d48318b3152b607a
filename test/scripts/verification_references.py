"""Reference values of cases/verification, from the closed forms in the READMEs there.

    verification_references.py           compares the files with the closed forms
    verification_references.py --write   writes them anew
"""
import sys
from pathlib import Path

import numpy as np

CASES = Path(__file__).resolve().parents[2] / "cases" / "verification"
PEAK, LENGTH = 0.01, 0.12  # of the pulse, m/s and s

# density kg/m3, Young's modulus Pa, Poisson's ratio
ROCK = (2200.0, 250e6, 0.25)
STIFF = (2000.0, 100e6, 0.30)
SOIL = (1800.0, 40e6, 0.35)


def shear_speed(material):
    density, young, poisson = material
    return np.sqrt(young / (2 * (1 + poisson)) / density)


def p_modulus(material):
    _, young, poisson = material
    return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))


def pressure_speed(material):
    return np.sqrt(p_modulus(material) / material[0])


def pulse(t):
    """Upgoing velocity sin^4 (m/s)."""
    return np.where((t > 0) & (t < LENGTH), PEAK * np.sin(np.pi * t / LENGTH) ** 4, 0.0)


def table(columns, remark):
    """Text of a CSV file: columns by name."""
    lines = [f"# {remark}", ",".join(columns)]
    lines += [",".join(f"{value:.12g}" for value in row) for row in zip(*columns.values())]
    return "\n".join(lines) + "\n"


def pulse_record():
    t = np.arange(0, LENGTH + 1e-9, LENGTH / 400)
    return "".join(f"{a:.15g} {b:.15g}\n" for a, b in zip(t, pulse(t)))


def uniform_column():
    t = np.arange(1, 301) * 0.002
    depth = 20.0
    return table({"time": t, "velocity_x": 2 * pulse(t - depth / shear_speed(ROCK)),
                  "velocity_y": 2 * pulse(t - depth / pressure_speed(ROCK))},
                 "surface velocity in m/s over time in s")


def transfer(layers, base, speed, frequency):
    """|surface / outcrop| of layers (thickness m, material) from the surface down to the half-space `base`."""
    up = down = np.ones_like(frequency, dtype=complex)
    stack = [*layers, (0.0, base)]
    for (thickness, material), (_, below) in zip(stack, stack[1:]):
        k = 2 * np.pi * frequency / speed(material)
        ratio = material[0] * speed(material) / (below[0] * speed(below))
        forth, back = np.exp(1j * k * thickness), np.exp(-1j * k * thickness)
        up, down = (0.5 * up * (1 + ratio) * forth + 0.5 * down * (1 - ratio) * back,
                    0.5 * up * (1 - ratio) * forth + 0.5 * down * (1 + ratio) * back)
    return 1 / np.abs(up)


def amplification(layers, speed):
    frequency = np.arange(5, 201) * 0.05
    return table({"frequency": frequency, "amplification": transfer(layers, ROCK, speed, frequency)},
                 "surface over outcrop velocity, over frequency in Hz")


def self_weight():
    height, gravity = 20.0, 9.81
    y = np.linspace(0, height, 401)
    weight = ROCK[0] * gravity
    modulus = p_modulus(ROCK)
    # ln F = -weight (H - Y) / M, and the settlement is the integral of 1 - F.
    settlement = y - modulus / weight * (np.exp(-weight * (height - y) / modulus) - np.exp(-weight * height / modulus))
    return table({"height": y, "stress_yy": -weight * (height - y), "settlement": settlement},
                 "stress in Pa and settlement in m over the undeformed height in m")


REFERENCES = {
    "pulse.txt": pulse_record,
    "uniform_column/reference.csv": uniform_column,
    "layer/reference.csv": lambda: amplification([(10.0, SOIL)], shear_speed),
    "layer_p/reference.csv": lambda: amplification([(10.0, SOIL)], pressure_speed),
    "two_layers/reference.csv": lambda: amplification([(5.0, SOIL), (5.0, STIFF)], shear_speed),
    "self_weight/reference.csv": self_weight,
}


def numbers(text):
    lines = [line for line in text.splitlines() if line and line[0] not in "#abcdefghijklmnopqrstuvwxyz"]
    return np.array([[float(cell) for cell in line.replace(",", " ").split()] for line in lines])


def same(a, b):
    """Whether two tables agree but for the rounding of 12 digits."""
    a, b = numbers(a), numbers(b)
    return a.shape == b.shape and np.allclose(a, b, rtol=1e-9, atol=1e-12)


def main():
    wrong = []
    for name, make in REFERENCES.items():
        path = CASES / name
        if "--write" in sys.argv:
            path.write_text(make())
        elif not path.exists() or not same(path.read_text(), make()):
            wrong.append(name)
    for name in wrong:
        print(f"cases/verification/{name} is not what its closed form gives", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
