"""Takes results of a run along: scripts/export RUN_FOLDER [--gauge NAME] [--section X [--time S]] [--out DIR].

Series as CSV, motions as PEER's .AT2 (g), for structural models and as --motion of mpm-seismic; with --section the profile of
all fields with depth at an x and a time. SI units but for stresses of sections (kPa); tension positive, p compression.
"""
import csv
import io
import re
import sys
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

import peer
import plot_fields
import plot_sections
import report_motion
import spectrum
from options import Parser
from plot_common import ENVELOPES, Missing, array, envelopes, frame_times, open_history, text
from plot_histories import read_gauges
from report_run import Run
from whole_file import write_whole

GROUPS = ("motion", "slide", "base", "energy", "free_field/left", "free_field/right")


class Refused(Exception):
    """Says what of the command line does not fit the run; the program ends with 64."""


def parse_arguments():
    """The command line."""
    parser = Parser(prog="export", description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, metavar="RUN_FOLDER", help="output folder of mpm-seismic")
    parser.add_argument("--gauge", action="append", metavar="NAME", help="only this gauge; may be given more than once")
    parser.add_argument("--section", type=float, metavar="X", help="the profile of the fields with depth at this x (m), instead")
    parser.add_argument("--time", type=float, metavar="S", help="of the section: the nearest frame; default the last")
    parser.add_argument("--fields", metavar="A,B", help="of the section; default all that the frame holds of: "
                        + ", ".join(plot_fields.FIELDS))
    parser.add_argument("--out", type=Path, metavar="DIR", help="default RUN_FOLDER/export")
    parser.add_argument("--force", action="store_true", help="replace files that are there")
    given = parser.parse_args()
    given.out = given.out or given.folder / "export"
    if given.section is None and (given.time is not None or given.fields):
        parser.error("--time and --fields go with --section X")
    if given.section is not None and given.gauge:
        parser.error("--gauge does not go with --section: give them one after the other")
    return given


def stems(names):
    """By gauge, the beginning of its files' names, as any file system takes it and of no other gauge."""
    found = {}
    for name in names:
        stem = plain = "gauge-" + (re.sub(r"[^\w.-]+", "_", name).strip("._") or "unnamed")
        count = 1
        while stem.lower() in map(str.lower, found.values()):
            count += 1
            stem = f"{plain}_{count}"
        found[name] = stem
    return found


