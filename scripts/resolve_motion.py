"""Turns the east and north components of a record into a direction: azimuth in degrees, clockwise from north. Cuts it.

    scripts/resolve-motion EAST.AT2 NORTH.AT2 --azimuth 215 --out records/CHY080-215.AT2
    scripts/resolve-motion VERTICAL.AT2 --from 26 --until 90 --out records/CHY080-V-from26.AT2

Reads PEER's .AT2, .VT2 and .DT2 files (a header with NPTS and DT, then the values) and writes one of the same kind:
sin(azimuth) east + cos(azimuth) north, or the one component as it is; of it what lies between two times in s.
"""

import argparse
import math
import os
import re
import sys

import numpy

from options import Parser


class BadRecord(Exception):
    """Says what is wrong with a record; the program ends with 65."""


def read(path):
    """Header lines and values of a PEER file, and its time step in s."""
    with open(path, encoding="latin-1") as file:
        lines = file.read().splitlines()
    for k, line in enumerate(lines[:10]):
        count = re.search(r"NPTS\s*=\s*(\d+)", line, re.IGNORECASE) or re.match(r"\s*(\d+)\s+[\d.]+\s+NPTS", line)
        step = re.search(r"DT\s*=\s*([\d.E+-]+)\s*([A-Z]*)", line, re.IGNORECASE) \
            or re.match(r"\s*\d+\s+([\d.]+)\s+NPTS()", line)
        if count and step:
            break
    else:
        raise BadRecord(f"{path}: no header line with NPTS and DT; give PEER's .AT2, .VT2 or .DT2")
    if step[2].upper() not in ("", "S", "SEC", "SECS", "SECOND", "SECONDS"):
        raise BadRecord(f"{path}: DT is in {step[2]}; write it in SEC")
    try:
        values = numpy.array(" ".join(lines[k + 1 :]).split(), dtype=float)
    except ValueError as error:
        raise BadRecord(f"{path}: {error}") from error
    if not numpy.isfinite(values).all():
        raise BadRecord(f"{path}: value {int(numpy.argmin(numpy.isfinite(values))) + 1} is no finite number")
    if values.size < int(count[1]) or values[int(count[1]) :].any():
        raise BadRecord(f"{path}: the header tells of {count[1]} values, there are {values.size}")
    return lines[:k], values[: int(count[1])], float(step[1])


def resolve(east, north, azimuth):
    """Component of (east, north) along an azimuth in degrees."""
    angle = math.radians(azimuth)
    return math.sin(angle) * east + math.cos(angle) * north


def cut(values, step, begin, end):
    """The values from time begin on and before time end (s); None: to the end."""
    first = round(begin / step)
    last = values.size if end is None else round(end / step)
    if not 0 <= first < last <= values.size:
        raise BadRecord(f"nothing lies from {begin:g} s to {last * step:g} s: the record is {values.size * step:g} s long")
    return values[first:last]


def write(path, header, values, step):
    """Writes a PEER file of the header's lines and the values, every `step` (s); whole or not at all."""
    temporary = path + ".part"
    with open(temporary, "w", encoding="ascii") as file:
        file.write("\n".join(header) + f"\nNPTS= {values.size:6d}, DT= {step:.9g} SEC\n")
        for k in range(0, values.size, 5):
            file.write("".join(f"{value:15.7E}" for value in values[k : k + 5]) + "\n")
    os.replace(temporary, path)


def arguments():
    """The command line."""
    parser = Parser(prog="resolve-motion", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("east", metavar="EAST", help="or the only component")
    parser.add_argument("north", metavar="NORTH", nargs="?")
    parser.add_argument("--azimuth", type=float, help="degrees, clockwise from north; with two components")
    parser.add_argument("--from", dest="begin", type=float, default=0.0, help="s of the record; default 0")
    parser.add_argument("--until", dest="end", type=float, help="s of the record; default its end")
    parser.add_argument("--out", required=True)
    options = parser.parse_args()
    if (options.north is None) != (options.azimuth is None):
        parser.error("two components go with --azimuth, one component goes without")
    return options


def make(options):
    """Header, values and time step (s) of the new record."""
    header, values, step = read(options.east)
    note = os.path.basename(options.east)
    if options.north:
        other_header, north, other_step = read(options.north)
        if header[-1:] != other_header[-1:]:  # quantity and unit
            raise BadRecord(f"the records differ: '{' '.join(header[-1:])}' and '{' '.join(other_header[-1:])}'")
        if step != other_step or values.size != north.size:
            raise BadRecord(f"the records differ: {values.size} values of {step} s and {north.size} of {other_step} s")
        values = resolve(values, north, options.azimuth)
        note += f" and {os.path.basename(options.north)}, azimuth {options.azimuth:g}"
    values = cut(values, step, options.begin, options.end)
    if options.begin:
        note += f", from {options.begin:g} s on"
    # The last line before NPTS tells quantity and unit; the one before it is ours.
    return header[:-2] + [note] + header[-1:], values, step


def main():
    """Makes and writes the record, prints its peak; returns the exit code."""
    options = arguments()
    try:
        header, values, step = make(options)
        os.makedirs(os.path.dirname(os.path.abspath(options.out)), exist_ok=True)
        write(options.out, header, values, step)
    except (OSError, BadRecord) as error:
        print(f"resolve-motion: {error}", file=sys.stderr)
        return 65 if isinstance(error, BadRecord) else 66
    peak = int(numpy.argmax(abs(values)))
    print(f"{options.out}: {values.size} values, peak {values[peak]:.4g} at {peak * step:.2f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
