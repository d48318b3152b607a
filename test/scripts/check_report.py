"""Checks the numbers of a report against closed forms, and what it says of runs of all kinds; prints 'N passed, N failed'."""
import contextlib
import html
import io
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import amplification
import browser
import report as program
import report_motion
import report_run
import report_site
import spectrum
from checking import report
from plot_common import envelopes

CYCLES, PERIOD, PEAK, DT = 20, 1.0, 2.0, 0.005  # of the sine: s, m/s2, s
LAYER = """
schema: seismpm-case/1
grid: {spacing: 1 m, particles_per_cell: 2}
domain: {x: [0 m, 4 m], bottom: 0 m}
surfaces: {ground: {points: [[0 m, 16 m]]}, rockhead: {points: [[0 m, 4 m]]}}
regions: [{material: soil, above: rockhead, below: ground}, {material: rock, below: rockhead}]
materials:
  rock: {model: elastic, density: 2200 kg/m3, young_modulus: 800 MPa, poisson_ratio: 0.25}
  soil: {model: elastic, density: 1800 kg/m3, young_modulus: 60 MPa, poisson_ratio: 0.25}
seismic: {duration: 20 s, motion: {recorded_as: outcrop, horizontal: {file: pulse.txt, unit: m/s2, dt: 0.01 s}, baseline: none}}
output: {gauges: {points: {top: [2 m, 16 m], middle: [2 m, 10 m], rockhead: [2 m, 4 m]}}, frames: {every: 5 s}}
"""
SMALL = ("grid.spacing=2 m", "seismic.duration=12 s", "output.frames.every=1 s", "materials.clay.strength.peak=55 kPa")


def run(program_name, *words):
    """Runs one of the two programs, or a script, quietly; returns its exit code and what it said."""
    path = ROOT / ("build" if program_name.startswith("mpm-") else "scripts") / program_name
    done = subprocess.run([path, *map(str, words)], capture_output=True, text=True, check=False,
                          env=os.environ | {"OMP_NUM_THREADS": "1"})
    return done.returncode, done.stdout + done.stderr


def made(folder, case, *settings):
    """A run of a case in the folder, both stages."""
    words = [word for setting in settings for word in ("--set", setting)]
    for stage, more in (("static", ()), ("seismic", ("--from", folder / "static" / "final.h5"))):
        code, said = run(f"mpm-{stage}", case, *more, "--out", folder / stage, "--quiet", *words)
        if code:
            raise RuntimeError(f"mpm-{stage} ended with {code}: {said}")
    return folder / "seismic"


def table_of(page, column):
    """Rows, by their first cell, of the first table whose head has this column: what stands in each, as text."""
    for table in re.findall(r"<table>.*?</table>", page, re.DOTALL):
        rows = [[html.unescape(cell) for cell in re.findall(r"<t[hd]>(.*?)</t[hd]>", row)]
                for row in re.findall(r"<tr>(.*?)</tr>", table)]
        if column in rows[0]:
            return {row[0]: dict(zip(rows[0], row)) for row in rows[1:]}
    raise RuntimeError(f"no table has the column {column}")


def sine():
    """Of a sine of 20 cycles: PGA A, PGV 2 A/w, Arias pi A2 D/(4 g), CAV 2 A D/pi, D5-95 0.9 D, Sa at resonance A/(2 xi) as it
    has grown after 20 cycles, and at T = 4 s that of lsim's kind. To the three digits that the table shows."""
    w, duration = 2 * np.pi / PERIOD, CYCLES * PERIOD
    time = np.arange(0, duration + 0.5 * DT, DT)
    velocity = PEAK / w * (1 - np.cos(w * time))
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        (folder / "identity.json").write_text('{"stage": "seismic"}')
        with h5py.File(folder / "history.h5", "w") as file:
            file["gauges/time"], file["gauges/gauge"] = time, ["point"]
            file["gauges/velocity"] = np.stack([velocity, 0 * velocity], axis=1)[:, None]
        page = report_motion.numbers(report_run.Run(folder))
    row, spectral = table_of(page, "PGA (g)")["point"], table_of(page, "1 s")["point"]
    # Steady state and decay of u'' + 2 xi w u' + w2 u = -A sin(w t) from rest, xi small: (A / 2 xi)(1 - exp(-xi w t)).
    resonance = PEAK / 0.1 * (1 - np.exp(-0.05 * w * duration))
    expected = {"PGA (g)": PEAK / 9.80665, "PGV (m/s)": 2 * PEAK / w, "Arias (m/s)": np.pi / 2 / 9.80665 * PEAK**2 * duration / 2,
                "CAV (m/s)": 2 / np.pi * PEAK * duration, "D5-95 (s)": 0.9 * duration}
    errors = [float(row[name]) / value - 1 for name, value in expected.items()] + [float(spectral["1 s"]) * 9.80665 / resonance - 1]
    return np.abs(errors).max(), 0.005


