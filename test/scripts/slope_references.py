"""Writes cases/verification/slope/reference.csv: factors of safety of the 2:1 slopes by Bishop's simplified method of
slices (Bishop 1955), the least over circles that stay above the rough base. Heights in units of H, stresses of rho g H."""
import pathlib

import numpy as np

SLICES = 200


def ground(x):
    return np.clip(0.5 * x, 0, 1)


def safety(centre, radius, friction, cohesion):
    """Of the mass between ground and circle; infinite where the circle cuts no slope."""
    x = np.linspace(max(centre[0] - radius, -2.4), min(centre[0] + radius, 4.4), 2001)
    arc = centre[1] - np.sqrt(np.maximum(radius**2 - (x - centre[0]) ** 2, 0))
    inside = np.flatnonzero(arc < ground(x) - 1e-9)
    if len(inside) < 50 or inside[-1] - inside[0] + 1 != len(inside):
        return np.inf
    if inside[0] == 0 or inside[-1] == len(x) - 1:  # cut off by the sides, or overhanging
        return np.inf
    edges = np.linspace(x[inside[0]], x[inside[-1]], SLICES + 1)
    middle, width = 0.5 * (edges[1:] + edges[:-1]), edges[1] - edges[0]
    sine = (middle - centre[0]) / radius
    cosine = np.sqrt(1 - sine**2)
    weight = width * (ground(middle) - (centre[1] - radius * cosine))
    driving = np.sum(weight * sine)
    if driving <= 1e-6:
        return np.inf
    factor, tangent = 1.5, np.tan(friction)
    for _ in range(100):
        m = cosine + sine * tangent / factor
        if np.any(m < 0.1):
            return np.inf
        new = np.sum((cohesion * width + weight * tangent) / m) / driving
        if abs(new - factor) < 1e-7:
            break
        factor = new
    return factor


def least(friction, cohesion, bottom=-1.0):
    best = (np.inf, 1.0, 2.0, 0.0)
    grid = [(np.linspace(-0.5, 2, 26), np.linspace(1.02, 4, 31), np.linspace(bottom, 0.1, 23))]
    for _ in range(3):
        for cx in grid[-1][0]:
            for cy in grid[-1][1]:
                for tangent in grid[-1][2]:
                    factor = safety((cx, cy), cy - tangent, friction, cohesion)
                    best = min(best, (factor, cx, cy, tangent))
        steps = [a[1] - a[0] for a in grid[-1]]
        around = [np.linspace(b - s, b + s, 9) for b, s in zip(best[1:], steps)]
        around[2] = np.clip(around[2], bottom, None)
        grid.append(around)
    return best


def main():
    clay = least(0.0, 0.25)
    soil = least(np.radians(20), 0.05)
    for name, found in (("clay", clay), ("soil", soil)):
        print(name, "factor %.4f, centre (%.2f, %.2f) H, down to %.2f H" % found)
    root = pathlib.Path(__file__).resolve().parents[2]
    (root / "cases/verification/slope/reference.csv").write_text(
        "# by test/scripts/slope_references.py: Bishop's simplified method, least over circles\n"
        "clay,soil\n%.4f,%.4f\n" % (clay[0], soil[0]))


if __name__ == "__main__":
    main()
