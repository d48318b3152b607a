"""Checks what vary reads from a run; prints 'N passed, N failed'."""
import argparse
import os
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import vary
from checking import report


def write_history(folder):
    """A slide of 200 m2, half of it moved from 3 s on, that passes x = 50 m after 6 s and is fastest at 8 s."""
    time = np.arange(11.0)
    with h5py.File(folder / "history.h5", "w") as file:
        slide = file.create_group("slide")
        slide["time"], slide["moved_area"] = time, np.minimum(200.0, np.maximum(0.0, 50.0 * (time - 1)))
        slide["toe"] = np.where(time < 1, np.nan, 10 * (time - 1))
        slide["centre_of_mass_displacement"] = np.stack([3 * time, -4 * time], axis=1)
        slide["peak_velocity"], slide["point_velocity"] = 2 * time, 30 - np.abs(time - 8)
        gauges = file.create_group("gauges")
        gauges["time"], gauges["gauge"] = time, ["A", "B"]
        gauges["velocity"] = np.zeros((11, 2, 2))
        gauges["velocity"][7, 1] = (6.0, -8.0)
        gauges["displacement"] = np.zeros((11, 2, 2))


def measured():
    """The measures of that slide, times with 30 s added; exact."""
    with tempfile.TemporaryDirectory() as folder:
        write_history(Path(folder))
        row = vary.measures(Path(folder), argparse.Namespace(start=30.0, at=34.0, gauge="B", beyond=50.0))
    wanted = [33.0, 10.0, 37.0, 8.0, 20.0, 30.0, 37.0, 50.0, 200.0]
    return max(abs(a - b) for a, b in zip(row.values(), wanted)) + abs(len(row) - len(wanted)), 1e-12


def never():
    """A toe that does not get so far has no time, and the table says so."""
    with tempfile.TemporaryDirectory() as folder:
        write_history(Path(folder))
        row = vary.measures(Path(folder), argparse.Namespace(start=0.0, at=None, gauge=None, beyond=1e3))
    return float(row["toe beyond 1000 m (s)"] is not None or "never" not in vary.table({"a": row})), 0.0


def checks():
    """Name and (error, tolerance) of every check."""
    yield "the measures of a slide", measured()
    yield "a toe that does not get so far", never()


if __name__ == "__main__":
    sys.exit(report(checks()))
