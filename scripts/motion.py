"""Makes a motion of a record: turned, cut, filtered, brought to another depth, matched to a spectrum, scaled.

    scripts/motion EAST.AT2 NORTH.AT2 --azimuth 215 --from 30 --out CHY080-215.AT2
    scripts/motion RECORD.AT2 --band 0.1,25 --baseline linear --pga 0.3 --out MY.AT2
    scripts/motion SURFACE.AT2 --band 0.1,15 --column LAYERS.csv --out OUTCROP.AT2
    scripts/motion RECORD.AT2 --match TARGET.csv --out MATCHED.AT2

Reads accelerations in every format that mpm-seismic reads. Steps are taken in the order of --help, whatever that of the command line. Beside OUT.AT2 are written
OUT.csv (time and acceleration), OUT-spectrum.csv and OUT.png, before and after; the heads tell what was done.
"""
import argparse
import csv
import os
import sys
from pathlib import Path

import numpy as np

import motion_steps
import peer
import soil_column
import spectrum
from motion_page import draw
from options import Parser
from whole_file import write_whole

PERCENTILES = (50, 100)


def pair_of(words):
    """Two numbers, either of which may be left out: ",25"."""
    low, comma, high = words.partition(",")
    if not comma:
        raise argparse.ArgumentTypeError(f"'{words}' is no LOW,HIGH; leave one of both out for a high-pass or a low-pass")
    return tuple(float(part) if part else None for part in (low, high))


def place(words):
    """surface, outcrop, or a depth (m)."""
    if words not in ("surface", "outcrop") and not 0 <= float(words) <= soil_column.LONGEST:
        raise argparse.ArgumentTypeError(f"'{words}' is no depth from 0 to {soil_column.LONGEST} m")
    return words


