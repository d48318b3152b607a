"""Checks what vary reads from a run and how resolve-motion turns and cuts a record; prints 'N passed, N failed'."""
import argparse
import os
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import resolve_motion
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


def cut():
    """From 1 s until 3 s of a record of 0.5 s steps: its third to sixth value; and nothing beyond its end."""
    values = np.arange(10.0)
    error = np.abs(resolve_motion.cut(values, 0.5, 1.0, 3.0) - [2, 3, 4, 5]).max()
    error += np.abs(resolve_motion.cut(values, 0.5, 0.0, None) - values).max()
    try:
        resolve_motion.cut(values, 0.5, 5.0, None)
    except resolve_motion.BadRecord:
        return error, 0.0
    return 1.0, 0.0


def contradictions():
    """Records in other units, with DT in ms or with more values than NPTS are refused, a plain one is read."""
    head = "A\nB\nACCELERATION IN UNITS OF G\n"
    refused = 0
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "r.AT2"
        for text in ("NPTS= 3, DT= 10 MSEC\n1 2 3\n", "NPTS= 2, DT= .01 SEC\n1 2 3\n", "NPTS= 3, DT= .01 SEC\n1 nan 3\n"):
            path.write_text(head + text)
            try:
                resolve_motion.read(path)
            except resolve_motion.BadRecord:
                refused += 1
        other = Path(folder) / "n.AT2"
        other.write_text(head.replace("UNITS OF G", "UNITS OF CM/S/S") + "NPTS= 3, DT= .01 SEC\n1 2 3\n")
        path.write_text(head + "NPTS= 3, DT= .01 SEC\n1 2 3 0 0\n")
        try:
            resolve_motion.make(argparse.Namespace(east=path, north=other, azimuth=90.0, begin=0.0, end=None))
        except resolve_motion.BadRecord:
            refused += 1
        return abs(resolve_motion.read(path)[2] - 0.01) + abs(refused - 4), 0.0


def turned():
    """East and north of a motion along azimuth 215 give it back."""
    motion, azimuth = np.array([1.0, -2.0, 0.5]), 215.0
    east, north = motion * np.sin(np.radians(azimuth)), motion * np.cos(np.radians(azimuth))
    return np.abs(resolve_motion.resolve(east, north, azimuth) - motion).max(), 4 * np.finfo(float).eps


def refused():
    """Records whose step, values or units are not what they seem are refused; one as PEER writes it is read. Exact."""
    told = "NPTS= 4, DT= .01 SEC"
    files = {"good": ("UNITS OF G", told, "1 2 3 4"), "slow": ("UNITS OF G", "NPTS= 4, DT= 10 MSEC", "1 2 3 4"),
             "hole": ("UNITS OF G", told, "1 NaN 3 4"), "gal": ("UNITS OF CM/S2", told, "1 2 3 4")}
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        for name, lines in files.items():
            (Path(folder) / name).write_text("\n".join(("RECORD", "EVENT", *lines)) + "\n")
        for east, north in (("good", "good"), ("slow", "good"), ("hole", "good"), ("good", "gal")):
            options = argparse.Namespace(east=f"{folder}/{east}", north=f"{folder}/{north}", azimuth=0.0, begin=0.0,
                                         end=None)
            try:
                step = resolve_motion.make(options)[2]
                wrong += (east, north) != ("good", "good") or step != 0.01
            except resolve_motion.BadRecord:
                wrong += (east, north) == ("good", "good")
    return float(wrong), 0.0


def checks():
    """Name and (error, tolerance) of every check."""
    yield "the measures of a slide", measured()
    yield "a toe that does not get so far", never()
    yield "a record cut", cut()
    yield "records that contradict themselves", contradictions()
    yield "east and north turned back", turned()
    yield "records that are not what they seem", refused()


if __name__ == "__main__":
    sys.exit(report(checks()))
