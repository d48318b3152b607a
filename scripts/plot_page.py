"""One page on a seismic run: section, histories, motion, measures, warnings, resolution and versions."""
import re
import sys
from textwrap import fill

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

import newmark
import plot_sections
import plot_uncertainty
import spectrum
import uncertainty_report
from plot_common import Missing, array, frame_times, group_of, label, open_history, read_summary, text, titled
from plot_histories import read_gauges, read_motion, read_outline

PAGE = (8.27, 11.69)  # inches, A4
MOST_WARNINGS = 6


def draw_section(figure, axis, folder, outline):
    """Plastic strain of the last frame, with the free surface before and after."""
    time, path = frame_times(folder)[-1]
    particles = plot_sections.read_particles(path, "plastic_strain")
    strain = particles["plastic_strain"]
    plot_sections.add_sizes([particles])
    extent = plot_sections.common_extent([particles])
    plot_sections.add_pixels(particles, extent)
    norm = Normalize(0.0, min(plot_sections.MOST_STRAIN, plot_sections.top_of([strain], 99.0)))
    panel = {"title": f"plastic strain at t = {time:.2f} s; the free surface before (dashed) and after", "norm": norm,
             "values": strain, "grey": plot_sections.without_strain([particles])[0], "colours": "inferno_r"}
    plot_sections.draw_panel(axis, particles, panel, extent)
    x, start, end = outline
    axis.plot(x, start, "k--", lw=0.8)
    axis.plot(x, end, "k-", lw=0.8)
    axis.set_ylim(top=max(extent[3], np.nanmax(start) + 2.0))
    axis.set_xlabel("x (m)")
    figure.colorbar(ScalarMappable(norm, "inferno_r"), ax=axis, fraction=0.02, pad=0.01, extend="max")


def mark_trigger(axis, trigger):
    """Vertical line at the trigger time (s), where there is one."""
    if trigger is not None:
        axis.axvline(trigger, color="k", lw=0.8, ls=":")


def draw_gauges(axis, file, trigger, sure):
    """Distance (m) of the gauges from where they were."""
    time, names, fields = read_gauges(file)
    for k, name in enumerate(names):
        plot_uncertainty.shade(axis, sure, f"{name}.displacement", f"C{k % 10}")
        axis.plot(time, np.linalg.norm(fields["displacement"][:, k], axis=1), lw=0.9, label=label(name))
    axis.set_title("displacement of the gauges (m)")
    axis.legend(fontsize=6)
    mark_trigger(axis, trigger)


def draw_slide(axis, file, trigger, sure):
    """Moved area (m2), and the centre of mass' displacement (m) on the right."""
    slide = group_of(file, "slide")
    time = array(slide, "time")
    plot_uncertainty.shade(axis, sure, "moved_area", "C0")
    axis.plot(time, array(slide, "moved_area"), "C0-", lw=1.0)
    axis.set_title("moved ground: area (full), mean displacement (dashed)")
    axis.set_ylabel("area (m²)", color="C0")
    other = axis.twinx()
    plot_uncertainty.shade(other, sure, "run_out", "C1")
    other.plot(time, np.linalg.norm(array(slide, "centre_of_mass_displacement"), axis=1), "C1--", lw=1.0)
    other.set_ylabel("displacement (m)", color="C1")
    other.grid(False)
    other.set_ylim(bottom=0.0)
    axis.set_ylim(bottom=0.0)
    mark_trigger(axis, trigger)


def draw_speed(axis, file, trigger, sure):
    """Speed of the slide (m/s): 99th percentile and centre of mass."""
    slide = group_of(file, "slide")
    time = array(slide, "time")
    plot_uncertainty.shade(axis, sure, "peak_velocity", "C1")
    axis.plot(time, array(slide, "peak_velocity"), "C1", lw=1.0, label="99th percentile")
    velocity = array(slide, "centre_of_mass_velocity")
    axis.plot(time, np.linalg.norm(velocity, axis=1), "C2", lw=1.0, label="centre of mass")
    axis.set_title("speed of the moved ground (m/s)")
    axis.legend(fontsize=6)
    mark_trigger(axis, trigger)