def table(columns):
    """CSV of (head, values) of one length."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([head for head, _ in columns])
    writer.writerows(zip(*([value if isinstance(value, str) else f"{value:.9g}" for value in values] for _, values in columns)))
    return out.getvalue()


def profile(found):
    """CSV of the greatest values of a column, from the surface down; strains, which are between rows, leave the last place empty."""
    heads = ("greatest horizontal acceleration (m/s2)", "greatest shear strain", "greatest shear stress (Pa)")
    columns = []
    for head, (depth, values) in zip(heads, found.values()):
        columns += [(f"depth (m) of the {head.split(' (')[0]}", depth[::-1]), (head, values[::-1])]
    count = max(len(values) for _, values in columns)
    return table([(head, [f"{value:.9g}" for value in values] + [""] * (count - len(values))) for head, values in columns])


def names_of(group, size):
    """What the entries of a dimension are called: the labels of the group that has so many of them."""
    for key in ("component", "corner"):
        if key in group and len(group[key]) == size:
            return [text(name) for name in group[key][...]]
    return [str(k) for k in range(size)]


def series(group, where):
    """Columns of a group: its time, then every series, component by component."""
    time = array(group, "time")
    columns = [("time (s)", time)]
    for name, data in group.items():
        if name in ("time", "height", "middle_height", *ENVELOPES) or getattr(data, "shape", ())[:1] != time.shape or data.dtype.kind != "f":
            continue
        unit = text(data.attrs.get("units", "")) or "1"
        corners = ["left", "right"] if data.ndim == 3 else [""]
        for k, place in np.ndenumerate(np.arange(int(np.prod(data.shape[1:]))).reshape(data.shape[1:])):
            parts = ([corners[k[0]]] if data.ndim == 3 else []) + ([names_of(group, data.shape[-1])[k[-1]]] if k else [])
            head = " ".join([name.replace("_", " "), *parts]) + f" ({unit})"
            columns.append((head, data[...].reshape(len(time), -1)[:, place]))
    if len(columns) == 1:
        raise Missing(f"{where} has no series")
    return columns


def gauge_columns(file, k):
    """Columns of a gauge: acceleration (slope of the velocity's spline), velocity, displacement, in total and from the base."""
    time, _, fields = read_gauges(file)
    velocity, moved = fields["velocity"][:, k], fields["displacement"][:, k]
    known = np.isfinite(velocity).all(axis=1)
    acceleration = np.full_like(velocity, np.nan)
    if known.sum() >= 4:
        acceleration[known] = CubicSpline(time[known], velocity[known])(time[known], 1)
    parts = [("acceleration", "m/s2", acceleration), ("velocity", "m/s", velocity), ("displacement", "m", moved)]
    if "free_field/left/base_displacement" in file:
        parts.append(("displacement relative to base", "m", moved - file["free_field/left/base_displacement"][...]))
    return [("time (s)", time)] + [(f"{name} {axis} ({unit})", values[:, c]) for name, unit, values in parts
                                   for c, axis in enumerate("xy")]


def at2(motion, component, title):
    """Header and values (g) of a motion, as PEER writes them."""
    words = f"{title}, computed by seismpm", f"{motion.name.strip()}, {component}"
    header = [part.encode("ascii", "replace").decode() for part in words]
    return header + ["ACCELERATION TIME SERIES IN UNITS OF G"], motion.acceleration[:, "xy".index(component)] / spectrum.GRAVITY


def motions_of(run, stem_of, alone):
    """(name, motion, component) of the gauges and, unless these are `alone`, of outcrop and free field, where they move."""
    outcrop, surface = report_motion.read(run)
    named = [("outcrop", outcrop)] if outcrop and not alone else []
    for motion in surface:
        name = motion.name.strip()
        if not motion.free_field and name in stem_of:
            named.append((stem_of[name], motion))
        elif motion.free_field and not alone:
            named.append((name.replace("free field, ", "free_field-"), motion))
    return [(f"{name}-{component}", motion, component) for name, motion in named for component in "xy"
            if np.any(motion.acceleration[:, "xy".index(component)])]


def measures(motions):
    """Measures of all motions, one row for each of their components."""
    rows = []
    for name, motion, component in motions:
        acceleration, dt = motion.component("xy".index(component))
        found = spectrum.intensity_measures(acceleration, motion.velocity[:, "xy".index(component)], dt)
        known = [period for period in report_motion.PERIODS if period >= 4 * dt]
        spectral = dict(zip(known, spectrum.pseudo_acceleration(acceleration, dt, known)))
        rows.append([name, *found.values(), *(spectral.get(period, np.nan) for period in report_motion.PERIODS)])
    heads = ["motion", "PGA (m/s2)", "time of PGA (s)", "PGV (m/s)", "Arias intensity (m/s)", "CAV (m/s)", "D5-95 (s)"]
    heads += [f"5 % Sa at {period:g} s (m/s2)" for period in report_motion.PERIODS]
    return table(list(zip(heads, zip(*rows))))


def histories(given):
    """Name and content of every file of the series; an .AT2 file's content is (header, values, step)."""
    run, files, alone = Run(given.folder), {}, bool(given.gauge)
    if run.stage == "static":
        raise Missing("this is a static state, which has no series; --section X writes a profile of it")
    with open_history(given.folder) as file:
        names = read_gauges(file)[1] if "gauges" in file else []
        for name in given.gauge or []:
            if name not in names:
                raise Refused(f"--gauge {name}: the run has no such gauge; it has: {', '.join(names) or 'none'}")
        stem_of = {name: stem for name, stem in stems(names).items() if not alone or name in given.gauge}
        for name, stem in stem_of.items():
            files[f"{stem}.csv"] = table(gauge_columns(file, names.index(name)))
        for where in GROUPS if not alone else ():
            if where in file:
                files[where.replace("/", "-") + ".csv"] = table(series(file[where], where))
        for side in ("left", "right") if not alone else ():
            if found := envelopes(file, side):
                files[f"free_field-{side}-profile.csv"] = profile(found)
        if "outline" in file and not alone:
            files["outline.csv"] = table([(f"{name} (m)", file[f"outline/{key}"][...]) for key, name in
                                          (("x", "x"), ("start", "height at the start"), ("end", "height"))])
    if not files:
        raise Missing("history.h5 has no series that could be written")
    motions = motions_of(run, stem_of, alone)
    title = text(run.summary.get("name") or given.folder.resolve().name)
    files |= {f"{name}.AT2": (*at2(motion, component, title), motion.dt) for name, motion, component in motions}
    if not alone:
        files["measures.csv"] = measures(motions)
    missing = [name for name, stem in stem_of.items() if not {f"{stem}-x.AT2", f"{stem}-y.AT2"} & set(files)]
    if missing:
        print(f"export: no .AT2 of {', '.join(missing)}: the history has gaps, is too short, or does not move", file=sys.stderr)
    return files


def section(given):
    """Name and content of the file of a section."""
    wanted = given.fields.split(",") if given.fields else list(plot_fields.FIELDS)
    for name in wanted:
        if name not in plot_fields.FIELDS:
            raise Refused(f"--fields {name}: there is no such field; there are: {', '.join(plot_fields.FIELDS)}")
    run, columns, rows = Run(given.folder), [], None
    if run.stage == "static":
        time, path = 0.0, run.state()
    else:
        frames = frame_times(given.folder)
        time, path = plot_sections.choose(frames, [given.time])[0] if given.time is not None else frames[-1]
    for name in wanted:
        try:
            particles = plot_fields.read(path, name, run.settings)
        except Missing as reason:
            if given.fields:
                raise Missing(f"{name}: {reason}") from reason
            continue
        if rows is None:
            rows = below(particles, given.section, path.name)
            y = particles["position"][rows, 1]
            columns = [("y (m)", y), ("depth (m)", y[0] + 0.5 * particles["size"][rows[0]] - y),
                       ("x (m)", particles["position"][rows, 0])]
            if "material_names" in particles:
                columns.append(("material", [particles["material_names"][k] for k in particles["material"][rows]]))
        unit = re.search(r" \((m/s|m|kPa)\b", plot_fields.FIELDS[name].label)
        columns.append((name.replace("_", " ") + (f" ({unit[1]})" if unit else ""), particles["values"][rows]))
    return {f"section-x{given.section:g}-t{time:g}.csv": table(columns)}


def below(particles, x, where):
    """Indices of the particles that a vertical line at x (m) passes through, from the surface down."""
    plot_sections.add_sizes([particles])
    rows = np.flatnonzero(np.abs(particles["position"][:, 0] - x) <= 0.5 * particles["size"])
    if not len(rows):
        left, right = particles["position"][:, 0].min(), particles["position"][:, 0].max()
        raise Missing(f"--section {x:g}: no ground is there in {where}; it lies from x = {left:.1f} to {right:.1f} m")
    return rows[np.argsort(-particles["position"][rows, 1])]


def write(files, out):
    """Writes all files, each whole or not at all."""
    out.mkdir(parents=True, exist_ok=True)
    for name, content in files.items():
        path = out / name
        if isinstance(content, tuple):
            peer.write(str(path), *content)
        else:
            write_whole(path, content)
        print(path)


def main():
    """Writes what is asked for; returns the exit code."""
    given = parse_arguments()
    try:
        if not given.folder.is_dir():
            raise Missing("no such folder; give the output folder of mpm-seismic")
        files = histories(given) if given.section is None else section(given)
        there = [name for name in files if (given.out / name).exists()]
        if there and not given.force:
            print(f"export: {given.out / there[0]}: is there already; give another --out, or --force to replace it",
                  file=sys.stderr)
            return 73
        write(files, given.out)
    except Refused as reason:
        print(f"export: {reason}", file=sys.stderr)
        return 64
    except Missing as reason:
        print(f"export: {given.folder}: {reason}", file=sys.stderr)
        return 66
    except (OSError, KeyError, ValueError) as reason:
        print(f"export: {given.folder}: a file cannot be read or written: {reason}", file=sys.stderr)
        return 65 if not isinstance(reason, PermissionError) else 74
    return 0


if __name__ == "__main__":
    sys.exit(main())
