"""Sums up a sweep, finished or under way: scripts/sweep-summary DIR [options].

Intensities of the horizontal outcrop motion as each run applied it, what the slide came to, a rigid block beside it, and
fragility curves with their uncertainty go to DIR/summary.csv, DIR/fragility.csv, DIR/summary.h5 and, with pictures, to the page
DIR/summary.html. Exit code: 75 when runs are unfinished, otherwise that of the first run that failed.
"""
import csv
import json
import shlex
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np

import fragility
import newmark
import spectrum
import sweep_page
import sweep_plan
import sweep_run
from options import Parser
from plot_common import Missing, read_summary
from resolved_case import Refused

INTENSITIES = {"pga": "g", "pgv": "m/s", "arias": "m/s", "d5_95": "s"}  # and sa_T in g
MEASURES = {"displacement": "m", "toe_advance": "m", "moved_area": "m2", "moved_mass": "kg/m", "trigger_time": "s",
            "newmark_displacement": "m", "newmark_trigger": "s"}
UNFINISHED = (None, 74, 75)  # exit codes of runs that go on when the sweep is repeated; above 128: killed


def parse_arguments(given):
    """The command line."""
    parser = Parser(prog="sweep-summary", description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, metavar="DIR", help="of scripts/sweep")
    parser.add_argument("--periods", type=lambda words: [float(word) for word in words.split(",")], default=[0.3, 0.5, 1.0],
                        metavar="S,S", help="of Sa, 5 %% damped; default 0.3,0.5,1 s")
    parser.add_argument("--limit", action="append", metavar="MEASURE=VALUE",
                        help="a slope has failed from this value on (" + ", ".join(MEASURES) + "); repeatable; default moved_area=10")
    parser.add_argument("--confidence", type=float, default=0.95, metavar="P", help="of the intervals; default 0.95")
    parser.add_argument("--bootstrap", type=int, default=300, metavar="N", help="draws of records; default 300, 0: none")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of these draws; default 1")
    parser.add_argument("--newmark", metavar="'OPTIONS'", help="of scripts/newmark, in quotes; none: no rigid block; "
                        "default: the weakest slip circle, where the ground has one")
    given = parser.parse_args(given)
    given.limits = {}
    for limit in given.limit or ["moved_area=10"]:
        name, _, value = limit.partition("=")
        try:
            given.limits[name] = float(value)
        except ValueError:
            parser.error(f"--limit {limit}: write MEASURE=VALUE, such as moved_area=10")
        if name not in MEASURES:
            parser.error(f"--limit {limit}: there is no such measure; there are {', '.join(MEASURES)}")
    if not 0.0 < given.confidence < 1.0:
        parser.error(f"--confidence {given.confidence:g}: give a number between 0 and 1")
    return given


def intensities(folder, periods):
    """Intensities of the horizontal outcrop motion as a run applied it, by name."""
    time, ground = newmark.outcrop(folder)
    acceleration, dt = ground[:, 0], float(time[1] - time[0])
    pga, pgv, _ = spectrum.peaks(acceleration, dt)
    found = {"pga": pga / spectrum.GRAVITY, "pgv": pgv, "arias": spectrum.arias_intensity(acceleration, dt),
             "d5_95": spectrum.significant_duration(acceleration, dt)}
    sa = spectrum.pseudo_acceleration(acceleration, dt, periods) / spectrum.GRAVITY
    return found | {f"sa_{period:g}": value for period, value in zip(periods, sa)}


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
        (folder / "newmark.json").write_text(json.dumps(result, indent=1) + "\n")
    trigger = result["trigger_time"]
    return {"newmark_displacement": result["displacement"], "newmark_trigger": np.nan if trigger is None else trigger}


def row_of(run, folder, end, given):
    """What is told of a run, whose `end` is its exit code and the folder that has it: its numbers by name, as far as there are."""
    code, ended = end
    row = {"run": run["name"], "record": Path(run["record"]).stem if run["record"] else "case", "scale": run["scale"],
           "profile": run["profile"], "settings": json.dumps(run["settings"]) if run["settings"] else "",
           "exit": -1 if code is None else code, "state": sweep_run.words_of(code),
           "reason": sweep_run.reason_of(ended) if code else ""}
    try:
        row |= intensities(folder, given.periods)
    except (Missing, OSError, KeyError):
        pass  # it has not come so far
    if code == 0:
        row |= of_slide(folder)
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
        for name in (*names, *MEASURES):
            row.setdefault(name, np.nan)
    return rows, names


def is_done(row):
    """Whether a run is finished."""
    return row["exit"] == 0


def is_unfinished(row):
    """Whether a run has not been done yet, as against one that has failed."""
    return row["exit"] in (-1, *UNFINISHED) or row["exit"] > 128


