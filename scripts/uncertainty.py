"""Tells how sure every number of a case is: runs it on its own grid, on two coarser ones and on shifted ones.

    scripts/uncertainty CASE --out DIR [--shifts 0,3,4] [--ratios 1.55,2.4] [--bisections N] [-- options of the programs]

Results go to DIR/as-is, the case as it is, and beside it to a folder for each grid (DIR/h1.55, DIR/h1.55-shift1, each with
its -static). Repeated, the command goes on where it was interrupted, and runs nothing twice. Each measure is told as value,
uncertainty at 95 % and observed order: printed, in DIR/uncertainty.json, as bands in DIR/uncertainty.png, and in
DIR/as-is, whose page plot-run then draws with them. Where the slope stands on one grid and fails on another, the scale of
the motion at which it turns is looked for on each size of cells. Exit code: that of the first run that ended the series.
"""
import argparse
import json
import sys
from pathlib import Path

import grids
import plot_uncertainty
import uncertainty_report
from options import Parser
from plot_common import Missing, read_summary
from run_measures import slid
from programs import PROGRAMS
from stages import Failed, both_stages, numbers, resolved_case, split_options, with_settings
from turning import turning
from whole_file import write_whole

LEFT_OUT = (65, 80, 81)            # exit codes that tell of the grid: bad for the case, diverged, does not settle
SHIFTS = (0, 3, 4)                 # shifted grids with the case's cells, the next and the coarsest: 1.15 of the case's work


def list_of(kind, count):
    """A parser of so many numbers with commas between them."""
    def parse(given):
        values = tuple(kind(part) for part in given.split(","))
        if len(values) != count or min(values) < 0:
            raise argparse.ArgumentTypeError(f"'{given}' is not {count} numbers from 0 on, with commas between them")
        return values
    parse.__name__ = f"list of {count} numbers"
    return parse


def parse_arguments(given):
    """The command line, with what follows a lone -- as options of the programs."""
    cut = given.index("--") if "--" in given else len(given)
    parser = Parser(prog="uncertainty", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--shifts", type=list_of(int, 3), default=SHIFTS, metavar="N,N,N",
                        help="shifted grids with the case's cells, with the next and with the coarsest; default 0,3,4")
    parser.add_argument("--ratios", type=list_of(float, 2), default=grids.RATIOS, metavar="R,R",
                        help="of the coarser cells to the case's; default 1.55,2.4, a third of the case's work")
    parser.add_argument("--bisections", type=int, default=4, metavar="N",
                        help="runs on each size of cells to find the scale at which the slope turns; default 4")
    parser.add_argument("--programs", type=Path, default=PROGRAMS, help="their folder; default: of the build, or installed")
    arguments = parser.parse_args(given[:cut])
    if arguments.bisections < 0:
        parser.error("--bisections: must be 0 or more")
    arguments.both, arguments.seismic = split_options(given[cut + 1:])
    if any(word.split("=")[0] in ("--out", "--from", "--fresh", "--check") for word in arguments.both):
        parser.error("--out, --from, --fresh and --check are no options of a series; give --out before the --")
    if not arguments.case.exists():
        parser.exit(66, f"uncertainty: {arguments.case}: no such file\n")
    return arguments


def scaled(options, factor):
    """Options of mpm-seismic with the motion `factor` times as strong."""
    kept, scale, words = [], 1.0, iter(options)
    for word in words:
        if word == "--scale":
            scale = float(next(words))
        elif word.startswith("--scale="):
            scale = float(word[8:])
        else:
            kept.append(word)
    return [*kept, "--scale", f"{scale * factor:.8g}"]


class Series:
    """The runs of a case on several grids, as they become known."""

    def __init__(self, arguments):
        """Reads the case and plans its grids."""
        self.arguments = arguments
        self.settings = resolved_case(arguments.programs, arguments.case, arguments.both)
        self.grids = grids.plan(self.settings, arguments.shifts, arguments.ratios)
        self.weight = numbers(self.settings["static.gravity"])[0] > 0
        self.area = numbers(self.settings["output.slide.area"])[0]
        self.left_out = {}  # names of grids, and with which code they ended
        self.known = arguments.out / "left_out.json"  # the same with their options, so that none is tried twice

    def folder(self, grid, factor=1.0):
        """Where a grid's results go, with the motion `factor` times as strong."""
        return self.arguments.out / (grid.name if factor == 1.0 else f"{grid.name}-x{factor:g}")

    def run(self, grid, factor=1.0):
        """Both stages on a grid; returns the folder. The static state serves all factors."""
        static = self.arguments.out / f"{grid.name}-static" if self.weight else None
        seismic = self.arguments.seismic if factor == 1.0 else scaled(self.arguments.seismic, factor)
        print(f"uncertainty: {self.folder(grid, factor).name}", file=sys.stderr)
        both_stages(self.arguments.programs, self.arguments.case, (static, self.folder(grid, factor)),
                    with_settings(self.arguments.both, grid.settings), seismic)
        return self.folder(grid, factor)

    def run_all(self):
        """All grids, coarsest first. One that cannot be run is left out, unless it is the case's own."""
        options = [str(self.arguments.case), *self.arguments.both, *self.arguments.seismic]
        known = json.loads(self.known.read_text()) if self.known.exists() else {}
        failed = known["grids"] if known.get("options") == options else {}
        for grid in self.grids:
            try:
                if grid.name in failed:
                    raise Failed(failed[grid.name])
                self.run(grid)
            except Failed as failure:
                if failure.code not in LEFT_OUT or grid.name == "as-is":
                    raise
                print(f"uncertainty: {grid.name} ended with {failure.code}; it is left out", file=sys.stderr)
                self.left_out[grid.name] = failure.code
                write_whole(self.known, json.dumps({"options": options, "grids": self.left_out}) + "\n")
        self.grids = [grid for grid in self.grids if grid.name not in self.left_out]

    def fails(self, grid, factor=1.0):
        """Whether the slope fails on a grid."""
        return slid(read_summary(self.run(grid, factor)), self.area)

    def turnings(self, verdicts):
        """Bracket of the turning scale on each size of cells, where the grids' verdicts differ; else none."""
        if len(set(verdicts.values())) < 2:
            return {}
        return {grid.name: turning(lambda factor: self.fails(grid, factor), verdicts[grid.name], self.arguments.bisections)
                for grid in self.grids if not any(grid.shift)}


def main():
    """Runs all, writes numbers, table and picture; returns the exit code."""
    arguments = parse_arguments(sys.argv[1:])
    try:
        series = Series(arguments)
        series.run_all()
        verdicts = {grid.name: slid(read_summary(series.folder(grid)), series.area) for grid in series.grids}
        result = uncertainty_report.report(series, verdicts, series.turnings(verdicts))
    except Failed as failure:
        return failure.code
    except grids.BadGrid as reason:
        print(f"uncertainty: {arguments.case}: {reason}", file=sys.stderr)
        return 65
    except (Missing, KeyError, OSError) as reason:
        print(f"uncertainty: {arguments.out}: {reason}", file=sys.stderr)
        return 66
    text = json.dumps(result, indent=1, allow_nan=False) + "\n"
    write_whole(arguments.out / "uncertainty.json", text)
    write_whole(arguments.out / "as-is" / "uncertainty.json", text)
    print("\n".join(uncertainty_report.lines(result)))
    plot_uncertainty.draw(result, arguments.out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
