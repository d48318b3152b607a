"""How wrong a run is, in norms that are never mixed into one score; each at the worst gauge.

Waves: |ln(Sa/Sa_ref)| of 5 % damping over .05 to 4 s, mean and greatest; |ratio - 1| of PGV, Arias intensity and D5-95.
Slides: trigger time (s), toe (m), and |ratio - 1| of run-out (of the gauge `middle`: the mean of all that moves falls when a
second body joins), moved area and greatest velocity.
"""
import json

import known_answers
import numpy as np
import spectrum
import verification_references as references
from plot_common import open_history
from plot_histories import read_gauges

PERIODS = np.geomspace(0.05, 4.0, 60)  # s
WAVES = ("Sa mean", "Sa max", "PGV", "Arias", "D5-95")
SLIDES = ("run-out", "trigger (s)", "moved area", "toe (m)", "velocity")


def velocities(folder, gauges):
    """Times (s) and horizontal velocities (m/s) by gauge."""
    with open_history(folder) as file:
        time, names, fields = read_gauges(file)
    return time, {name: fields["velocity"][:, names.index(name), 0] for name in gauges}


def layers(time):
    """The surface of two layers by Thomson and Haskell."""
    soil = [(5.0, references.SOIL), (5.0, references.STIFF)]
    return {"top": known_answers.layered_waves(soil, references.shear_speed, time)["top"][1]}


def reference_of(scene, folder, time):
    """True velocities (m/s) by gauge at the times."""
    if folder:
        at, true = velocities(folder / "run", scene.gauges)
        return {name: np.interp(time, at, values) for name, values in true.items()}
    return layers(time) if scene.name == "layers" else {name: v for name, (_, v) in known_answers.hill_waves(time).items()}


def characteristics(time, velocity):
    """Spectrum, PGV, Arias intensity and D5-95 of a history."""
    acceleration, step = spectrum.acceleration_of(time, velocity)
    return (spectrum.pseudo_acceleration(acceleration, step, PERIODS), np.abs(velocity).max(),
            spectrum.arias_intensity(acceleration, step), spectrum.significant_duration(acceleration, step))


def of_waves(scene, folder, reference):
    """Errors of the worst gauge, by name."""
    time, found = velocities(folder / "run", scene.gauges)
    true = reference_of(scene, reference, time)
    rows = []
    for name in scene.gauges:
        (spectrum_, *numbers), (true_spectrum, *true_numbers) = characteristics(time, found[name]), characteristics(time, true[name])
        ratio = np.abs(np.log(spectrum_ / true_spectrum))
        rows.append([ratio.mean(), ratio.max(), *(abs(a / b - 1) for a, b in zip(numbers, true_numbers))])
    return dict(zip(WAVES, np.max(rows, axis=0)))


def slide_of(folder):
    """Distance of the gauge `middle` (m), trigger (s), moved area (m2), toe (m) and greatest velocity (m/s) of a run."""
    slide = json.loads((folder / "run" / "summary.json").read_text())["slide"]
    with open_history(folder / "run") as file:
        _, names, fields = read_gauges(file)
    return (np.linalg.norm(fields["displacement"][-1, names.index("middle")]), slide["trigger_time"], slide["moved_area"],
            slide["toe"], slide["peak_velocity"]["value"])


def of_slide(folder, reference):
    """Errors by name; nan where one has no trigger or toe and the other has."""
    found, true = ([np.nan if value is None else value for value in slide_of(where)] for where in (folder, reference))
    absolute = (False, True, False, True, False)
    return dict(zip(SLIDES, (abs(a - b) if plain else abs(a / b - 1) for a, b, plain in zip(found, true, absolute))))


def norms_of(scene, folder, reference):
    """Errors of a run, by name of the norm; the first is the one that pictures show."""
    return of_waves(scene, folder, reference) if scene.gauges else of_slide(folder, reference)