def fragilities(rows, names, given):
    """A dictionary for each limit and intensity: the curve with its limits, or why there is none."""
    done = [row for row in rows if is_done(row)]
    found = []
    for limit, value in given.limits.items():
        for name in names:
            if name == "d5_95":
                continue
            used = [row for row in done if row[name] > 0.0]
            im, failed = np.array([row[name] for row in used]), np.array([row[limit] >= value for row in used], dtype=bool)
            told = {"limit": f"{limit} >= {value:g} {MEASURES[limit]}", "intensity": name, "runs": len(used),
                    "failures": int(failed.sum()), "left_out": len(rows) - len(used), "curve": None, "why_not": ""}
            try:
                told["curve"] = curve = fragility.fit(im, failed)
                told |= {"median": curve.median, "beta": curve.beta, "log_likelihood": curve.log_likelihood}
                told["median_low"], told["median_high"] = fragility.median_limits(curve, given.confidence)
                told["beta_low"], told["beta_high"] = fragility.beta_limits(curve, given.confidence)
                if given.bootstrap:
                    median, beta, _ = fragility.bootstrap(im, failed, [row["record"] for row in used], given.bootstrap, given.seed,
                                                          given.confidence)
                    told |= {"median_low_records": median[0], "median_high_records": median[1], "beta_low_records": beta[0],
                             "beta_high_records": beta[1]}
            except fragility.NoFit as reason:
                told["why_not"] = str(reason)
            found.append(told)
    return found


FRAGILITY_COLUMNS = ["limit", "intensity", "runs", "failures", "left_out", "median", "median_low", "median_high", "beta", "beta_low",
                     "beta_high", "median_low_records", "median_high_records", "beta_low_records", "beta_high_records",
                     "log_likelihood", "why_not"]


def units_of(name):
    """Unit of a column, empty for words and counts."""
    return "g" if name.startswith("sa_") else {**INTENSITIES, **MEASURES, "scale": "1"}.get(name, "")


def write_csv(path, columns, rows):
    """A table with units in its heading; what is not known is empty."""
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow([f"{name} ({units_of(name)})" if units_of(name) not in ("", "1") else name for name in columns])
        for row in rows:
            values = [row.get(name, "") for name in columns]
            writer.writerow(["" if isinstance(v, float) and np.isnan(v) else f"{v:.6g}" if isinstance(v, float) else v for v in values])


def write_group(group, columns, rows, units):
    """One dataset for each column, text as UTF-8 of variable length."""
    for name in columns:
        values = [row.get(name, np.nan) for row in rows]
        words = any(isinstance(value, str) for value in values)
        if words:
            values = np.array([value if isinstance(value, str) else "" for value in values], dtype=object)
        data = group.create_dataset(name, data=values, dtype=h5py.string_dtype() if words else None)
        data.dims[0].label = "run" if group.name == "/runs" else "curve"
        if not words:
            data.attrs["units"] = units(name) or "1"


def summarise(words):
    """Writes all of a sweep's summary, prints its gist; `words` is the command line. Returns the exit code."""
    given = parse_arguments(words)
    given.without_block = []
    plan = sweep_plan.read(given.folder)
    rows, names = collect(plan, given)
    curves = fragilities(rows, names, given)
    columns = ["run", "record", "scale", "profile", "settings", "exit", "state", *names, *MEASURES, "reason"]
    write_csv(given.folder / "summary.csv", columns, rows)
    write_csv(given.folder / "fragility.csv", FRAGILITY_COLUMNS, curves)
    part = given.folder / "summary.h5.part"
    with h5py.File(part, "w") as file:
        write_group(file.create_group("runs"), columns, rows, units_of)
        write_group(file.create_group("fragility"), FRAGILITY_COLUMNS, curves, lambda name: "")
    part.replace(given.folder / "summary.h5")
    sweep_page.write(given, plan, rows, names, curves)
    for reason in dict.fromkeys(given.without_block):
        print(f"sweep-summary: no rigid block: {reason}", file=sys.stderr)
    for row in rows:
        if not is_done(row) and not is_unfinished(row):
            print(f"sweep-summary: {row['run']}: {row['state']}: {row['reason']}", file=sys.stderr)
    done, unfinished = (sum(map(check, rows)) for check in (is_done, is_unfinished))
    print(f"{len(rows)} runs: {done} done, {len(rows) - done - unfinished} ended with an error, {unfinished} unfinished")
    for told in curves:
        print(sweep_page.words_of(told, given.confidence))
    print(given.folder / "summary.html")
    failed = [row["exit"] for row in rows if not is_done(row) and not is_unfinished(row)]
    return sweep_run.INTERRUPTED if unfinished else (failed or [0])[0]


def main():
    """Sums up the sweep of the command line; returns the exit code."""
    try:
        return summarise(sys.argv[1:])
    except Refused as reason:
        print(f"sweep-summary: {reason}", file=sys.stderr)
        return reason.code
    except OSError as reason:
        print(f"sweep-summary: {reason}", file=sys.stderr)
        return 74


if __name__ == "__main__":
    sys.exit(main())
