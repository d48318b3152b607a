"""Checks what scripts/export writes, and that mpm-seismic reads it back; prints 'N passed, N failed'."""
import contextlib
import csv
import io
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import export
import peer
from check_plots import write_frame
from checking import report

CYCLES, PERIOD, PEAK, DT = 5, 1.0, 2.0, 0.005  # of a sine: s, m/s2, s
NAMES = ["crest", "a/b", "a b", "Böschung, µ"]
LEVEL = """
schema: seismpm-case/1
grid: {spacing: 1 m, particles_per_cell: 1}
domain: {x: [0 m, 4 m], bottom: 0 m}
surfaces: {ground: {points: [[0 m, 8 m]]}}
regions: [{material: rock, below: ground}]
materials: {rock: {model: elastic, density: 2200 kg/m3, young_modulus: 800 MPa, poisson_ratio: 0.25}}
static: {gravity: 0 m/s2}
seismic: {duration: 0.05 s, motion: {recorded_as: outcrop, horizontal: built_in, baseline: none}}
"""


def write_run(folder):
    """A run whose gauges all move as the sine, with a frame."""
    w = 2 * np.pi / PERIOD
    time = np.arange(0, CYCLES * PERIOD + 0.5 * DT, DT)
    velocity = PEAK / w * (1 - np.cos(w * time))
    moved = PEAK / w * (time - np.sin(w * time) / w)
    (folder / "identity.json").write_text(json.dumps({"stage": "seismic"}))
    write_frame(folder, 0, 0.0)
    with h5py.File(folder / "history.h5", "w") as file:
        file["gauges/time"], file["gauges/gauge"] = time, NAMES
        for name, values in (("velocity", velocity), ("displacement", moved)):
            file[f"gauges/{name}"] = np.tile(np.stack([values, 0 * values], axis=1)[:, None], (1, len(NAMES), 1))
        file["free_field/left/time"], file["free_field/left/surface_velocity"] = time, np.stack([velocity, 0 * velocity], axis=1)
        for name, values in (("height", [0.5, 1.5, 2.5]), ("middle_height", [1.0, 2.0]), ("greatest_acceleration", [1.0, 2.0, 3.0]),
                             ("greatest_shear_strain", [1e-3, 2e-3]), ("greatest_shear_stress", [5e3, 4e3])):
            file[f"free_field/left/{name}"] = np.array(values)
        file["slide/time"], file["slide/component"] = time, ["x", "y"]
        file["slide/centre_of_mass_displacement"] = np.stack([moved, -moved], axis=1)
        file["slide/centre_of_mass_displacement"].attrs["units"] = "m"
    return time, PEAK * np.sin(w * time), moved


def exported(*words):
    """Exit code, and what was said on stderr."""
    sys.argv, said = ["export", *map(str, words)], io.StringIO()
    with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
        try:
            return export.main(), said.getvalue()
        except SystemExit as end:
            return end.code, said.getvalue()


def columns(path):
    """Columns of a CSV file by their heads, as numbers where they are some."""
    with open(path, encoding="utf8", newline="") as file:
        head, *rows = csv.reader(file)
    number = lambda words: [float(word) for word in words] if words[0].lstrip("-")[:1].isdigit() or words[0] == "nan" else words
    return {name: np.array(number([row[k] for row in rows])) for k, name in enumerate(head)}


def tables(folder):
    """A gauge that moves as a sine has its acceleration (to (w dt)^4 of a spline), velocity and displacement."""
    time, acceleration, moved = write_run(folder)
    assert exported(folder)[0] == 0
    found = columns(folder / "export" / "gauge-crest.csv")
    slide = columns(folder / "export" / "slide.csv")
    errors = [np.abs(found["acceleration x (m/s2)"] - acceleration)[2:-2].max() / PEAK, np.abs(found["time (s)"] - time).max(),
              np.abs(found["displacement x (m)"] - moved).max(), np.abs(found["velocity y (m/s)"]).max(),
              np.abs(slide["centre of mass displacement y (m)"] + moved).max()]
    return max(errors), 1e-5


def at2(folder):
    """Its .AT2 holds the same in g, whatever the gauge is called, and no two gauges share a file."""
    _, acceleration, _ = write_run(folder)
    exported(folder)
    paths = sorted((folder / "export").glob("gauge-*-x.AT2"))
    errors = [np.abs(9.80665 * peer.read(path)[1] - acceleration)[2:-2].max() / PEAK for path in paths]
    return max(errors) + abs(len(paths) - len(NAMES)) + abs(peer.read(paths[0])[2] - DT), 1e-5


