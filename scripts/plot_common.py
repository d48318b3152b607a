"""What the pictures of a run share: reading its files tolerantly, writing a picture."""
import argparse
import json
import os
import sys
from pathlib import Path

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")  # the solver replaces files whole, so readers need no lock

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

WIDTH = 10.0  # inches, of every picture


class Parser(argparse.ArgumentParser):
    """Ends with 64, as the solver does, on a wrong command line."""

    def error(self, message):
        self.exit(64, f"{self.prog}: {message}; see {self.prog} --help\n")


class Missing(Exception):
    """Says what a picture would need and the folder does not hold."""


def text(value):
    """A string from an HDF5 attribute, a dataset's entry or a JSON value."""
    return value.decode() if isinstance(value, bytes) else str(value)


def array(group, *names):
    """Array of the first dataset present among the names."""
    for name in names:
        if isinstance(group.get(name), h5py.Dataset):
            return group[name][...]
    raise Missing(f"{Path(group.file.filename).name} has no {' or '.join(names)} in {group.name}")


def group_of(file, name):
    """A group of an open file."""
    if name not in file:
        raise Missing(f"{Path(file.filename).name} has no /{name}")
    return file[name]


def open_history(folder):
    """history.h5 of a run folder, open for reading."""
    path = folder / "history.h5"
    if not path.exists():
        raise Missing("no history.h5")
    return h5py.File(path, "r")


def frame_times(folder):
    """Frames in order of time, as (time in s, path); unreadable ones are named and left out."""
    frames = []
    for path in folder.glob("frame-*.hdf"):
        try:
            with h5py.File(path, "r") as file:
                frames.append((float(np.ravel(file.attrs["time"])[0]), path))
        except (OSError, KeyError) as error:
            print(f"plot-run: {path.name} left out: {error}", file=sys.stderr)
    if not frames:
        raise Missing("no frame-*.hdf with a time")
    return sorted(frames)


def read_summary(folder):
    """summary.json as a dictionary, empty when there is none."""
    try:
        summary = json.loads((folder / "summary.json").read_text())
    except (OSError, ValueError):
        return {}
    return summary if isinstance(summary, dict) else {}


def heading_of(folder, summary):
    """Title of the pictures: name of the case (or of the folder) and of the motion."""
    name = text(summary.get("name") or folder.resolve().name)
    return f"{name}, {summary['motion_title']}" if summary.get("motion_title") else name


def save(figure, path, heading):
    """Writes a picture and says so."""
    figure.suptitle(heading, fontsize=11)
    figure.savefig(path, dpi=150, bbox_inches="tight")
    plt.close(figure)
    print(path)