def draw_motion(axis, file, trigger, _):
    """Outcrop acceleration (m/s2), twice the upgoing one as applied; it has no band."""
    time, velocity, acceleration = read_motion(file)
    for component in range(velocity.shape[1]):
        if np.any(velocity[:, component]):
            axis.plot(time, 2.0 * acceleration[:, component], lw=0.6, label=("horizontal", "vertical")[component])
            axis.legend(fontsize=6)
    axis.set_title("outcrop acceleration as applied (m/s²)")
    mark_trigger(axis, trigger)


def value(number, unit, digits=2):
    """A number with its unit, a dash where there is none."""
    return "–" if number is None else f"{number:.{digits}f} {unit}"


def peak_text(peak, unit, bar=""):
    """A greatest value with its uncertainty, its time and place."""
    if peak["time"] is None:
        return "–"
    place = "".join(f" at x = {p[0]:.1f}, y = {p[1]:.1f} m" for p in [peak.get("position")] if p)
    return f"{peak['value']:.2f} {unit}{bar}, t = {peak['time']:.1f} s{place}"


def measures(summary, sure=None):
    """Name and text of the measures of the run, with the uncertainty of those that have one."""
    slide = summary["slide"]
    known = (sure or {}).get("measures", {})
    bar = lambda name: f" ± {plot_uncertainty.half_text(known[name])}" if name in known else ""
    dx, dy = slide["centre_of_mass_displacement"]
    rows = [("trigger time", value(slide["trigger_time"], "s") + bar("trigger_time")),
            ("moved area (over 1 m)", value(slide["moved_area"], "m²", 1) + bar("moved_area")),
            ("moved mass", value(slide["moved_mass"] / 1000.0, "t/m", 1)),
            ("its centre of mass moved", f"{dx:.2f} m in x, {dy:.2f} m in y" + (f"; {np.hypot(dx, dy):.2f} m{bar('run_out')}" if known else "")),
            ("toe advance", value(slide["toe_advance"], "m") + bar("toe_advance") + f", to x = {value(slide['toe'], 'm', 1)}{bar('toe')}"),
            ("greatest velocity, 99th percentile", peak_text(slide["peak_velocity"], "m/s", bar("peak_velocity"))),
            ("greatest velocity, point", peak_text(slide["point_velocity"], "m/s")),
            ("surface rose most", f"{slide['outline_rise']['height']:.2f} m{bar('outline_rise')} at x = {value(slide['outline_rise']['x'], 'm', 1)}"),
            ("surface fell most", f"{slide['outline_fall']['height']:.2f} m{bar('outline_fall')} at x = {value(slide['outline_fall']['x'], 'm', 1)}")]
    for component, motion in summary.get("motion", {}).items():
        m = motion["applied"]
        rows.append((f"{component} motion as applied", f"PGA {m['pga'] / spectrum.GRAVITY:#.3g} g, PGV {m['pgv']:#.3g} m/s, "
                     f"Arias {m['arias']:#.3g} m/s, D5-95 {m['d5_95']:.1f} s"))
    ended = summary.get("motion_ended")
    return rows + ([("motion ended", f"{ended:.2f} s")] if ended is not None else [])


def carried(summary):
    """What the resolution carries, and who computed it."""
    resolution = summary["resolution"]
    lines = [f"cells of {resolution['spacing']:g} m, {resolution['particles_per_cell']} x "
             f"{resolution['particles_per_cell']} particles each, {summary['particles']} particles, {summary['steps']} "
             f"steps of {1e3 * summary['dt']:.3g} ms"]
    lines += [f"{name}: S waves ({m['S']['speed']:.0f} m/s) carried within 1 % up to {m['S']['carried_to']:.1f} Hz"
              for name, m in resolution.get("materials", {}).items()]
    lines += [f"ended with {summary['exit']} after {summary['wall_seconds']:.0f} s on {summary['threads']} threads",
              f"seismpm {summary['version']} ({summary['git']}), case {summary['case_sha256'][:12]}"
              + (f", profile {summary['profile']}" if summary.get("profile") else "")]
    lines += [f"{key}: " + re.sub("([0-9a-f]{12})[0-9a-f]+", r"\1", digest)
              for key, digest in summary.get("digests", {}).items()]
    return lines


