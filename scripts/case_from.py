"""Makes a case from a drawing of the section: DXF, tables of points, a ground profile, a picture; materials by the names of the layers.

    scripts/case-from SECTION.dxf --materials MATERIALS.yaml --bottom -10 --out DIR
    scripts/case-from clay=GROUND.csv rock=ROCKHEAD.csv --like CASE.yaml --bottom -10 --out DIR
    scripts/case-from clay=PROFILE.txt --rock rock --depth 15 --like CASE.yaml --bottom -30 --level 20 --out DIR
    scripts/case-from SECTION.png --pixel 0.1 --colour clay=#c08040 --colour rock=#808080 --materials MATERIALS.yaml --out DIR

An open line on a layer is the upper boundary of the material of that name, from side to side or to where it ends on another
line, which it follows from there; a closed outline is all of a material, and goes before lines. Tables have the columns x, y and
perhaps the material; without that their material is NAME, or the name of the file. Lengths of the options are in m. Writes
DIR/case.yaml, surfaces of many points as DIR/NAME.csv, and DIR/section.png: the section as mpm-static sees it.
"""
import argparse
import difflib
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

import case_text
import drawing
import raster
import section
from named_materials import known_materials, material_of
from options import Parser
from plot_common import text
from programs import PROGRAMS
from resolved_case import Refused, first_state, number_and_unit, options_of, program, resolve, setting
from settings import UNITS as SI
from whole_file import write_whole

PICTURE = "section.png"
RASTERS = (".png", ".jpg", ".jpeg", ".gif", ".bmp", ".tif", ".tiff", ".webp")
TALL, TALLEST, LOW, LOWEST = 1000.0, 5000.0, 1.0, 0.1  # m: sections that are warned of, and refused


def pair(count, kind):
    """A reader of so many numbers, with commas between."""
    def read(words):
        values = tuple(float(word) for word in words.split(","))
        if len(values) not in count or not np.isfinite(values).all():
            raise argparse.ArgumentTypeError(f"'{words}' is not {kind}")
        return values
    return read


def axes(words):
    """Numbers and signs of the coordinates that become x and y."""
    parts = [word.strip() for word in words.split(",")]
    names = [part.lstrip("-") for part in parts]
    if len(parts) != 2 or names[0] == names[1] or not set(names) <= set("xyz"):
        raise argparse.ArgumentTypeError(f"'{words}' names no two axes, such as x,z")
    return tuple(("xyz".index(name), -1.0 if part.startswith("-") else 1.0) for name, part in zip(names, parts))


def colour(words):
    """Red, green and blue of #rrggbb."""
    if not re.fullmatch(r"#[0-9a-fA-F]{6}", words):
        raise argparse.ArgumentTypeError(f"'{words}' is no colour, such as #c08040")
    return tuple(bytes.fromhex(words[1:]))


