"""A report of a run: scripts/report RUN_FOLDER [--out FILE.html].

One HTML file with all pictures in it, which opens offline, reads on a phone and prints on A4. Whatever the folder holds is
shown, also of a run that is under way, and what it lacks is said. The file is made anew each time; no other file is replaced.
"""
import sys
from pathlib import Path

import matplotlib.pyplot as plt

import report_html
import report_motion
import report_run
import report_site
import report_slide
from options import Parser
from plot_common import Missing
from whole_file import write_whole

STATIC = (("Scene and materials", (report_run.scene,)), ("Stresses", (report_run.static_stress,)),
          ("What the grid carries", (report_run.resolution,)), ("Warnings", (report_run.warnings,)), ("Case", (report_run.case,)))
SEISMIC = (("Scene and materials", (report_run.scene,)),
           ("Slide", (report_slide.measures, report_slide.outline, report_slide.series, report_slide.rigid_block)),
           ("Film", (report_slide.moving,)), ("Sections", (report_slide.sections,)),
           ("Motion as applied", (report_motion.applied,)), ("Motions in numbers", (report_motion.numbers,)),
           ("Histories", (report_motion.histories,)), ("Response spectra", (report_motion.spectra,)),
           ("Amplification", (report_site.amplified,)), ("Free field with depth", (report_site.profiles,)),
           ("Energy", (report_slide.energy,)), ("What the grid carries", (report_run.resolution,)),
           ("Warnings", (report_run.warnings,)), ("Case, versions and command", (report_run.case,)))


def parse_arguments():
    """The command line."""
    parser = Parser(prog="report", description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, metavar="RUN_FOLDER", help="output folder of mpm-static or mpm-seismic")
    parser.add_argument("--out", type=Path, metavar="FILE", help="default RUN_FOLDER/report.html")
    given = parser.parse_args()
    given.out = given.out or given.folder / "report.html"
    return given


def guarded(part, run, damaged):
    """HTML of a part, or a note that says why there is none; what cannot be read is added to `damaged`."""
    try:
        return part(run)
    except Missing as reason:
        return report_html.paragraph(f"Not shown: {reason}.", "note")
    except (OSError, KeyError, ValueError, TypeError, IndexError) as reason:
        plt.close("all")
        damaged.append(f"{part.__name__}: {type(reason).__name__}: {reason}")
        told = f"Not shown, since a file of the run is damaged or of another version: {reason}."
        return report_html.paragraph(told, "note warning")


def refusal(given):
    """What is wrong with folder or output, with the exit code; None if nothing is."""
    folder, out = given.folder, given.out
    wanted = "give the output folder of mpm-static or mpm-seismic"
    if not folder.is_dir():
        return f"{folder}: no such folder; {wanted}", 66
    if not (folder / "identity.json").exists():
        return f"{folder}: no identity.json, so that it is no run's folder; {wanted}", 66
    if out.exists() and not (out.is_file() and report_html.MARK in out.read_text(errors="replace")[:2000]):
        return f"{out}: is there already and no report; give another --out", 73
    return None


def main():
    """Makes the report; returns the exit code."""
    given = parse_arguments()
    refused = refusal(given)
    if refused:
        print(f"report: {refused[0]}", file=sys.stderr)
        return refused[1]
    run, damaged = report_run.Run(given.folder), []
    with plt.rc_context(report_html.STYLE):
        try:
            sections = [(title, "".join(guarded(part, run, damaged) for part in parts))
                        for title, parts in (STATIC if run.stage == "static" else SEISMIC)]
            page = report_html.page(run.title, guarded(report_run.lead, run, damaged), sections)
            write_whole(given.out, page)
        except OSError as reason:
            print(f"report: {given.out}: {reason}", file=sys.stderr)
            return 74
    for reason in damaged:
        print(f"report: not shown: {reason}", file=sys.stderr)
    print(f"{given.out}: {given.out.stat().st_size / 1e6:.1f} MB")
    return 65 if damaged else 0


if __name__ == "__main__":
    sys.exit(main())