def absolute_velocity():
    """CAV of a saw-tooth that crosses zero between samples is the area of its triangles, exactly."""
    return abs(spectrum.cumulative_absolute_velocity(np.array([1.0, -3.0, 1.0, 1.0]), 2.0) - (2.5 + 2.5 + 2.0)), 1e-14


def doubled():
    """A motion that is twice another is amplified by two at all frequencies and periods, whatever the steps and lengths."""
    time = np.arange(0, 20, 0.01)
    motion = np.exp(-((time - 5) ** 2)) * np.sin(9 * time + time**2)
    pair = (2 * motion, 0.01), (np.append(motion, np.zeros(300)), 0.01)
    at = amplification.band(pair)
    found = np.append(amplification.transfer_function(*pair, at), amplification.spectral_ratio(*pair, [0.1, 0.5, 2.0]))
    return np.abs(found / 2 - 1).max(), 1e-9


def smoothing():
    """Smoothing leaves a constant spectrum as it is, and one line spreads to 6 % of its frequency at half its height."""
    frequencies = np.linspace(0.01, 50, 5000)
    even = np.abs(amplification.smoothed(frequencies, np.full(5000, 3.0), [0.5, 5.0, 20.0]) - 3).max()
    return max(even, abs(amplification.window(frequencies, 10.0)[1059] / amplification.window(frequencies, 10.0).max() - 0.5)), 0.01


def layer(folder):
    """Elastic soil on rock amplifies an outcrop motion by 1 / |cos kH + i a sin kH|, a the ratio of impedances.

    About the first resonance, where a wave has 24 cells and more: to 2 % of the peak.
    """
    time = np.arange(0, 20, 0.01)
    pulse = 0.05 * (1 - 2 * (np.pi * 3 * (time - 1)) ** 2) * np.exp(-((np.pi * 3 * (time - 1)) ** 2))  # Ricker, 3 Hz
    (folder / "pulse.txt").write_text("\n".join(f"{value:.8e}" for value in pulse) + "\n")
    (folder / "layer.yaml").write_text(LAYER)
    shaken = made(folder / "layer", folder / "layer.yaml")
    outcrop, motions = report_motion.read(report_run.Run(shaken))
    surface = next(motion for motion in motions if motion.free_field)
    at = np.geomspace(0.8, 4.8, 80)
    found = amplification.transfer_function(surface.component(0), outcrop.component(0), at)
    slow, fast = (np.sqrt(young / 2.5 / density) for young, density in ((60e6, 1800), (800e6, 2200)))
    frequencies, amplitudes = amplification.fourier_amplitude(*outcrop.component(0))
    phase = 2 * np.pi * frequencies * 12.0 / slow
    closed = 1 / np.abs(np.cos(phase) + 1j * 1800 * slow / (2200 * fast) * np.sin(phase))
    expected = amplification.smoothed(frequencies, closed * amplitudes, at) / amplification.smoothed(frequencies, amplitudes, at)
    print(f"     peak {found.max():.2f} at {at[found.argmax()]:.2f} Hz, closed form {expected.max():.2f} at {at[expected.argmax()]:.2f} Hz")
    return np.abs(found - expected).max() / expected.max(), 0.02


def claims(*held):
    """Number of claims that do not hold, and the number that may."""
    print("".join(f"     claim {k} does not hold\n" for k, claim in enumerate(held) if not claim), end="")
    return float(sum(not claim for claim in held)), 0.0


