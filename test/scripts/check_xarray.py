"""Checks that xarray opens histories, frames and states with named dimensions; prints 'N passed, N failed'.

    check_xarray.py [FOLDER_OF_PROGRAMS]

Runs the first case for 3 s of its motion. Skipped where there is no xarray or h5netcdf.
"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

from checking import report

try:
    import h5netcdf
    import xarray
except ImportError as reason:
    h5netcdf = xarray = None
    LACKING = f"{reason} (Debian: python3-xarray, python3-h5netcdf)"

ROOT = Path(__file__).resolve().parent.parent.parent
PROGRAMS = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build"
CASE = ROOT / "cases" / "first" / "case.yaml"
DIMENSIONS = {
    "run/history.h5": {
        "gauges": {"displacement": ("time", "gauge", "component")}, "slide": {"toe": ("time",)},
        "free_field/left": {"surface_velocity": ("time", "component"), "greatest_acceleration": ("height",),
                            "greatest_shear_strain": ("middle_height",)},
        "energy": {"kinetic": ("time",)}, "motion": {"upgoing_velocity": ("time", "component")}},
    "run/frame-00001.hdf": {"particles": {"position": ("id", "component"), "stress": ("id", "stress_component"), "q": ("id",),
                                          "material": ("id",), "stress_xy": ("id",)}},
    "run/final.h5": {"particles": {"position": ("id", "component"), "affine": ("id", "affine_component"), "mass": ("id",)}},
    "static/final.h5": {"particles": {"stress": ("id", "stress_component")}, "free_field/left/particles": {"velocity": ("id", "component")}},
}


def opened(folder):
    """(path, group, dataset of xarray) of all that is named."""
    for path, groups in DIMENSIONS.items():
        for group in groups:
            with xarray.open_dataset(folder / path, group=group, engine="h5netcdf") as dataset:
                yield path, group, dataset


def dimensions(folder):
    """How many variables have other dimensions than they should."""
    return sum(dataset[name].dims != dims for path, group, dataset in opened(folder) for name, dims in DIMENSIONS[path][group].items()), 0


def words(folder):
    """How many variables of numbers lack their unit or their long name."""
    lacking = [f"{path}:{group}/{name}" for path, group, dataset in opened(folder) for name, values in dataset.variables.items()
               if values.dtype.kind in "fi" and not {"units", "long_name"} <= set(values.attrs)]
    if lacking:
        print("without units or long_name:", *lacking)
    return len(lacking), 0


def values(folder):
    """In how many variables xarray has other values than h5py."""
    wrong = 0
    for path, group, dataset in opened(folder):
        with h5py.File(folder / path) as file:
            wrong += sum(not np.array_equal(variable.values, file[group][name][...], equal_nan=True)
                         for name, variable in dataset.variables.items() if variable.dtype.kind in "fi")
    return wrong, 0


def selected(folder):
    """A particle by its id in frame and state, a component and a gauge by their names, and where the gauges stand."""
    read = {(path, group): dataset.load() for path, group, dataset in opened(folder)}
    frame, state, gauges = read["run/frame-00001.hdf", "particles"], read["run/final.h5", "particles"], read["run/history.h5", "gauges"]
    with h5py.File(folder / "run" / "final.h5") as file:
        row = int(np.flatnonzero(file["particles/id"][...] == 17)[0])
        wrong = not np.array_equal(state.sel(id=17).position.values, file["particles/position"][row])
        places = np.stack([file["gauges/reference_x"][...], file["gauges/reference_y"][...]])
    wrong += not np.array_equal(frame.stress.sel(stress_component="xy").values, frame.stress_xy.values)
    toe = gauges.displacement.sel(gauge="toe", component="y")
    wrong += not np.array_equal(np.stack([gauges.gauge_x.values, gauges.gauge_y.values]), places)
    wrong += not {"gauge_x", "gauge_y"} <= set(toe.coords) or abs(float(toe.gauge_x) - 55) > 0.5 or abs(float(toe.gauge_y) - 8) > 0.5
    return wrong, 0


def checks():
    """Name and (error, tolerance) of every check."""
    if xarray is None:
        yield "results in xarray", LACKING
        return
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        short = ("--set", "seismic.duration=3 s", "--set", "output.frames.every=2 s", "--quiet")
        for command in (("mpm-static", CASE, "--out", folder / "static", "--quiet"),
                        ("mpm-seismic", CASE, "--from", folder / "static/final.h5", "--out", folder / "run", *short)):
            subprocess.run([PROGRAMS / command[0], *command[1:]], check=True, capture_output=True)
        yield "dimensions have their names in xarray", dimensions(folder)
        yield "variables have their units and long names in xarray", words(folder)
        yield "values in xarray are those of h5py", values(folder)
        yield "particles, components and gauges are found by their names in xarray", selected(folder)


if __name__ == "__main__":
    os.environ["OMP_NUM_THREADS"] = "1"
    sys.exit(report(checks()))
