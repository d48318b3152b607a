"""Checks what plot-run draws of runs with odd names and of runs that have not ended; prints 'N passed, N failed'."""
import contextlib
import io
import json
import os
import sys
import tempfile
import warnings
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import options
import plot_common
import plot_energy
import plot_run
from checking import report

NAMES = ["$x_$", r"a$\frac{$b", "_under", "100 % {0} %s", "Böschung µ", "a^b$c$"]


def write_frame(folder, number, time):
    """Particles on a square that have moved with time."""
    x, y = np.meshgrid(np.arange(12.0), np.arange(6.0))
    position = np.stack([x.ravel() + 0.1 * time, y.ravel(), 0 * x.ravel()], axis=1)
    with h5py.File(folder / f"frame-{number:05}.hdf", "w") as file:
        file.attrs["time"] = time
        file["particles/position"] = position
        file["particles/displacement"] = np.full_like(position, 0.1 * time)
        file["particles/plastic_strain"] = 0.01 * position[:, 0]
        file["particles/stress"] = np.full((len(position), 4), -1e3)
        file["particles/volume"] = np.ones(len(position))


def write_history(folder, end):
    """All series that the pictures show, of 0.1 s steps, with a gauge for each of the names."""
    time = np.arange(0, end + 0.05, 0.1)
    wave = np.sin(2 * time)[:, None]
    with h5py.File(folder / "history.h5", "w") as file:
        for group in ("gauges", "motion", "slide", "energy"):
            file[f"{group}/time"] = time
        file["gauges/gauge"] = NAMES
        for field in ("displacement", "velocity"):
            file[f"gauges/{field}"] = np.tile(wave[:, :, None], (1, len(NAMES), 2))
        for name in ("velocity", "acceleration"):
            file[f"motion/upgoing_{name}"] = np.hstack([wave, 0 * wave])
        for name in ("moved_area", "peak_velocity"):
            file[f"slide/{name}"] = time
        for name in ("centre_of_mass_displacement", "centre_of_mass_velocity"):
            file[f"slide/{name}"] = np.hstack([wave, wave])
        for name in ("kinetic", "residual", "incoming"):
            file[f"energy/{name}"] = time
        for name in ("x", "start", "end"):
            file[f"outline/{name}"] = np.arange(12.0)


def summary(end, code):
    """summary.json of a run with such names."""
    peak = {"value": 1.0, "time": 1.0, "position": [1.0, 2.0]}
    change = {"height": 1.0, "x": 2.0}
    waves = {kind: {"speed": 100.0, "carried_to": 5.0} for kind in "SP"}
    applied = dict.fromkeys(("pga", "pga_time", "pgv", "pgd", "arias", "d5_95"), 1.0)
    return {"name": NAMES[0], "motion_title": "$record_$", "motion": {"horizontal": {"applied": applied}}, "stage": "seismic", "exit": code, "time": end, "steps": 100, "dt": 0.1,
            "particles": 72, "threads": 1, "wall_seconds": 1.0, "warnings": NAMES, "case_sha256": "0" * 64,
            "profile": NAMES[1], "version": "1", "git": "$", "digests": {"motion.$a$": "f" * 64},
            "resolution": {"spacing": 1.0, "particles_per_cell": 1, "materials": {name: waves for name in NAMES}},
            "slide": {"trigger_time": 1.0, "moved_area": 1.0, "moved_mass": 1.0, "centre_of_mass_displacement": [1.0, 1.0],
                      "toe": 1.0, "toe_advance": 1.0, "peak_velocity": peak, "point_velocity": peak,
                      "outline_rise": change, "outline_fall": change}}


def draw(folder, *options):
    """Exit code of plot-run with the options, the pictures drawn, what it said, the headings and all names in legends."""
    seen = {"headings": [], "legends": []}
    save = plot_common.plt.Figure.savefig

    def savefig(figure, *arguments, **named):
        seen["headings"].append(figure.get_suptitle() if hasattr(figure, "get_suptitle") else figure._suptitle.get_text())
        save(figure, *arguments, **named)
        for axis in figure.axes:
            if axis.get_legend():
                seen["legends"] += [words.get_text() for words in axis.get_legend().get_texts()]

    said = io.StringIO()
    sys.argv = ["plot-run", str(folder), *options]
    plot_common.plt.Figure.savefig = savefig
    try:
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()), warnings.catch_warnings():
            warnings.simplefilter("error")
            code = plot_run.main()
    finally:
        plot_common.plt.Figure.savefig = save
    return code, {path.name for path in (folder / "pictures").iterdir()}, said.getvalue(), seen


