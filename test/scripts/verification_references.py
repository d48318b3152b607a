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


def pulse_record(length=LENGTH):
    t = np.arange(0, length + 1e-9, length / 400)
    return "".join(f"{a:.15g} {b:.15g}\n" for a, b in zip(t, pulse(t * (LENGTH / length))))


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
    settlement = y - modulus / weight * np.exp(-weight * height / modulus) * np.expm1(weight * y / modulus)
    return table({"height": y, "stress_yy": -weight * (height - y), "settlement": settlement},
                 "stress in Pa and settlement in m over the undeformed height in m")


def free_vibration():
    return table({"period": [4 * 20.0 / shear_speed(ROCK)]}, "fundamental period in s")


def manufactured():
    """Along Y = 0.25 m at the end; amplitude 0.05 m, E = 10 MPa, nu = 0.3, rho = 1000 kg/m3."""
    amplitude, end, density, young, poisson, Y = 0.05, 0.0125, 1000.0, 1e7, 0.3, 0.25
    omega = np.pi * np.sqrt(young / density)
    shear = young / (2 * (1 + poisson))
    lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
    X = np.linspace(0, 1, 41)
    F_xx = 1 + amplitude * np.pi * np.cos(np.pi * X) * np.sin(omega * end)
    F_yy = 1 - amplitude * np.pi * np.cos(np.pi * Y) * np.sin(omega * end)
    return table({"X": X, "velocity_x": amplitude * omega * np.sin(np.pi * X) * np.cos(omega * end),
                  "stress_xx": lame * np.log(F_xx * F_yy) + 2 * shear * np.log(F_xx)},
                 "velocity in m/s and stress in Pa over X in m, at Y = 0.25 m and t = 0.0125 s")


def vortex():
    """Body force from the balance of momentum, with the stress differentiated numerically."""
    amplitude, period, density, shear, t = 0.15, 1.0, 1000.0, 1e4 / 2.6, 0.3
    turn = amplitude * (1 - np.cos(2 * np.pi * t / period)) / 2
    rate = amplitude * np.pi / period * np.sin(2 * np.pi * t / period)
    acceleration = 2 * amplitude * (np.pi / period) ** 2 * np.cos(2 * np.pi * t / period)

    def shape(R):
        return 1 - 32 * (R - 1) ** 2 + 256 * (R - 1) ** 4

    def stress(R):
        step = 1e-3
        gamma = R * turn * (8 * (shape(R + step) - shape(R - step)) - shape(R + 2 * step) + shape(R - 2 * step)) \
            / (12 * step)  # exact for a quartic
        return -shear * (1 - np.cos(gamma)), shear * np.sin(gamma)

    def slope(component, R, step=1e-3):
        f = [stress(R + k * step)[component] for k in (-3, -2, -1, 1, 2, 3)]
        return (-f[0] + 9 * f[1] - 45 * f[2] + 45 * f[3] - 9 * f[4] + f[5]) / (60 * step)

    R = np.linspace(0.76, 1.24, 25)
    rr, rt = stress(R)
    return table({"time": np.full_like(R, t), "R": R, "angle": shape(R) * turn, "stress_rr": rr, "stress_rt": rt,
                  "acceleration_r": -R * (shape(R) * rate) ** 2 - (slope(0, R) + 2 * rr / R) / density,
                  "acceleration_t": R * shape(R) * acceleration - (slope(1, R) + 2 * rt / R) / density},
                 "angle in rad, stress in Pa and body acceleration in m/s2 over R in m, at t = 0.3 s")


REFERENCES = {
    "pulse.txt": pulse_record,
    "level_site/pulse.txt": lambda: pulse_record(0.25),
    "free_vibration/reference.csv": free_vibration,
    "manufactured/reference.csv": manufactured,
    "vortex/reference.csv": vortex,
    "uniform_column/reference.csv": uniform_column,
    "layer/reference.csv": lambda: amplification([(10.0, SOIL)], shear_speed),
    "layer_p/reference.csv": lambda: amplification([(10.0, SOIL)], pressure_speed),
    "two_layers/reference.csv": lambda: amplification([(5.0, SOIL), (5.0, STIFF)], shear_speed),
    "self_weight/reference.csv": self_weight,
}


def numbers(text):
    """The rows below the names of a table's columns."""
    lines = [line for line in text.splitlines() if line and line[0] != "#"][1:]
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