def measured(folder):
    """measures.csv has PGA A, PGV 2 A/w, Arias pi A2 D/(4 g), CAV 2 A D/pi, to 1e-4: (w dt)2/12 of the trapezoidal rule."""
    write_run(folder)
    exported(folder)
    found, w, duration = columns(folder / "export" / "measures.csv"), 2 * np.pi / PERIOD, CYCLES * PERIOD
    row = list(found["motion"]).index("gauge-crest-x")
    expected = {"PGA (m/s2)": PEAK, "PGV (m/s)": 2 * PEAK / w, "Arias intensity (m/s)": np.pi / 4 / 9.80665 * PEAK**2 * duration,
                "CAV (m/s)": 2 / np.pi * PEAK * duration}
    return max(abs(found[name][row] / value - 1) for name, value in expected.items()), 2e-4


def profile(folder):
    """The greatest values of a column stand in a table from the surface (3 m) down, and in no other."""
    write_run(folder)
    assert exported(folder)[0] == 0
    with open(folder / "export" / "free_field-left-profile.csv", newline="") as file:
        head, *rows = csv.reader(file)
    expected = [["0.5", "3", "1", "0.002", "1", "4000"], ["1.5", "2", "2", "0.001", "2", "5000"], ["2.5", "1", "", "", "", ""]]
    series = list(columns(folder / "export" / "free_field-left.csv"))
    return float(rows != expected) + (len(head) != 6) + (series != ["time (s)", "surface velocity 0 (1)", "surface velocity 1 (1)"]), 0


def section(folder):
    """A section has the particles on its line from the surface down, each with its fields."""
    write_run(folder)
    code, _ = exported(folder, "--section", "3.2", "--fields", "plastic_strain,displacement,p")
    found = columns(folder / "export" / "section-x3.2-t0.csv")
    errors = [code, np.abs(found["y (m)"] - np.arange(5, -1, -1)).max(), np.abs(found["depth (m)"] - np.arange(0.5, 6)).max(),
              np.abs(found["plastic strain"] - 0.03).max(), np.abs(found["p (kPa)"] - 1).max()]
    return max(errors), 1e-9


def refusals(folder):
    """Nothing is replaced unasked (73); what there is not is refused, with what there is (64, 66)."""
    write_run(folder)
    exported(folder, "--gauge", "crest")
    wrong = []
    for words, code, part in (((folder, "--gauge", "crest"), 73, "--force"), ((folder, "--gauge", "crest", "--force"), 0, ""),
                              ((folder, "--gauge", "crset"), 64, "crest"), ((folder, "--section", "300"), 66, "it lies from"),
                              ((folder, "--section", "3", "--fields", "pp"), 64, "plastic_strain"),
                              ((folder, "--time", "3"), 64, "--section"), ((folder / "none",), 66, "no such folder"),
                              ((folder, "--section", "3", "--fields", "velocity"), 66, "velocity"),
                              ((folder, "--guage", "crest"), 64, "did you mean '--gauge'?")):
        ended, said = exported(*words)
        wrong.append(ended != code or part not in said)
    names = sorted(path.name for path in (folder / "export").iterdir())
    return float(sum(wrong)) + (names != ["gauge-crest-x.AT2", "gauge-crest.csv"]), 0


def read_back(folder):
    """mpm-seismic reads the .AT2 of a gauge, and finds its PGA, Arias intensity and final displacement, A D/w."""
    if not (ROOT / "build" / "mpm-seismic").exists():
        return "the programs are not built: cmake --build --preset release"
    write_run(folder)
    exported(folder, "--gauge", "crest")
    (folder / "level.yaml").write_text(LEVEL)
    command = [ROOT / "build" / "mpm-seismic", folder / "level.yaml", "--motion", folder / "export" / "gauge-crest-x.AT2",
               "--out", folder / "level", "--quiet"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=os.environ | {"OMP_NUM_THREADS": "1"})
    if done.returncode:
        print(done.stderr)
        return float(done.returncode), 0
    found = json.loads((folder / "level" / "summary.json").read_text())["motion"]["horizontal"]["recorded"]
    duration, w = CYCLES * PERIOD, 2 * np.pi / PERIOD
    expected = {"pga": PEAK, "arias": np.pi / 4 / 9.80665 * PEAK**2 * duration, "final_displacement": PEAK * duration / w}
    return max(abs(found[name] / value - 1) for name, value in expected.items()), 2e-4


def checks():
    """Name and (error, tolerance) of every check."""
    for check in (tables, at2, measured, profile, section, refusals, read_back):
        with tempfile.TemporaryDirectory() as folder:
            yield check.__doc__, check(Path(folder))


if __name__ == "__main__":
    sys.exit(report(checks()))
