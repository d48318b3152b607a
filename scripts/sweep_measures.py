"""What is told of every run of a sweep: intensities of its motion, measures of its slide, a rigid block, settings that differ."""
import json
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np

import newmark
import spectrum
import sweep_plan
import sweep_run
from plot_common import Missing, read_summary
from resolved_case import Refused, number_and_unit
from whole_file import write_whole

INTENSITIES = {"pga": "g", "pgv": "m/s", "arias": "m/s", "d5_95": "s"}  # and sa_T in g
MEASURES = {"displacement": "m", "toe_advance": "m", "moved_area": "m2", "moved_mass": "kg/m", "trigger_time": "s",
            "newmark_displacement": "m", "newmark_trigger": "s"}
UNFINISHED = (None, 74, 75)  # exit codes of runs that go on when the sweep is repeated; above 128: killed


def intensities(folder, periods):
    """Intensities of the horizontal outcrop motion as a run applied it, by name."""
    time, ground = newmark.outcrop(folder)
    acceleration, dt = ground[:, 0], float(time[1] - time[0])
    pga, pgv, _ = spectrum.peaks(acceleration, dt)
    found = {"pga": pga / spectrum.GRAVITY, "pgv": pgv, "arias": spectrum.arias_intensity(acceleration, dt),
             "d5_95": spectrum.significant_duration(acceleration, dt)}
    sa = spectrum.pseudo_acceleration(acceleration, dt, periods) / spectrum.GRAVITY
    return found | {f"sa_{period:g}": value for period, value in zip(periods, sa)}


def announced(folder):
    """Intensities of the motion that a run without a result would have applied, as far as its summary.json has them."""
    motion = ((read_summary(folder).get("motion") or {}).get("horizontal") or {})
    applied = motion.get("applied") or {}
    found = {name: applied[name] for name in INTENSITIES if name in applied}
    if "pga" in found:
        found["pga"] /= spectrum.GRAVITY
    return scaled(found, 2.0 if motion.get("recorded_as") == "upgoing" else 1.0)


def scaled(known, factor):
    """Intensities of a motion times a factor; the processing of a motion is linear."""
    power = {"arias": 2, "d5_95": 0}
    return {name: value * abs(factor) ** power.get(name, 1) for name, value in known.items()}


def of_slide(folder):
    """The measures of a finished run by name."""
    slide = read_summary(folder).get("slide") or {}
    shift = slide.get("centre_of_mass_displacement") or [0.0, 0.0]
    numbers = {"displacement": float(np.hypot(*(part or 0.0 for part in shift)))}
    for name in ("toe_advance", "moved_area", "moved_mass", "trigger_time"):
        value = slide.get(name)
        numbers[name] = np.nan if value is None else float(value)
    if not numbers["moved_area"] > 0.0:
        numbers.update(displacement=0.0, toe_advance=0.0)
    return numbers


def of_block(folder, options):
    """Measures of the rigid block beside a run; kept in its newmark.json, so that it is found once."""
    if options == "none":
        return {}
    if options is not None:
        script = Path(__file__).resolve().parent / "newmark.py"
        done = subprocess.run([sys.executable, str(script), str(folder), *shlex.split(options)], capture_output=True, text=True,
                              check=False)
        if done.returncode:
            raise Refused(done.returncode, done.stderr.strip())
        result = json.loads((folder / "newmark.json").read_text())
    else:
        result = newmark.stored_or_estimated(folder)
        write_whole(folder / "newmark.json", json.dumps(result, indent=1) + "\n")
    trigger = result["trigger_time"]
    return {"newmark_displacement": result["displacement"], "newmark_trigger": np.nan if trigger is None else trigger}


def row_of(run, folder, end, given):
    """What is told of a run, whose `end` is its exit code and the folder that has it: its numbers by name, as far as there are."""
    code, ended = end
    row = {"run": run["name"], "record": Path(run["record"]).stem if run["record"] else "case", "scale": run["scale"],
           "profile": run["profile"],
           "exit": -1 if code is None else code, "state": sweep_run.words_of(code),
           "reason": sweep_run.reason_of(ended) if code not in (None, 0, sweep_run.INTERRUPTED) else ""}
    if code == 0:
        row |= intensities(folder, given.periods) | of_slide(folder)
        try:
            row |= of_block(folder, given.newmark)
        except Missing as reason:
            given.without_block.append(str(reason))
    return row


def motion_of(run):
    """What the motion of a run depends on, but for its factor."""
    shaking = {key: value for key, value in run["settings"].items() if key.startswith("seismic.")}
    return json.dumps([run["record"], run["vertical"], run["record_options"], run["profile"], shaking], sort_keys=True)


def collect(plan, given):
    """The rows of all runs; intensities of one that has not come so far are those of another run of its record, scaled."""
    rows, known, ends = [], {}, sweep_run.ends(plan, given.folder)
    names = [*INTENSITIES, *(f"sa_{period:g}" for period in given.periods)]
    kinds = [motion_of(run) for run in plan["runs"]]
    for run, kind in zip(plan["runs"], kinds):
        folder, _ = sweep_plan.command_of_run(plan, given.folder, run)
        row = row_of(run, folder, ends[run["name"]], given)
        if row["exit"] == 0 and "pga" in row and run["scale"] != 0.0:
            known.setdefault(kind, (run["scale"], {name: row[name] for name in names}))
        rows.append(row)
    for run, kind, row in zip(plan["runs"], kinds, rows):
        if row["exit"] != 0 and kind in known:
            row |= scaled(known[kind][1], run["scale"] / known[kind][0])
        elif row["exit"] != 0:
            row |= announced(sweep_plan.command_of_run(plan, given.folder, run)[0])
        for name in (*names, *MEASURES):
            row.setdefault(name, np.nan)
    return rows, names


def varied(plan, rows):
    """Adds to the rows the settings that differ between runs, as numbers where all have one unit; returns {key: unit}."""
    units = {}
    for key in dict.fromkeys(key for run in plan["runs"] for key in run["settings"]):
        values = [run["settings"].get(key, "") for run in plan["runs"]]
        if len(set(values)) == 1:
            continue
        try:
            numbers = [number_and_unit(value) if value else (np.nan, None) for value in values]
        except Refused:  # words
            numbers = []
        found = {unit for _, unit in numbers} - {None}
        if len(found) == 1:
            units[key], values = found.pop(), [number for number, _ in numbers]
        else:
            units[key] = ""
        for row, value in zip(rows, values):
            row[key] = value
    return units


def is_done(row):
    """Whether a run is finished."""
    return row["exit"] == 0


def is_unfinished(row):
    """Whether a run has not been done yet, as against one that has failed."""
    return row["exit"] in (-1, *UNFINISHED) or row["exit"] > 128