def gauges_below(folder):
    """Gauges below each other make a profile; of an older run, without greatest values of the columns, that is said."""
    page = report_site.profiles(report_run.Run(folder / "layer" / "seismic"))
    rows = table_of(page, "greatest mean shear strain to the next below")
    return claims(list(rows) == ["top", "middle", "rockhead"], float(rows["top"]["greatest acceleration (g)"]) > 0,
                  float(rows["middle"]["greatest mean shear strain to the next below"]) > 0,
                  "Free field, over the whole run: greatest shear stress (kPa)" in page, "older version" not in page,
                  "older version" in report_site.greatest(older(folder)))


def older(folder):
    """The run of the layer without the greatest values of its columns."""
    shutil.copytree(folder / "layer" / "seismic", folder / "older")
    with h5py.File(folder / "older" / "history.h5", "a") as file:
        for side in ("left", "right"):
            del file[f"free_field/{side}/middle_height"]
    return report_run.Run(folder / "older")


def columns_with_depth(folder):
    """Of the columns: the greatest acceleration of the uppermost row is the surface's; stress over strain is G, where the soil is elastic.

    The first to rounding (1e-6 of it). The second to 5 % between 2 and 11 m: greatest values need not be at the same time, and near the
    surface both are small.
    """
    with h5py.File(folder / "layer" / "seismic" / "history.h5") as file:
        column, found = file["free_field/left"], envelopes(file, "left")
        rates = np.diff(column["surface_velocity"][:, 0]) / np.diff(column["time"][...])
    depth, strain = found["greatest_shear_strain"]
    stress = found["greatest_shear_stress"][1]
    soil = (depth > 2) & (depth < 11)
    return max(abs(np.abs(rates).max() / found["greatest_acceleration"][1][-1] - 1) * 1e6,
               np.abs(stress[soil] / strain[soil] / (60e6 / 2.5) - 1).max() / 0.05), 1.0


def under_way(folder, shaken):
    """A run with frames and no histories yet is reported, with what it lacks; a damaged file is told, with 65."""
    live = folder / "live"
    live.mkdir()
    for name in ("identity.json", "frame-00000.hdf", "frame-00001.hdf", "case-resolved.yaml"):
        shutil.copy(shaken / name, live)
    code, _ = reported(live)
    page = html.unescape((live / "report.html").read_text())
    first = claims(code == 0, "has not ended" in page, "no history.h5 yet" in page, "there is no summary.json" in page,
                   "data:image/webp" in page)
    (live / "history.h5").write_bytes(b"no HDF5")
    code, said = reported(live)
    return first[0] + claims(code == 65, "not shown" in said, "damaged" in (live / "report.html").read_text())[0], 0


def reported(*words):
    """Exit code of scripts/report, and what it said on stderr."""
    sys.argv, said = ["report", *map(str, words)], io.StringIO()
    with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
        try:
            return program.main(), said.getvalue()
        except SystemExit as end:
            return end.code, said.getvalue()


def refusals(folder):
    """What is no run is refused with 66, a misspelt option with 64, a file that is no report is kept with 73."""
    (folder / "empty").mkdir()
    mine = folder / "mine.html"
    mine.write_text("mine")
    (folder / "run").mkdir()
    (folder / "run" / "identity.json").write_text('{"stage": "seismic"}')
    found = []
    for words, code, part in (([folder / "none"], 66, "no such folder"), ([folder / "empty"], 66, "identity.json"),
                              ([folder / "run", "--uot", "a"], 64, "--out"), ([folder / "run", "--out", mine], 73, "give another --out")):
        ended, said = reported(*words)
        found.append(ended == code and part in said)
    return claims(*found, mine.read_text() == "mine")


def shown(tab, page, width, phone=False):
    """Opens a page and tells what is wrong with what is shown."""
    tab.errors.clear()
    tab.requests.clear()
    tab.open(page, width, phone=phone)
    wide = tab.value("document.documentElement.scrollWidth - document.documentElement.clientWidth")
    broken = tab.value("[...document.images].filter(image => !image.complete || !image.naturalWidth).length")
    outside = [address for address in tab.requests if not address.startswith(("data:", "file:"))]
    found = ([f"{wide} px too wide"] if wide else []) + ([f"{broken} pictures missing"] if broken else []) + tab.errors + outside
    print("".join(f"     {width} px: {fault}\n" for fault in found), end="")
    return found


