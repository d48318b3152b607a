"""What is reported of a seismic run, as numbers: measures by name and unit, histories, the outline at the end."""
from dataclasses import dataclass

import numpy as np

import spectrum
from plot_common import Missing, array, group_of, open_history, read_summary
from plot_histories import read_gauges, read_outline

PERIODS = (0.1, 0.2, 0.5, 1.0, 2.0)  # s, of the response spectra
DIRECTIONS = ("horizontal", "vertical")
SLIDE = {"trigger_time": "s", "moved_area": "m²", "run_out": "m", "toe": "m", "toe_advance": "m", "peak_velocity": "m/s",
         "outline_rise": "m", "outline_fall": "m"}


@dataclass(frozen=True)
class Measure:
    """What is measured (a measure of the slide, or GAUGE.what) and its unit."""
    name: str
    unit: str


def slid(summary, area):
    """Whether a slide of `area` m2 or more has moved at any time."""
    return summary["slide"]["greatest_moved_area"]["value"] >= area


def of_slide(summary):
    """Measures of the slide; None for what there is not."""
    slide = summary["slide"]
    found = {"trigger_time": slide["trigger_time"], "moved_area": slide["moved_area"],
             "run_out": float(np.linalg.norm(slide["centre_of_mass_displacement"])),
             "toe": slide["toe"], "toe_advance": slide["toe_advance"], "peak_velocity": slide["peak_velocity"]["value"],
             "outline_rise": slide["outline_rise"]["height"], "outline_fall": slide["outline_fall"]["height"]}
    return {Measure(name, SLIDE[name]): value for name, value in found.items()}


def of_gauge(name, time, displacement, velocity, directions):
    """Final displacement, and PGV and pseudo-acceleration in the directions that are shaken, of one gauge."""
    if not np.isfinite(displacement).all():
        return {}
    found = {Measure(f"{name}.displacement", "m"): float(np.linalg.norm(displacement[-1]))}
    for direction in directions:
        component = DIRECTIONS.index(direction)
        suffix = "" if len(directions) == 1 else f" {direction}"
        found[Measure(f"{name}.PGV{suffix}", "m/s")] = float(np.abs(velocity[:, component]).max())
        acceleration, dt = spectrum.acceleration_of(time, velocity[:, component])
        periods = [period for period in PERIODS if period >= 4.0 * dt]
        for period, value in zip(periods, spectrum.pseudo_acceleration(acceleration, dt, periods)):
            found[Measure(f"{name}.Sa({period:g} s){suffix}", "g")] = float(value / spectrum.GRAVITY)
    return found


def measures(folder):
    """All measures of a run, {Measure: value or None}."""
    summary = read_summary(folder)
    if "slide" not in summary:
        raise Missing("summary.json has no slide")
    found = of_slide(summary)
    with open_history(folder) as file:
        if "gauges" in file:
            time, names, fields = read_gauges(file)
            for k, name in enumerate(names):
                found |= of_gauge(name, time, fields["displacement"][:, k], fields["velocity"][:, k],
                                  list(summary.get("motion", DIRECTIONS[:1])))
    return found


def histories(folder):
    """{(name, unit): (abscissae, values)}: distance of gauges, moved area, run-out and speed over time; the outline over x."""
    found = {}
    with open_history(folder) as file:
        if "gauges" in file:
            time, names, fields = read_gauges(file)
            for k, name in enumerate(names):
                found[f"{name}.displacement", "m"] = time, np.linalg.norm(fields["displacement"][:, k], axis=1)
        slide = group_of(file, "slide")
        time = array(slide, "time")
        found["moved_area", "m²"] = time, array(slide, "moved_area")
        found["run_out", "m"] = time, np.linalg.norm(array(slide, "centre_of_mass_displacement"), axis=1)
        found["peak_velocity", "m/s"] = time, array(slide, "peak_velocity")
        x, _, end = read_outline(file)
        found["outline", "m"] = x, end
    return found
