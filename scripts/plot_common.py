"""What the pictures of a run share: reading its files tolerantly, writing a picture."""
import json
import os
import sys
from pathlib import Path

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")  # the solver replaces files whole, so readers need no lock

import h5py
import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["text.parse_math"] = False  # names of cases, gauges and materials are no formulas, whatever they hold
matplotlib.rcParams["svg.hashsalt"] = "seismpm"  # the same picture of the same run, to the last byte
import matplotlib.pyplot as plt
import numpy as np
from cycler import cycler

WIDTH = 10.0  # inches, of every picture
FORMATS = ("png", "svg", "pdf")
# Okabe and Ito (2008), "Color universal design": lines that the colour-blind tell apart. More lines than these are dashed.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
AREAS = (*COLOURS, "#F0E442")  # yellow is for areas: a line of it is lost on white
matplotlib.rcParams["axes.prop_cycle"] = cycler(linestyle=("-", "--", ":")) * cycler(color=COLOURS)


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
        raise Missing("no history.h5 yet: it comes with the first checkpoint")
    return h5py.File(path, "r")


ENVELOPES = ("greatest_acceleration", "greatest_shear_strain", "greatest_shear_stress")


def envelopes(file, side):
    """Greatest values of a side's free-field column in an open history.h5, as (depth in m, value in SI) by the name of ENVELOPES.

    Empty where the history is of an older run, or the ground has no such column.
    """
    if f"free_field/{side}/middle_height" not in file:
        return {}
    column = file[f"free_field/{side}"]
    height, middle = column["height"][...], column["middle_height"][...]
    top = height[-1] + 0.5 * (height[-1] - height[-2])  # half a row above the uppermost
    return {name: (top - (middle if len(column[name]) == len(middle) else height), column[name][...]) for name in ENVELOPES}


def frame_times(folder):
    """Frames in order of time, as (time in s, path); unreadable ones are named and left out."""
    frames = []
    for path in folder.glob("frame-*.hdf"):
        try:
            with h5py.File(path, "r") as file:
                frames.append((float(np.ravel(file.attrs["time"])[0]), path))
        except (OSError, KeyError) as error:
            print(f"{path.name} left out: {error}", file=sys.stderr)
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


def label(name):
    """A name for a legend, which leaves out what begins with an underscore."""
    return " " + name if name.startswith("_") else name


def stage_of(folder, summary):
    """"static" or "seismic": as the folder's identity says, which is there from the first moment of a run."""
    try:
        identity = json.loads((folder / "identity.json").read_text())
        return identity["stage"]
    except (OSError, ValueError, KeyError, TypeError):
        pass
    shaken = (folder / "history.h5").exists() or any(folder.glob("frame-*.hdf"))
    return summary.get("stage") or ("seismic" if shaken else "static")


def state_of(summary):
    """What is to be said of a run that has not ended as it should, empty otherwise."""
    words = {0: "", 75: "interrupted", 80: "diverged", 81: "not converged"}
    code = summary.get("exit")
    return "not ended" if code is None else words.get(code, f"ended with {code}")


def heading_of(folder, summary):
    """Title of the pictures: name of the case (or of the folder) and of the motion, and that a run is not done."""
    name = text(summary.get("name") or folder.resolve().name)
    return ", ".join(part for part in (name, summary.get("motion_title"), state_of(summary)) if part)


def laid_out(figure):
    """The figure with its layout done and rounded: the solver of the layout differs in the last bits from one time to
    the next, which vector formats show in the names of their clipping paths."""
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    for axes in figure.axes:
        inside = axes.get_in_layout()
        axes.set_position(np.round(axes.get_position(original=True).bounds, 9))
        axes.set_in_layout(inside)
    return figure


def write(figure, path, **named):
    """Writes a picture in the format of its name, without the date, and says so."""
    laid_out(figure)
    dateless = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}
    figure.savefig(path, dpi=150, metadata=dateless.get(Path(path).suffix), **named)
    plt.close(figure)
    print(path)


def titled(figure, heading):
    """The figure, with its heading."""
    figure.suptitle(heading, fontsize=11)
    return figure


def save(figure, path, heading):
    """Writes a picture with its heading, cut to what is drawn."""
    write(titled(figure, heading), path, bbox_inches="tight")
