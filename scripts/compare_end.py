"""Shakes a slope twice under each record, to the end of the record and until the slide is self-driven, and compares.

    scripts/compare-end CASE --from STATIC/final.h5 --out DIR --record FILE[,dt[,unit]] ... [--end '12 s']
                        [-- options of mpm-seismic]

All runs start from one static state and go to DIR/RECORD-never and DIR/RECORD-self_driven, or DIR/RECORD-12s with an end
of one's own choice; repeated, the command goes on where it was interrupted. The comparison is DIR/compare-end.png and, in numbers, DIR/compare-end.json.
"""
import argparse
import json
import subprocess
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

import plot_sections
from options import Parser
from plot_common import WIDTH, array, frame_times, group_of, open_history, read_summary, save
from plot_histories import read_outline
from plot_page import measures
from programs import PROGRAMS

WHOLE = "never"


def parse_arguments(given):
    """The command line, with what follows a lone -- as options of mpm-seismic."""
    cut = given.index("--") if "--" in given else len(given)
    parser = Parser(prog="compare-end", description=__doc__.splitlines()[0],
                    formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", type=Path)
    parser.add_argument("--from", dest="static", type=Path, required=True, metavar="STATIC/final.h5")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--record", action="append", required=True, metavar="FILE[,dt[,unit]]",
                        help="dt in s and unit of a record that does not tell them; repeatable")
    parser.add_argument("--end", default="self_driven", help="seismic.motion.end of the shorter run; default self_driven")
    parser.add_argument("--program", type=Path, default=PROGRAMS / "mpm-seismic", help="default: of the build, or installed")
    arguments = parser.parse_args(given[:cut])
    arguments.more = given[cut + 1:]
    return arguments


def ends_of(arguments):
    """The two ends of the motion, and what the pictures call them."""
    until = "self-driven" if arguments.end == "self_driven" else arguments.end
    return {arguments.end: f"motion until {until}", WHOLE: "whole motion"}


def shake(arguments, record, end):
    """One run; returns its folder. Ends the program as mpm-seismic does when that fails."""
    path, *told = record.split(",")
    folder = arguments.out / f"{Path(path).stem}-{end.replace(' ', '')}"
    command = [arguments.program, arguments.case, "--from", arguments.static, "--out", folder, "--motion", path,
               "--set", f"seismic.motion.end={end}", *arguments.more]
    for option, value in zip(("--record-dt", "--record-unit"), told):
        command += [option, value]
    code = subprocess.run([str(part) for part in command], check=False).returncode
    if code:
        sys.exit(code)
    return folder


def draw_section(axis, folder, norm):
    """Plastic strain at the end, and the free surface before and after."""
    time, path = frame_times(folder)[-1]
    particles = plot_sections.read_particles(path, "plastic_strain")
    plot_sections.add_sizes([particles])
    extent = plot_sections.common_extent([particles])
    plot_sections.add_pixels(particles, extent)
    summary = read_summary(folder)
    ended = summary.get("motion_ended")
    words = "whole motion" if ended is None else f"motion until {ended:.1f} s"
    plot_sections.draw_panel(axis, particles, {
        "title": f"{summary['motion_title']}, {words}, t = {time:.1f} s: {summary['slide']['moved_area']:.0f} m² moved",
        "values": particles["plastic_strain"], "grey": plot_sections.without_strain([particles])[0],
        "colours": "inferno_r", "norm": norm}, extent)
    with open_history(folder) as file:
        x, start, end = read_outline(file)
    axis.plot(x, start, "k--", lw=0.7)
    axis.plot(x, end, "k-", lw=0.7)
    axis.set_ylim(top=max(extent[3], np.nanmax(start) + 2.0))


def draw_histories(axes, folders, ends):
    """Moved area (m2) and displacement (m) of its centre of mass, both ends (and what they are called)."""
    for colour, (end, folder) in zip(("C0", "C1"), folders.items()):
        with open_history(folder) as file:
            slide = group_of(file, "slide")
            time, area = array(slide, "time"), array(slide, "moved_area")
            shift = np.linalg.norm(array(slide, "centre_of_mass_displacement"), axis=1)
        for axis, values, label in zip(axes, (area, shift), ("moved area (m²)", "its displacement (m)")):
            axis.plot(time, values, colour, lw=1.0, label=ends[end])
            axis.set_ylabel(label)
            axis.grid(alpha=0.3)
        ended = read_summary(folder).get("motion_ended")
        if ended is not None:
            axes[0].axvline(ended, color="k", lw=0.8, ls=":")
            axes[1].axvline(ended, color="k", lw=0.8, ls=":")
    axes[0].legend(fontsize=7)
    for axis in axes:
        axis.set_xlabel("time (s)")


def draw(runs, ends, out):
    """compare-end.png: sections side by side as in the paper's figure 6, histories below, record by record."""
    norm = Normalize(0.0, plot_sections.MOST_STRAIN)
    figure = plt.figure(figsize=(1.7 * WIDTH, 5.6 * len(runs) + 0.6), layout="constrained")
    for part, folders in zip(np.atleast_1d(figure.subfigures(len(runs), 1)), runs.values()):
        axes = part.subplots(2, 2, height_ratios=(1.2, 1.0))
        for axis, end in zip(axes[0], ends):
            draw_section(axis, folders[end], norm)
        part.colorbar(ScalarMappable(norm, "inferno_r"), ax=axes[0], label="plastic strain", extend="max",
                      fraction=0.02, pad=0.01)
        draw_histories(axes[1], folders, ends)
    save(figure, out / "compare-end.png", "The motion ended early, and not (dotted: its end)")


def main():
    """Runs, draws, prints; returns the exit code."""
    arguments = parse_arguments(sys.argv[1:])
    if not arguments.program.exists():
        print(f"compare-end: {arguments.program} is missing; build first (scripts/run)", file=sys.stderr)
        return 66
    ends = ends_of(arguments)
    runs = {Path(record.split(",")[0]).stem: {end: shake(arguments, record, end) for end in ends}
            for record in arguments.record}
    numbers = {}
    for name, folders in runs.items():
        summaries = {end: read_summary(folder) for end, folder in folders.items()}
        numbers[name] = {end: {"motion_ended": s["motion_ended"], **s["slide"]} for end, s in summaries.items()}
        for end, summary in summaries.items():
            print(f"{name}, {ends[end]}: " + "; ".join(f"{what} {words}" for what, words in measures(summary)))
    (arguments.out / "compare-end.json").write_text(json.dumps(numbers, indent=1) + "\n")
    draw(runs, ends, arguments.out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