def write_text(axis, x, title, lines, width):
    """A heading and lines of text below it, wrapped."""
    wrapped = "\n".join(fill(line, width, subsequent_indent="   ") for line in lines)
    axis.text(x, 1.0, title, fontsize=8, weight="bold", va="top", transform=axis.transAxes)
    axis.text(x, 0.93, wrapped, fontsize=6.5, va="top", transform=axis.transAxes, linespacing=1.35)


def rigid_block_of(folder):
    """Rigid-block analysis of the run; None, and said so, where there is none."""
    try:
        return newmark.stored_or_estimated(folder)
    except (Missing, KeyError, OSError) as reason:
        print(f"plot-run: no rigid block beside the run: {reason}", file=sys.stderr)
        return None


def uncertainty_of(folder):
    """Numerical uncertainty of the run; None, and said so, where it is of another."""
    try:
        return plot_uncertainty.stored(folder)
    except (Missing, ValueError, KeyError, OSError) as reason:
        print(f"plot-run: no uncertainty beside the run: {reason}", file=sys.stderr)
        return None


def draw_words(axis, summary, block, sure):
    """Measures on the left; warnings, resolution and versions on the right."""
    axis.axis("off")
    turns = [uncertainty_report.verdict(sure, grid) for grid in sure["grids"] if grid["name"] in sure["turning_scale"]] if sure else []
    beside = turns + ["rigid block: " + "; ".join(newmark.lines_of(block))] if block else turns
    title = "Measures, ± numerical uncertainty at 95 %" if sure else "Measures"
    write_text(axis, 0.0, title, [f"{name}: {words}" for name, words in measures(summary, sure)] + beside, 70)
    warnings = [text(warning) for warning in summary.get("warnings", [])]
    more = [f"and {len(warnings) - MOST_WARNINGS} more, see log.txt"] if len(warnings) > MOST_WARNINGS else []
    lines = ["! " + warning for warning in warnings[:MOST_WARNINGS]] + more or ["no warnings"]
    write_text(axis, 0.52, "What it carries, and warnings", carried(summary) + lines, 78)


def went_on(file, summary):
    """What is to be said where the histories are of later than the measures: a run that has been taken up again."""
    end = array(group_of(file, "slide"), "time")[-1]
    return f"; measures at t = {summary['time']:.1f} s, before it went on" if end > summary["time"] + 0.2 else ""


def page(folder, heading):
    """One page on the run."""
    summary = read_summary(folder)
    if "slide" not in summary:
        raise Missing("summary.json has no slide")
    trigger = summary["slide"]["trigger_time"]
    with plt.rc_context({"axes.titlesize": 8, "xtick.labelsize": 7, "ytick.labelsize": 7, "axes.labelsize": 7}):
        figure = plt.figure(figsize=PAGE, layout="constrained")
        block, sure = rigid_block_of(folder), uncertainty_of(folder)
        rows = figure.subfigures(5 if block else 4, 1, height_ratios=(3.2, 2.1, 2.1, *([2.1] if block else []), 2.9))
        with open_history(folder) as file:
            heading += went_on(file, summary)
            draw_section(rows[0], rows[0].subplots(), folder, read_outline(file))
            for axis, draw in zip(np.append(rows[1].subplots(1, 2), rows[2].subplots(1, 2)),
                                  (draw_gauges, draw_slide, draw_speed, draw_motion)):
                draw(axis, file, trigger, sure)
                axis.grid(alpha=0.3)
                axis.set_xlabel("time (s); dotted: trigger")
        if block:
            newmark.draw(rows[3].subplots(), folder, block)
        draw_words(rows[-1].subplots(), summary, block, sure)
    return titled(figure, heading)
