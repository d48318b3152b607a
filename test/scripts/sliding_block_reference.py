"""Makes cases/verification/sliding_block/reference.csv: an elastic column on a perfectly plastic layer, by finite
differences in one dimension."""
import os

import numpy

SLOPE, GRAVITY, DENSITY, MODULUS, STRENGTH = numpy.radians(14), 9.81, 2400.0, 1e9 / 2.6, 200e3  # shear modulus, Pa
HEIGHT, LAYER = 22.0, (2.0, 4.0)  # m above the fixed floor: rock, clay, rock
EVERY, END = 0.02, 6.6  # s


def shaking(t):
    if t < 1 or t > 6:
        return 0.0
    return 5 * numpy.sin(numpy.pi * (t - 1) / 5) ** 2 * numpy.sin(2 * numpy.pi * (t - 1))


def slide(cells):
    """Displacement (m) of the layer's upper face every EVERY; velocities at the nodes, stresses between them."""
    size = HEIGHT / cells
    steps = int(numpy.ceil(EVERY / (0.5 * size / numpy.sqrt(MODULUS / DENSITY))))
    step = EVERY / steps
    middle = (numpy.arange(cells) + 0.5) * size
    clay = (middle > LAYER[0]) & (middle < LAYER[1])
    mass = numpy.full(cells + 1, DENSITY * size)
    mass[-1] /= 2
    stress = DENSITY * GRAVITY * numpy.sin(SLOPE) * (HEIGHT - middle)
    velocity, way, top, taken = numpy.zeros(cells + 1), 0.0, round(LAYER[1] / size), []
    for k in range(round(END / EVERY) * steps):
        force = numpy.append(stress, 0.0)
        force[1:] -= stress
        force[0] = 0.0
        velocity[1:] += step * (force[1:] / mass[1:] + GRAVITY * numpy.sin(SLOPE) + shaking((k + 0.5) * step))
        way += step * velocity[top]
        stress += step * MODULUS * numpy.diff(velocity) / size
        stress[clay] = numpy.clip(stress[clay], -STRENGTH, STRENGTH)
        if (k + 1) % steps == 0:
            taken.append(way)
    return numpy.array(taken)


def main():
    folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "cases", "verification", "sliding_block")
    slip = slide(440)  # 220 cells differ by 0.1 %
    time = (numpy.arange(len(slip)) + 1) * EVERY
    numpy.savetxt(os.path.join(folder, "reference.csv"), numpy.column_stack([time, slip]), fmt=["%.2f", "%.6f"],
                  delimiter=",", comments="", header="# s, m: by test/scripts/sliding_block_reference.py\ntime,slip")


if __name__ == "__main__":
    main()
