"""Sums up a sweep, finished or under way: scripts/sweep-summary DIR [options].

Intensities of the horizontal outcrop motion as each run applied it, what the slide came to, a rigid block beside it, and
fragility curves with their uncertainty go to DIR/summary.csv, DIR/fragility.csv, DIR/summary.h5 and, with pictures, to the page
DIR/summary.html. Exit code: 75 when runs are unfinished, otherwise that of the first run that failed.
"""
import csv
import sys
from pathlib import Path

import h5py
import numpy as np

import fragility
import sweep_page
import sweep_plan
import sweep_run
from options import Parser
from resolved_case import Refused
from sweep_measures import INTENSITIES, MEASURES, collect, is_done, is_unfinished, varied

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
            told = {"limit": f"{limit} >= {value:g} {MEASURES[limit]}", "measure": limit, "value": value, "intensity": name, "runs": len(used),
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
    return "g" if name.startswith("sa_") else {**INTENSITIES, **MEASURES}.get(name, "")


def write_csv(path, columns, rows, units=units_of):
    """A table with units in its heading; what is not known is empty."""
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow([f"{name} ({units(name)})" if units(name) else name for name in columns])
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
    settings = varied(plan, rows)
    columns = ["run", "record", "scale", "profile", *settings, "exit", "state", *names, *MEASURES, "reason"]
    units = lambda name: settings.get(name) or units_of(name)
    write_csv(given.folder / "summary.csv", columns, rows, units)
    write_csv(given.folder / "fragility.csv", FRAGILITY_COLUMNS, curves)
    part = given.folder / "summary.h5.part"
    with h5py.File(part, "w") as file:
        write_group(file.create_group("runs"), columns, rows, units)
        write_group(file.create_group("fragility"), FRAGILITY_COLUMNS, curves, lambda name: "")
    part.replace(given.folder / "summary.h5")
    sweep_page.write(given, plan, rows, [names, settings], curves)
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