def parse_arguments(given=None):
    """The command line."""
    parser = Parser(prog="case-from", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("drawings", nargs="+", metavar="[NAME=]FILE", help="DXF, tables of x and y, or a picture")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR")
    parser.add_argument("--force", action="store_true", help="replace files that are there")
    names = parser.add_argument_group("materials")
    names.add_argument("--materials", type=Path, metavar="FILE", help="YAML of materials, as in a case")
    names.add_argument("--like", type=Path, metavar="CASE", help="a case whose materials, motion and settings are taken")
    names.add_argument("--layer", action="append", default=[], metavar="LAYER=MATERIAL", help="the material of a layer of another name")
    names.add_argument("--ignore", action="append", default=[], metavar="LAYER", help="a layer that draws no ground")
    names.add_argument("--colour", action="append", default=[], metavar="MATERIAL=#RRGGBB", help="the material of a colour of a picture")
    names.add_argument("--air", type=colour, default="#ffffff", metavar="#RRGGBB", help="the colour of no ground; default: white")
    place = parser.add_argument_group("coordinates")
    place.add_argument("--pixel", type=float, metavar="P", help="width and height of a pixel of a picture")
    place.add_argument("--units", default="", choices=drawing.UNITS, metavar="UNIT", help="of the drawing: " + ", ".join(drawing.UNITS))
    place.add_argument("--axes", type=axes, default=axes("x,y"), metavar="A,B", help="what becomes x and y: x,z, or --axes=-x,y for a mirror image")
    place.add_argument("--scale", type=pair((1, 2), "one factor, or one of x and one of y"), default=(1.0,), metavar="F[,FY]", help="factors on x and y")
    place.add_argument("--shift", type=pair((2,), "two lengths"), default=(0.0, 0.0), metavar="DX,DY", help="is added then")
    place.add_argument("--tolerance", type=float, default=0.0, metavar="T", help="gaps that are closed, and how near curves are followed; default: width / 5000")
    ground = parser.add_argument_group("ground")
    ground.add_argument("--bottom", type=float, metavar="Y", help="height of the base; outlines that end level below need none")
    ground.add_argument("--rock", default="", metavar="MATERIAL", help="below all lines, from --depth or --rockhead down")
    ground.add_argument("--depth", type=float, metavar="D", help="of the rock below the ground, parallel to it")
    ground.add_argument("--rockhead", type=float, metavar="Y", help="height of the rock, level")
    ground.add_argument("--sides", type=pair((2,), "two lengths"), metavar="LEFT,RIGHT", help="where the model is cut, or goes on level to")
    ground.add_argument("--level", type=float, default=0.0, metavar="L", help="of level ground put to both sides of the drawing")
    ground.add_argument("--extend", action="append", default=[], metavar="LAYER", help="material whose line goes on level where it ends")
    model = parser.add_argument_group("model")
    model.add_argument("--cell", type=float, metavar="H", help="size of a cell; default: as the profile chooses")
    model.add_argument("--profile", default="standard", metavar="NAME", help="quick, standard (default), fine or paper: chooses the cell")
    model.add_argument("--gauge", action="append", default=[], metavar="NAME=X", help="a gauge on the ground")
    model.add_argument("--programs", type=Path, default=PROGRAMS, metavar="DIR", help="their folder; default: of the build, or installed")
    wish = parser.parse_args(given)
    wish.scale = wish.scale * 2 if len(wish.scale) == 1 else wish.scale
    for good, message in ((wish.materials or wish.like, "what is the ground made of? Give --materials FILE or --like CASE"),
                          (bool(wish.rock) == (wish.depth is not None or wish.rockhead is not None), "--rock goes with --depth or --rockhead"),
                          (wish.depth is None or wish.rockhead is None, "--depth and --rockhead both say where the rock lies: give one"),
                          (not (wish.sides and wish.level), "--sides and --level both say where the sides are: give one"),
                          (not wish.sides or wish.sides[0] < wish.sides[1], "--sides LEFT,RIGHT: the right one must be greater"),
                          (0 not in wish.scale, "--scale must not be 0"), (wish.level >= 0, "--level must not be negative"),
                          (wish.tolerance >= 0, "--tolerance must not be negative"), (wish.cell is None or wish.cell > 0, "--cell must be above 0"),
                          (wish.depth is None or wish.depth > 0, "--depth must be above 0"), (wish.pixel is None or wish.pixel > 0, "--pixel must be above 0")):
        if not good:
            parser.error(message)
    return wish


def files_named(wish):
    """(path, name) of the drawings; the name is that of NAME=FILE, else the file's."""
    found = []
    for word in wish.drawings:
        name, sign, file = word.partition("=")
        named = bool(sign) and not Path(word).exists()
        path = Path(file if named else word)
        if named and path.suffix.lower() == ".dxf":
            raise Refused(64, f"{word}: a DXF has materials by layer; rename one with --layer LAYER=MATERIAL")
        found.append((path, name if named else path.stem))
    return found


def read_curves(wish, materials, renamed, notes):
    """All curves, by material; refused where a layer is no material."""
    placing = drawing.Placing(wish.units, wish.axes, wish.scale, wish.shift, wish.tolerance)
    ignored = {name.casefold() for name in wish.ignore}
    curves = [curve for path, name in files_named(wish) for curve in drawing.read(path, name, placing, ignored, notes)]
    seen = {curve.name.casefold() for curve in curves}
    notes += [f"--layer {name}: no line is on such a layer" for name in renamed if name not in seen]
    unknown = {curve.name: curve for curve in reversed(curves) if material_of(curve.name, materials, renamed) is None}
    if unknown:
        lower = {known.casefold(): known for known in materials}
        like = {name: difflib.get_close_matches(renamed.get(name.casefold(), name).casefold(), lower, 1) for name in unknown}
        told = [f"{curve.where}: '{renamed.get(name.casefold(), name)}' is no material" + (f"; did you mean '{lower[like[name][0]]}'?" if like[name] else "")
                for name, curve in reversed(unknown.items())]
        raise Refused(65, "\n".join(told) + f"\nThere are: {', '.join(materials)}. Give --layer LAYER=MATERIAL, or --ignore LAYER where it draws no ground")
    for curve in curves:
        curve.name = material_of(curve.name, materials, renamed)
    return curves


def check_size(found):
    """Warnings of a section of an unlikely size; refused where it must be the units."""
    top, width = max(region.below.y.max() for region in found.regions), found.right - found.left
    height = top - found.bottom
    size = f"the section is {width:.4g} m wide and {height:.4g} m high"
    if height > TALLEST or height < LOWEST:
        raise Refused(65, f"{size}: in which units is it drawn? Give --units, or --scale")
    return [f"{size}; if that is wrong, give --units or --scale"] if height > TALL or height < LOW else []


def volumes(state):
    """Area (m2) of the particles of each material."""
    with h5py.File(state, "r") as file:
        volume = file["particles/volume"][...]
        found = {}
        for group in file["materials"].values():
            name = text(group.attrs["material"])
            found[name] = found.get(name, 0.0) + float(volume[int(group.attrs["begin"]):int(group.attrs["end"])].sum())
    return found


def gauges_of(wish, found):
    """{name: x} of --gauge."""
    gauges = {}
    for name, x in map(setting, wish.gauge):
        try:
            gauges[name] = float(x)
        except ValueError:
            raise Refused(64, f"--gauge {name}={x}: must be NAME=X, with x in m") from None
        if not found.left <= gauges[name] <= found.right:
            raise Refused(64, f"--gauge {name}={x}: lies beside the section, from x = {found.left:g} m to {found.right:g} m")
    return gauges


def refuse_to_replace(wish, names):
    """Refuses to write over files that are there, unless that is asked for."""
    there = [name for name in names if (wish.out / name).exists()]
    if there and not wish.force:
        raise Refused(73, f"{wish.out / there[0]}: is there already; give another --out, or --force to replace it")


def section_of_picture(path, wish, materials, notes):
    """The section of a picture in colours."""
    if len(wish.drawings) > 1 or wish.rock or wish.extend or wish.axes != axes("x,y") or wish.units:
        raise Refused(64, f"{path}: a picture stands alone, and takes no --rock, --extend, --axes or --units")
    if not wish.colour or not wish.pixel:
        raise Refused(64, f"{path}: a picture wants --pixel P, in m, and a --colour MATERIAL=#rrggbb for each material; its colours are {raster.colours_of(path)}")
    legend = {}
    for name, value in map(setting, wish.colour):
        if (material := material_of(name, materials, {})) is None:
            raise Refused(64, f"--colour {name}: there is no such material; there are: {', '.join(materials)}")
        try:
            legend[material] = colour(value)
        except argparse.ArgumentTypeError as reason:
            raise Refused(64, f"--colour {name}: {reason}") from None
    return raster.build(path, legend, wish, notes)


def section_of(wish, materials, notes):
    """The section of the command line."""
    pictures = [path for path, _ in files_named(wish) if path.suffix.lower() in RASTERS]
    if pictures:
        found = section_of_picture(pictures[0], wish, materials, notes)
        notes += check_size(found)
        return found
    if wish.colour or wish.pixel:
        raise Refused(64, f"--colour and --pixel go with a picture: {', '.join(RASTERS)}")
    renamed = {key.casefold(): value for key, value in map(setting, wish.layer)}
    curves = read_curves(wish, materials, renamed, notes)
    if wish.rock:
        wish.rock, given = material_of(wish.rock, materials, {}), wish.rock
        if wish.rock is None:
            raise Refused(64, f"--rock {given}: there is no such material; there are: {', '.join(materials)}")
    wish.extend = [material_of(name, materials, renamed) or name for name in wish.extend]
    found = section.build(curves, wish)
    notes += found.notes + check_size(found)
    return found


def make(wish, notes):
    """Writes the case of the command line, and draws it, once mpm-static has nothing against it."""
    refuse_to_replace(wish, ("case.yaml", PICTURE))
    materials, like = known_materials(wish)
    found = section_of(wish, materials, notes)
    gauges = gauges_of(wish, found)
    used = {name: materials[name] for name in dict.fromkeys(region.material for region in found.regions)}
    origin = [f"from {', '.join(dict.fromkeys(path.name for path, _ in files_named(wish)))}, gaps closed and curves followed within {found.tolerance:.3g} m"]
    wish.out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=f".{wish.out.name}-", dir=wish.out.parent) as folder:  # as deep as the case: its records are found alike
        case = Path(folder) / "case.yaml"
        files = lambda spacing: case_text.files_of(wish.out.resolve().name, found, used, like, spacing, gauges, origin)
        try:
            write(files(wish.cell), case.parent)
            number, unit = number_and_unit(resolve(wish.programs, case, options_of("" if wish.cell else wish.profile, {}))["grid"]["spacing"])
            content = files(number * SI[unit])
            write(content, case.parent)
            checked = subprocess.run([program(wish.programs, "mpm-static"), case, "--check"], capture_output=True, text=True, check=False)
            if checked.returncode:
                raise Refused(checked.returncode, checked.stderr.strip())
            state = first_state(wish.programs, case, resolve(wish.programs, case), (), case.parent / "state" / "first")
        except Refused as reason:
            raise Refused(reason.code, str(reason).replace(f"{folder}/", "")) from None
        notes += [line.replace(f"{folder}/", "")[9:] for line in checked.stderr.splitlines() if line.startswith("warning: ")]
        refuse_to_replace(wish, content)
        wish.out.mkdir(exist_ok=True)
        write(content, wish.out)
        for name in content:
            print(wish.out / name)
        case_text.draw(state, found, gauges, wish.out / PICTURE, wish.out.resolve().name)
        tell_areas(found, volumes(state))


def write(files, folder):
    """Writes files, each whole."""
    for name, content in files.items():
        write_whole(folder / name, content)


def tell_areas(found, seen):
    """Prints the area of each material as it is drawn, and of its particles."""
    print(f"{'material':20}{'drawn':>14}{'particles':>14}")
    for name, area in seen.items():
        print(f"{name:20}{sum(region.area for region in found.regions if region.material == name):11.2f} m2{area:11.2f} m2")


def main():
    """Makes the case; returns the exit code."""
    wish, notes = parse_arguments(), []
    try:
        make(wish, notes)
        code = 0
    except Refused as reason:
        print("\n".join(f"case-from: {line}" for line in str(reason).splitlines()), file=sys.stderr)
        code = reason.code
    except OSError as reason:
        print(f"case-from: {reason}", file=sys.stderr)
        code = 74
    for note in notes:
        print(f"case-from: warning: {note}", file=sys.stderr)
    return code


if __name__ == "__main__":
    sys.exit(main())
