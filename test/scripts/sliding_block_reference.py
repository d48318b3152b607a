"""Makes cases/verification/sliding_block/reference.csv: Newmark's rigid block with a constant resistance."""
import os

import numpy

SLOPE, GRAVITY, DENSITY, THICKNESS, STRENGTH = numpy.radians(14), 9.81, 2400.0, 20.0, 200e3
STEP, EVERY, END = 1e-5, 0.02, 6.6  # s


def shaking(t):
    envelope = numpy.sin(numpy.pi * (t - 1) / 5) ** 2 * ((t > 1) & (t < 6))
    return 5 * envelope * numpy.sin(2 * numpy.pi * (t - 1))


def slide():
    """Slip (m) every EVERY: at rest until the drive passes the resistance, then resisted until it stops."""
    drive = GRAVITY * numpy.sin(SLOPE) + shaking((numpy.arange(round(END / STEP)) + 0.5) * STEP)
    resistance = STRENGTH / (DENSITY * THICKNESS)
    slip, speed, taken = 0.0, 0.0, []
    for k, a in enumerate(drive):
        speed = max(0.0, speed + STEP * (a - resistance))
        slip += STEP * speed
        if (k + 1) % round(EVERY / STEP) == 0:
            taken.append(slip)
    return taken


def main():
    folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "cases", "verification", "sliding_block")
    slip = slide()
    time = (numpy.arange(len(slip)) + 1) * EVERY
    numpy.savetxt(os.path.join(folder, "reference.csv"), numpy.column_stack([time, slip]), fmt=["%.2f", "%.6f"],
                  delimiter=",", comments="", header="# s, m: by test/scripts/sliding_block_reference.py\ntime,slip")


if __name__ == "__main__":
    main()
