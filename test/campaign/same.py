"""Whether two folders hold the same results, bit for bit: but for who wrote them, when, and what befell the runs on the way."""
import json
import os
import re
from pathlib import Path

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

import h5py
import numpy as np

WHO = {"program", "version", "git", "build", "command", "created", "host"}            # attributes of a file's root
TECHNICAL = {"DIMENSION_LIST", "REFERENCE_LIST"}                                      # references, as HDF5 numbers them
WHAT_BEFELL = {"warnings", "frame_digests"}                                           # datasets: those of the log; when frames were written
OF_SUMMARY = {"threads", "wall_seconds", "ns_per_particle_step", "phases", "command", "warnings", "digests", "folder"}
IGNORED = re.compile(r"log\.txt|\.lock|.*\.(err|exit)|.*\.unusable|points\.jsonl")
OF_STATE = ("summary.png", "report.html")  # show the digest of the state that the run began with, which tells when that was written
CHECKPOINT = re.compile(r"checkpoint-\d+\.h5")


def value_of(value):
    """Bytes of a dataset or attribute, in any type."""
    value = np.asarray(value)
    if value.dtype.kind == "O":  # text; digests of files tell when those were written
        lines = [v.decode() if isinstance(v, bytes) else str(v) for v in np.ravel(value)]
        return "\n".join(line for line in lines if not line.startswith("from = ")).encode()
    return str(value.dtype).encode() + str(value.shape).encode() + value.tobytes()


def contents_of(path):
    """{path of a dataset or attribute: its bytes} of an HDF5 file."""
    found = {}
    with h5py.File(path, "r") as file:
        def take(name, item):
            for key in item.attrs:
                if key not in TECHNICAL and not (name == "" and key in WHO):
                    found[f"{name}@{key}"] = value_of(item.attrs[key])
            if isinstance(item, h5py.Dataset) and name.split("/")[-1] not in WHAT_BEFELL:
                found[name] = value_of(item[...])
        take("", file)
        file.visititems(take)
    return found


def of_json(path):
    """What a JSON file of a run tells, without what differs from run to run."""
    found = json.loads(path.read_text())
    if path.name == "finished.json":
        return sorted(found["files"])
    if path.name == "identity.json":
        found.pop("from", None)
    if path.name in ("uncertainty.json", "newmark.json"):
        found.get("run", {}).pop("identity", None)  # is a digest of identity.json, with that of the state in it
    if path.name == "summary.json":
        found = {key: value for key, value in found.items() if key not in OF_SUMMARY}
    return found


def difference(one, other):
    """In words, how two files differ; empty: not."""
    if one.suffix in (".h5", ".hdf"):
        a, b = contents_of(one), contents_of(other)
        names = sorted(name for name in a.keys() | b.keys() if a.get(name) != b.get(name))
    elif one.suffix == ".json":
        a, b = of_json(one), of_json(other)
        if isinstance(a, list) or isinstance(b, list):
            names = ["its content"] * (a != b)
        else:
            names = sorted(name for name in a.keys() | b.keys() if a.get(name) != b.get(name))
    else:
        names = ["its content"] * (one.name not in OF_STATE and one.read_bytes() != other.read_bytes())
    return ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")


def files_in(folder):
    """Paths of a folder's results, relative to it."""
    return {path.relative_to(folder) for path in Path(folder).rglob("*") if path.is_file() and not IGNORED.fullmatch(path.name)}


def differences(whole, other):
    """Lines that name every file in which `other` differs from `whole`."""
    a, b = files_in(whole), files_in(other)
    # The last checkpoint of a run that does not come to its end stays, where it was stopped on the way.
    b -= {name for name in b - a if CHECKPOINT.fullmatch(name.name) and not (Path(other) / name.parent / "finished.json").exists()
          and (Path(whole) / name.parent / "summary.json").exists()}
    lines = [f"{name} is missing" for name in sorted(a - b)] + [f"{name} is too many" for name in sorted(b - a)]
    for name in sorted(a & b):
        what = difference(Path(whole) / name, Path(other) / name)
        if what:
            lines.append(f"{name} differs: {what}")
    return lines or ([] if a else ["there is nothing to compare"])
