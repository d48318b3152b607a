"""Draws the results of a run: scripts/plot-run RUN_FOLDER [--times t1,t2,...] [--format svg] [--out DIR].

Whatever the folder holds is drawn, whatever it lacks is said. Exit 66 when there is nothing to draw.
SI units, x right, y up, tension positive.
"""
import sys
from pathlib import Path

import plot_common
import plot_energy
import plot_fields
import plot_histories
import plot_page
import plot_sections
from options import Parser


def time_list(given):
    """Times (s) of a comma-separated list."""
    return [float(part) for part in given.split(",")]


def parse_arguments():
    """The command line."""
    parser = Parser(prog="plot-run", description="Draws the results of a static or seismic run.")
    parser.add_argument("folder", type=Path, metavar="RUN_FOLDER", help="output folder of mpm-static or mpm-seismic")
    parser.add_argument("--times", type=time_list, metavar="t1,t2,...",
                        help="times (s) of the sections, the nearest frames are drawn; default six evenly spread")
    parser.add_argument("--format", choices=plot_common.FORMATS, default="png",
                        help="svg and pdf draw lines as lines; default png")
    parser.add_argument("--out", type=Path, metavar="DIR", help="default RUN_FOLDER/pictures")
    return parser.parse_args()


def main():
    """Draws every picture the folder has the data for; returns the exit code."""
    arguments = parse_arguments()
    folder, out = arguments.folder, arguments.out or arguments.folder / "pictures"
    if not folder.is_dir():
        print(f"plot-run: {folder}: no such folder", file=sys.stderr)
        return 66
    out.mkdir(parents=True, exist_ok=True)
    summary = plot_common.read_summary(folder)
    if plot_common.stage_of(folder, summary) == "static":
        pictures = [("static_stress", plot_sections.static_stress, ())]
    else:
        pictures = [("plastic_strain", plot_fields.section, (arguments.times, "plastic_strain")),
                    ("displacement", plot_fields.section, (arguments.times, "displacement")),
                    ("histories", plot_histories.histories, ()), ("motion", plot_histories.motion, ()),
                    ("slide", plot_histories.slide, ()), ("energy", plot_energy.energy, ()),
                    ("summary", plot_page.page, ())]
    drawn = 0
    for name, draw, extra in pictures:
        name += f".{arguments.format}"
        try:
            figure = draw(folder, plot_common.heading_of(folder, summary), *extra)
            plot_common.write(figure, out / name, bbox_inches=None if draw is plot_page.page else "tight")
            drawn += 1
        except (plot_common.Missing, OSError, ValueError) as reason:
            print(f"plot-run: {name} not drawn: {reason}", file=sys.stderr)
    return 0 if drawn else 66


if __name__ == "__main__":
    sys.exit(main())