def parse_arguments(given):
    """The command line."""
    parser = Parser(prog="motion", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("east", metavar="EAST", help="or the only component")
    parser.add_argument("north", metavar="NORTH", nargs="?")
    turn = parser.add_mutually_exclusive_group()
    turn.add_argument("--azimuth", type=float, metavar="DEG", help="of two components that along this azimuth, clockwise from north")
    turn.add_argument("--rotd", type=float, nargs=2, metavar=("N", "T"), help="that whose Sa at the period T (s) is the Nth percentile of all azimuths: 50 or 100")
    parser.add_argument("--from", dest="begin", type=float, default=0.0, metavar="S", help="s of the record; default 0")
    parser.add_argument("--until", dest="end", type=float, metavar="S", help="s of the record; default its end")
    parser.add_argument("--dt", type=float, metavar="S", help="another step")
    parser.add_argument("--band", type=pair_of, metavar="LOW,HIGH", help="Butterworth of order 4 from LOW to HIGH (Hz), zero phase; one of both may be left out")
    parser.add_argument("--baseline", choices=("linear", "quadratic", "cubic"), help="takes a polynomial off the velocity, which then ends at zero")
    parser.add_argument("--taper", type=float, metavar="S", help="brings the velocity to rest over S s at both ends")
    parser.add_argument("--column", type=Path, metavar="FILE", help=f"layers, as a table with the columns {', '.join(soil_column.HEADS)}; the last is the half-space".replace("%", "%%"))
    parser.add_argument("--recorded", type=place, default="surface", metavar="PLACE", help="of the column where the record is of: surface (default), outcrop of the half-space, or a depth in m")
    parser.add_argument("--wanted", type=place, default="outcrop", metavar="PLACE", help="whose motion is wanted; default outcrop")
    parser.add_argument("--match", type=Path, metavar="FILE", help="a 5 %% response spectrum to be matched: a table with the columns period (s), Sa (g)")
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--scale", type=float, metavar="F", help="a factor")
    size.add_argument("--pga", type=float, metavar="G", help="the greatest acceleration (g)")
    size.add_argument("--sa", type=float, nargs=2, metavar=("T", "G"), help="5 %% Sa (g) at a period (s)")
    for name, meaning in (("dt", "time step in s of records that do not tell it"), ("unit", "their unit, likewise"), ("format", "their format, where it does not show"),
                          ("component", "of files that hold several; E,N of two")):
        parser.add_argument(f"--record-{name}", metavar=name[0].upper(), help=meaning)
    parser.add_argument("--out", type=Path, required=True, metavar="OUT.AT2")
    parser.add_argument("--force", action="store_true", help="replace files that are there")
    options = parser.parse_args(given)
    if (options.north is None) != (options.azimuth is None and options.rotd is None):
        parser.error("two components go with --azimuth or --rotd, one component goes without")
    if options.record_component and options.record_component.count(",") > (options.north is not None):
        parser.error("--record-component names one component, or with two records E,N")
    if options.rotd and options.rotd[0] not in PERCENTILES:
        parser.error("--rotd takes 50 or 100")
    if options.out.suffix.upper() != ".AT2":
        parser.error("--out takes a name that ends with .AT2")
    for name in ("dt", "pga", "scale", "taper"):
        if getattr(options, name) is not None and not getattr(options, name) > 0:
            parser.error(f"--{name} is above 0")
    return options


def target_of(path):
    """Periods (s) and Sa (m/s2) of a table."""
    with open(path, newline="", encoding="utf8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    try:
        periods, values = (np.array([float(row[head]) for row in rows]) for head in ("period (s)", "Sa (g)"))
    except (KeyError, TypeError, ValueError) as reason:
        raise peer.BadRecord(f"{path}: a spectrum has the columns period (s) and Sa (g), with numbers ({reason})") from reason
    if len(periods) < 2 or periods[0] <= 0 or np.any(np.diff(periods) <= 0) or np.any(values <= 0):
        raise peer.BadRecord(f"{path}: periods grow from above 0, of at least two, and Sa is above 0")
    return periods, peer.GRAVITY * values


def record_of(options):
    """The record in its direction, and its components (m/s2), if there are two."""
    given = [word for name in ("dt", "unit", "format") if (value := getattr(options, f"record_{name}")) for word in (f"--record-{name}", value)]
    parts = [["--record-component", part] if part else [] for part in (options.record_component or ",").split(",")]
    title, east, dt = peer.acceleration(options.east, given + parts[0])
    name = os.path.basename(options.east)
    if options.north is None:
        return motion_steps.Motion(east, dt, done=(f"of {name}, {title}",)), None
    _, north, other = peer.acceleration(options.north, given + parts[-1])
    if dt != other or east.size != north.size:
        raise peer.BadRecord(f"the records differ: {east.size} values of {dt} s and {north.size} of {other} s")
    azimuth, words = options.azimuth, f"of {name} as east and {os.path.basename(options.north)} as north, {title}"
    if options.rotd:
        azimuth = motion_steps.rotd_azimuth(east, north, dt, *options.rotd)
    record = motion_steps.Motion(motion_steps.along(east, north, azimuth), dt, done=(words,))
    turned = f"azimuth {azimuth:g} degrees" + (f", where Sa({options.rotd[1]:g} s) is RotD{options.rotd[0]:g}" if options.rotd else "")
    return record.then(turned), (east, north)


def make(options):
    """The record, cut; what was made of it; the components of the record; and the target spectrum."""
    motion, components = record_of(options)
    target = target_of(options.match) if options.match else None
    if options.begin or options.end is not None:
        motion = motion_steps.cut(motion, options.begin, options.end)
    record = motion
    if options.dt:
        motion = motion_steps.resampled(motion, options.dt)
    if options.band:
        motion = motion_steps.filtered(motion, *options.band)
    if options.baseline:
        motion = motion_steps.straightened(motion, options.baseline)
    if options.taper:
        motion = motion_steps.tapered(motion, options.taper)
    if options.column:
        motion = motion_steps.moved(motion, soil_column.read(options.column), options.recorded, options.wanted)
    if target:
        motion = motion_steps.matched(motion, *target)
    if any(value is not None for value in (options.scale, options.pga, options.sa)):
        motion = motion_steps.scaled(motion, options.scale, options.pga, options.sa)
    return record, motion, components, target


def spectra(record, motion, components, target):
    """Columns of a table (head, values): periods, Sa of record and motion, RotD50 and RotD100 of two components, the target (g)."""
    periods = spectrum.default_periods(100)
    periods = periods[periods >= 4 * max(record.dt, motion.dt)]
    columns = [("period (s)", periods)]
    for name, part in (("record", record), ("motion", motion)):
        columns.append((f"Sa of the {name} (g)", spectrum.pseudo_acceleration(part.acceleration, part.dt, periods) / peer.GRAVITY))
    if components:
        found = np.percentile(motion_steps.rotated_spectra(*components, record.dt, periods), PERCENTILES, axis=1) / peer.GRAVITY
        columns += [(f"RotD{percentile} of the record (g)", values) for percentile, values in zip(PERCENTILES, found)]
    if target:
        wanted = np.exp(np.interp(np.log(periods), np.log(target[0]), np.log(target[1] / peer.GRAVITY), np.nan, np.nan))
        columns.append(("target (g)", wanted))
    return columns


def table(done, columns):
    """Columns as CSV, below lines that tell what was done."""
    lines = [f"# {words}" for words in done] + [",".join(head for head, _ in columns)]
    lines += [",".join("" if np.isnan(value) else f"{value:.8g}" for value in row) for row in zip(*(values for _, values in columns))]
    return "\n".join(lines) + "\n"


def told(name, motion):
    """The measures of a motion, in a line."""
    velocity = spectrum.integral(motion.acceleration, motion.dt)
    moved = spectrum.integral(velocity, motion.dt)
    found = spectrum.intensity_measures(motion.acceleration, velocity, motion.dt)
    return (f"{name}: {len(velocity)} values every {motion.dt:g} s, PGA {found['pga'] / peer.GRAVITY:.3g} g at {found['pga_time']:.2f} s, PGV "
            f"{found['pgv']:.3g} m/s, PGD {np.abs(moved).max():.3g} m, Arias {found['arias']:.3g} m/s, D5-95 {found['d5_95']:.1f} s, at the end "
            f"{velocity[-1]:.1e} m/s and {moved[-1]:.1e} m")


def write(options, record, motion, columns):
    """All four files."""
    options.out.parent.mkdir(parents=True, exist_ok=True)
    series = [("time (s)", motion.dt * np.arange(len(motion.acceleration))), ("acceleration (m/s2)", motion.acceleration)]
    for path, columns_of in ((options.out.with_suffix(".csv"), series), (spectrum_path(options.out), columns)):
        write_whole(path, table(motion.done, columns_of))
    head = ["seismpm motion, " + motion.done[0], "; ".join(motion.done[1:]) or "as recorded", "ACCELERATION TIME SERIES IN UNITS OF G"]
    head = [line.encode("ascii", "replace").decode() for line in head]
    peer.write(str(options.out), head, motion.acceleration / peer.GRAVITY, motion.dt)
    draw(record, motion, columns, options.out.with_suffix(".png"))


def spectrum_path(out):
    """Where the spectra go."""
    return out.with_name(out.stem + "-spectrum.csv")


def main():
    """Makes and writes the motion, tells its measures; returns the exit code."""
    options = parse_arguments(sys.argv[1:])
    files = [options.out, options.out.with_suffix(".csv"), spectrum_path(options.out), options.out.with_suffix(".png")]
    there = [path for path in files if path.exists()]
    if there and not options.force:
        print(f"motion: {there[0]}: is there already; give another --out, or --force to replace it", file=sys.stderr)
        return 73
    try:
        record, motion, components, target = make(options)
        write(options, record, motion, spectra(record, motion, components, target))
    except (peer.BadRecord, soil_column.BadColumn, UnicodeDecodeError) as reason:
        print(f"motion: {reason}", file=sys.stderr)
        return 65
    except OSError as reason:
        print(f"motion: {reason}", file=sys.stderr)
        return 66 if isinstance(reason, FileNotFoundError) else 74
    print(*motion.done, told("before", record), told("after ", motion), sep="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
