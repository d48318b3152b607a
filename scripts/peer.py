"""Records in the format of PEER: a header with NPTS and DT, then the values; others as the programs read them."""
import os
import re
import subprocess
import sys

import numpy as np

GRAVITY = 9.80665  # m/s2
UNITS = {"G": GRAVITY, "CM/S/S": 0.01, "CM/S2": 0.01, "CM/SEC2": 0.01, "CM/SEC/SEC": 0.01, "GAL": 0.01, "M/S/S": 1.0, "M/S2": 1.0, "M/SEC2": 1.0}


class BadRecord(Exception):
    """Says what is wrong with a record; the program ends with 65."""


def text_of(path, words):
    """A record as PEER writes it: what is none of PEER's, or comes with more words, mpm-seismic reads."""
    if str(path).upper().endswith(".AT2") and not words:
        with open(path, encoding="latin-1") as file:
            return file.read()
    with open(path, "rb"):
        pass  # says by itself why it cannot be read
    from programs import PROGRAMS  # looked for only where they are wanted
    read = subprocess.run([PROGRAMS / "mpm-seismic", "--print-record", "--motion", path, *words], capture_output=True, text=True, check=False)
    if read.returncode:
        raise BadRecord(read.stderr.strip().removeprefix("mpm-seismic: "))
    print(read.stderr, end="", file=sys.stderr)
    return read.stdout


def read(path, words=()):
    """Header lines and values of a PEER file, and its time step in s; of others as `words`, options of mpm-seismic, tell."""
    lines = text_of(path, words).splitlines()
    for k, line in enumerate(lines[:10]):
        count = re.search(r"NPTS\s*=\s*(\d+)", line, re.IGNORECASE) or re.match(r"\s*(\d+)\s+[\d.]+\s+NPTS", line)
        step = re.search(r"DT\s*=\s*([\d.E+-]+)\s*([A-Z]*)", line, re.IGNORECASE) \
            or re.match(r"\s*\d+\s+([\d.]+)\s+NPTS()", line)
        if count and step:
            break
    else:
        raise BadRecord(f"{path}: no header line with NPTS and DT, as PEER's .AT2 has one")
    if step[2].upper() not in ("", "S", "SEC", "SECS", "SECOND", "SECONDS"):
        raise BadRecord(f"{path}: DT is in {step[2]}; write it in SEC")
    try:
        values = np.array(" ".join(lines[k + 1 :]).split(), dtype=float)
    except ValueError as error:
        raise BadRecord(f"{path}: {error}") from error
    if not np.isfinite(values).all():
        raise BadRecord(f"{path}: value {int(np.argmin(np.isfinite(values))) + 1} is no finite number")
    if values.size < int(count[1]) or values[int(count[1]) :].any():
        raise BadRecord(f"{path}: the header tells of {count[1]} values, there are {values.size}")
    return lines[:k], values[: int(count[1])], float(step[1])


def acceleration(path, words=()):
    """Title, acceleration (m/s2) and step (s) of a record."""
    header, values, step = read(path, words)
    unit = re.search(r"ACCELERATION.*UNITS?\s+OF\s+(\S+)", header[-1] if header else "", re.IGNORECASE)
    if not unit or unit[1].upper() not in UNITS:
        raise BadRecord(f"{path}: '{header[-1] if header else ''}' tells of no acceleration in a known unit; "
                        "give ACCELERATION TIME SERIES IN UNITS OF G")
    if step <= 0 or values.size < 5:
        raise BadRecord(f"{path}: {values.size} values every {step:g} s are no motion")
    return header[-2].strip() if len(header) > 1 else "", UNITS[unit[1].upper()] * values, step


def write(path, header, values, step):
    """Writes a PEER file of the header's lines and the values, every `step` (s); whole or not at all."""
    temporary = path + ".part"
    with open(temporary, "w", encoding="ascii") as file:
        file.write("\n".join(header) + f"\nNPTS= {values.size:6d}, DT= {step:.9g} SEC\n")
        for k in range(0, values.size, 5):
            file.write("".join(f"{value:15.7E}" for value in values[k : k + 5]) + "\n")
    os.replace(temporary, path)
