"""Runs a case and some of its profiles, both stages, and tells what each did to the slide.

    scripts/vary CASE --profiles a,b,c --out DIR [--start S] [--at S] [--gauge NAME] [--beyond X] [-- options of both]

Results go to DIR/PROFILE-static and DIR/PROFILE (as-is for the case itself); repeated, the command goes on where it was
interrupted, and runs nothing twice. The table is printed, as Markdown, and is DIR/vary.json. Exit code: that of the first
run that failed, after all have been tried.
"""
import argparse
import json
import sys
from pathlib import Path

import numpy as np

from options import Parser
from plot_common import Missing, array, group_of, open_history
from plot_histories import read_gauges
from programs import PROGRAMS
from stages import Failed, both_stages


def parse_arguments(given):
    """The command line, with what follows a lone -- as options of both programs."""
    cut = given.index("--") if "--" in given else len(given)
    parser = Parser(prog="vary", description=__doc__.splitlines()[0],
                    formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", type=Path)
    parser.add_argument("--profiles", type=lambda names: names.split(","), default=[], metavar="a,b,c")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--start", type=float, default=0.0, metavar="S",
                        help="added to all times: when in the record the run begins; default 0 s")
    parser.add_argument("--at", type=float, metavar="S", help="time at which the speed is told; default the end")
    parser.add_argument("--gauge", help="whose greatest speed is told; default none")
    parser.add_argument("--beyond", type=float, metavar="X", help="when the slide's toe passes x = X m is told")
    parser.add_argument("--programs", type=Path, default=PROGRAMS, help="their folder; default: of the build, or installed")
    arguments = parser.parse_args(given[:cut])
    arguments.more = given[cut + 1:]
    return arguments


def run(arguments, profile):
    """Both stages of one profile (None: the case itself); returns the folder and the exit code."""
    name = profile or "as-is"
    chosen = ["--profile", profile] if profile else []
    static, shaken = arguments.out / f"{name}-static", arguments.out / name
    try:
        both_stages(arguments.programs, arguments.case, (static, shaken), [*chosen, *arguments.more])
    except Failed as failure:
        return shaken, failure.code
    return shaken, 0


def first_time(time, holds):
    """The first time (s) at which something holds; None: never."""
    return float(time[np.argmax(holds)]) if np.any(holds) else None


def measures(folder, arguments):
    """Measures of a run by their headings, times with --start added; None where there is no such thing."""
    with open_history(folder) as file:
        slide = group_of(file, "slide")
        time = array(slide, "time") + arguments.start
        area, toe = array(slide, "moved_area"), array(slide, "toe")
        shift = np.linalg.norm(array(slide, "centre_of_mass_displacement"), axis=1)
        high, point = array(slide, "peak_velocity"), array(slide, "point_velocity")
        at = len(time) - 1 if arguments.at is None else min(int(np.searchsorted(time, arguments.at)), len(time) - 1)
        row = {"half has moved (s)": first_time(time, area >= 0.5 * area[-1]) if area[-1] > 0 else None}
        if arguments.gauge:
            gauge_time, names, fields = read_gauges(file)
            if arguments.gauge not in names:
                raise Missing(f"no gauge {arguments.gauge}; there are {', '.join(names)}")
            speed = np.linalg.norm(fields["velocity"][:, names.index(arguments.gauge)], axis=1)
            row[f"greatest speed of {arguments.gauge} (m/s)"] = float(speed.max())
            row["when (s)"] = float(gauge_time[speed.argmax()]) + arguments.start
    row[f"99th percentile at {time[at]:.0f} s (m/s)"] = float(high[at])
    row["greatest 99th percentile (m/s)"] = float(high.max())
    row["fastest point (m/s)"] = float(point.max())
    if arguments.beyond is not None:
        row[f"toe beyond {arguments.beyond:g} m (s)"] = first_time(time, toe > arguments.beyond)
    row["displacement of the centre of mass (m)"] = float(shift[-1])
    row["moved area (m²)"] = float(area[-1])
    return row


def told(value):
    """A number of a table."""
    return "never" if value is None else f"{value:.0f}" if abs(value) >= 200 else f"{value:.1f}"


def table(rows):
    """The rows {name: measures} as Markdown."""
    headings = list(next(iter(rows.values())))
    lines = ["| | " + " | ".join(headings) + " |", "| --- " * (len(headings) + 1) + "|"]
    lines += [f"| {name} | " + " | ".join(told(row[key]) for key in headings) + " |" for name, row in rows.items()]
    return "\n".join(lines)


def main():
    """Runs all, prints and stores the table; returns the exit code."""
    arguments = parse_arguments(sys.argv[1:])
    rows, failed = {}, 0
    for profile in [None, *arguments.profiles]:
        name = profile or "as-is"
        folder, code = run(arguments, profile)
        failed = failed or code
        if code:
            print(f"vary: {name} ended with {code}", file=sys.stderr)
            continue
        try:
            rows[name] = measures(folder, arguments)
        except Missing as reason:
            print(f"vary: {name}: {reason}", file=sys.stderr)
            failed = failed or 66
    if rows:
        (arguments.out / "vary.json").write_text(json.dumps(rows, indent=1) + "\n")
        print(table(rows))
    return failed


if __name__ == "__main__":
    sys.exit(main())