def run_folder(folder, identity, code=None, end=4.0, history=4.0):
    """A seismic run of two frames: with an identity, and perhaps histories and a summary."""
    folder = Path(folder)
    (folder / "identity.json").write_text(json.dumps(identity))
    for number, time in enumerate((0.0, 1.0)):
        write_frame(folder, number, time)
    if history:
        write_history(folder, history)
    if code is not None:
        (folder / "summary.json").write_text(json.dumps(summary(end, code)))
    return draw(folder)


def wrong(*claims):
    """Number of claims that do not hold, and the number that may."""
    for k, claim in enumerate(claims):
        if not claim:
            print("claim", k)
    return float(sum(not claim for claim in claims)), 0.0


def odd_names():
    """Names with $, _, %, braces and umlauts are drawn as they are."""
    with tempfile.TemporaryDirectory() as folder:
        code, drawn, said, seen = run_folder(folder, {"stage": "seismic"}, 0)
    return wrong(code == 0, {"histories.png", "motion.png", "slide.png", "energy.png", "summary.png", "displacement.png",
                             "plastic_strain.png"} == drawn, "not drawn" not in said,
                 set(seen["headings"]) == {"$x_$, $record_$"},
                 all(name in [words.strip() for words in seen["legends"]] for name in NAMES))


def live():
    """A seismic run that has written frames and nothing more yet is no static state."""
    with tempfile.TemporaryDirectory() as folder:
        code, drawn, _, seen = run_folder(folder, {"stage": "seismic"}, history=None)
    return wrong(code == 0, drawn == {"displacement.png", "plastic_strain.png"},
                 all(heading.endswith(", not ended") for heading in seen["headings"]))


def static_without_end():
    """A static run without a final state has no stress picture, whatever else lies in its folder."""
    with tempfile.TemporaryDirectory() as folder:
        _, drawn, said, _ = run_folder(folder, {"stage": "static"}, history=None)
    return wrong("static_stress.png" not in drawn, "static_stress.png not drawn: no final.h5" in said)


def static_end():
    """A static state is drawn from its final.h5."""
    with tempfile.TemporaryDirectory() as folder:
        write_frame(Path(folder), 0, 0.0)
        (Path(folder) / "frame-00000.hdf").rename(Path(folder) / "final.h5")
        (Path(folder) / "identity.json").write_text('{"stage": "static"}')
        code, drawn, _, _ = draw(Path(folder))
    return wrong(code == 0, drawn == {"static_stress.png"})


def vectors():
    """With --format svg pictures are vectors, and the same to the last byte when they are drawn again."""
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        write_history(folder, 4.0)
        (folder / "identity.json").write_text('{"stage": "seismic"}')
        code, drawn, _, _ = draw(folder, "--format", "svg")
        first = (folder / "pictures" / "energy.svg").read_bytes()
        with contextlib.redirect_stdout(io.StringIO()):
            plot_common.save(plot_energy.energy(folder, folder.name), folder / "again.svg", f"{folder.name}, not ended")
        again = (folder / "again.svg").read_bytes()
    return wrong(code == 0, drawn == {"histories.svg", "motion.svg", "slide.svg", "energy.svg"}, b"<svg" in first[:1000],
                 first == again)


def taken_up():
    """Measures of a run that was interrupted and went on are told to be older than its histories."""
    with tempfile.TemporaryDirectory() as folder:
        _, _, _, seen = run_folder(folder, {"stage": "seismic"}, 75, end=2.0)
    return wrong("$x_$, $record_$, interrupted; measures at t = 2.0 s, before it went on" in seen["headings"])


def misspelt():
    """An option misspelt ends with 64 and the nearest."""
    parser = options.Parser(prog="vary")
    parser.add_argument("folder")
    parser.add_argument("--times")
    parser.add_argument("--profiles", required=True)
    claims = []
    for words, part in ((["a", "--tmies", "1"], "did you mean '--times'?"), (["a", "--profile=b"], "'--profiles'"),
                        (["a", "--zigzag"], "no such option"), (["a", "--time", "1"], "'--times'")):
        said = io.StringIO()
        try:
            with contextlib.redirect_stderr(said):
                parser.parse_args(words)
            claims.append(False)
        except SystemExit as end:
            claims.append(end.code == 64 and part in said.getvalue())
    return wrong(*claims)


def checks():
    """Name and (error, tolerance) of every check."""
    for check in (odd_names, live, static_without_end, static_end, vectors, taken_up, misspelt):
        yield check.__doc__, check()


if __name__ == "__main__":
    sys.exit(report(checks()))