def in_browser(folder, shaken):
    """(name, result) of what a browser shows of a report, and of a page with all faults at once."""
    names = ("A browser shows all of it, on a desk and on a phone, and asks for nothing else.", "It prints on A4.",
             "The browser's checks find a wide page, a missing picture, an error and a request.")
    try:
        if not browser.found():
            raise RuntimeError("no Chromium is installed (Debian: chromium)")
        with browser.Browser():
            pass
    except RuntimeError as reason:
        yield from ((name, str(reason)) for name in names)
        return
    page, faulty = shaken / "report.html", folder / "faulty.html"
    faulty.write_text('<div style="width:3000px">wide</div><img src="http://localhost:9/x.png">'
                      '<script>console.error("bad")</script>')
    with browser.Browser() as tab:
        yield names[0], claims(not shown(tab, page, 1280), tab.value("document.images.length") > 25, not shown(tab, page, 390, True))
        tab.ask("Emulation.setEmulatedMedia", media="print")
        shown(tab, page, 688)  # 182 mm between the margins
        beyond = tab.value("[...document.querySelectorAll('main *')]"
                           ".filter(part => part.getBoundingClientRect().right > innerWidth + 1).length")
        tab.print_to(folder / "report.pdf")
        paper = (folder / "report.pdf").read_bytes()
        yield names[1], claims(beyond == 0, paper.startswith(b"%PDF"), len(paper) > 100_000)
        tab.ask("Emulation.setEmulatedMedia", media="")
        found = shown(tab, faulty, 1280)
        yield names[2], claims(*(any(part in fault for fault in found) for part in ("too wide", "missing", "bad", "localhost")))


def checks():
    """Name and (error, tolerance) of every check."""
    for check in (sine, absolute_velocity, doubled, smoothing):
        yield check.__doc__.splitlines()[0], check()
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        yield refusals.__doc__, refusals(folder)
        if not (ROOT / "build" / "mpm-seismic").exists():
            yield "Reports of runs.", "the programs are not built: cmake --build --preset release"
            return
        yield layer.__doc__.splitlines()[0], layer(folder)
        yield gauges_below.__doc__, gauges_below(folder)
        yield columns_with_depth.__doc__.splitlines()[0], columns_with_depth(folder)
        shaken = made(folder, ROOT / "cases" / "first" / "case.yaml", *SMALL)
        run("newmark", shaken)
        code, said = reported(shaken)
        page = html.unescape((shaken / "report.html").read_text())
        summary = json.loads((shaken / "summary.json").read_text())
        yield "A run that has ended is reported whole, its rigid block beside it.", claims(
            code == 0, not said, "Not shown" not in page, "slip circle" in page, "Strength used" in page,
            f"{summary['slide']['trigger_time']:.2f} s" in page, all(warning in page for warning in summary["warnings"]))
        applied, shown_as = summary["motion"]["horizontal"]["applied"], table_of(page, "PGA (g)")["outcrop"]
        pairs = (("PGA (g)", applied["pga"] / 9.80665), ("at (s)", applied["pga_time"]), ("PGV (m/s)", applied["pgv"]),
                 ("Arias (m/s)", applied["arias"]), ("D5-95 (s)", applied["d5_95"]))
        yield "The outcrop motion has the measures that the program itself found, to half the last digit shown.", (
            max(abs(float(shown_as[name]) - value) * 10 ** len(shown_as[name].partition(".")[2]) for name, value in pairs), 0.51)
        code, _ = reported(folder / "static")
        page = (folder / "static" / "report.html").read_text()
        yield "So is a static state.", claims(code == 0, "Stresses at the end" in page, "Not shown" not in page)
        yield under_way.__doc__, under_way(folder, shaken)
        yield from in_browser(folder, shaken)


if __name__ == "__main__":
    sys.exit(report(checks()))
