"""Checks the ground that scripts/case-from makes of drawings against closed forms, and what it refuses; prints 'N passed, N failed'.

    check_case_from.py [PROGRAMS]
"""
import contextlib
import io
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib.image
import numpy as np
import yaml
from PIL import Image, ImageDraw

ROOT = Path(__file__).resolve().parent.parent.parent
PROGRAMS = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else ROOT / "build"
os.environ["SEISMPM_PROGRAMS"] = str(PROGRAMS)
sys.path.insert(0, str(ROOT / "scripts"))
import case_from
import named_materials
from checking import report
from plot_common import AREAS
from resolved_case import Refused
from stages import settings_of

try:
    import ezdxf
except ImportError:
    ezdxf = None

MATERIALS = """
rock: {model: elastic, density: 2200 kg/m3, young_modulus: 250 MPa, poisson_ratio: 0.25}
clay: {model: von_mises, density: 1800 kg/m3, young_modulus: 40 MPa, poisson_ratio: 0.35, strength: {peak: 120 kPa}}
Weak Clay: {model: von_mises, density: 1800 kg/m3, young_modulus: 20 MPa, poisson_ratio: 0.35, strength: {peak: 90 kPa}}
fill: {model: elastic, density: 1900 kg/m3, young_modulus: 60 MPa, poisson_ratio: 0.3}
"""
GROUND, ROCK = [(0, 18), (35, 18), (55, 8), (90, 8)], [(0, 4), (90, 4)]  # m
CLAY_AREA = 35 * 14 + 20 * 9 + 35 * 4  # m2, between the two


def drawing(path, *entities, units=6, prepare=None):
    """Writes a DXF: entities (layer, kind, arguments, attributes), kind being the method of ezdxf that adds it."""
    document = ezdxf.new("R2010")
    document.header["$INSUNITS"] = units
    for layer, kind, arguments, named in entities:
        getattr(document.modelspace(), f"add_{kind}")(*arguments, **named, dxfattribs={"layer": layer})
    if prepare:
        prepare(document)
    document.saveas(path)
    return path


def line(layer, points, closed=False, factor=1.0):
    """An entity of `drawing`: a polyline."""
    return layer, "lwpolyline", ([(x * factor, y * factor) for x, y in points],), {"close": closed}


def table(path, text):
    """Writes a table."""
    path.write_text(text)
    return path


def rows(points, mark=",", name=""):
    """Rows of a table."""
    return "".join(mark.join([f"{x:g}", f"{y:g}", *([name] if name else [])]) + "\n" for x, y in points)


def built(folder, *words):
    """(section, notes) of a command line; areas by material are `areas` of it. Starts no program."""
    wish, notes = case_from.parse_arguments([*map(str, words), "--materials", str(folder / "materials.yaml"), "--out", str(folder / "none")]), []
    materials, _ = named_materials.known_materials(wish)
    found = case_from.section_of(wish, materials, notes)
    found.areas = {}
    for region in found.regions:
        found.areas[region.material] = found.areas.get(region.material, 0.0) + region.area
    return found, notes


def off(found, **areas):
    """Greatest relative error of areas (m2); a material that is there and should not be, or not, is one."""
    if set(found.areas) != {name.replace("_", " ") for name in areas}:
        print(found.areas)
        return np.inf
    return max(abs(found.areas[name.replace("_", " ")] / area - 1) for name, area in areas.items())


def lines_of_dxf(folder):
    """Polylines, and lines in pieces and backwards, in mm: areas of the trapezia, to rounding."""
    pieces = [("ROCK", "line", ((90000, 4000), (40000, 4000)), {}), ("ROCK", "line", ((0, 4000), (40000, 4000)), {})]
    path = drawing(folder / "lines.dxf", line("CLAY", GROUND[::-1], factor=1000), *pieces, units=4)
    found, notes = built(folder, path, "--bottom", 0)
    return off(found, clay=CLAY_AREA, rock=360.0) + len(notes), 1e-9


def arcs(folder):
    """A bulge, an arc, an ellipse and a spline: areas of segments of a circle and a parabola, within twice width x tolerance."""
    path = drawing(folder / "arcs.dxf", ("clay", "lwpolyline", ([(0, 10, 0), (40, 10, -1), (60, 10, 0), (100, 10, 0)],), {"format": "xyb"}),
                   ("rock", "line", ((0, 4), (30, 4)), {}), ("rock", "ellipse", ((50, 4), (20, 0), 0.1, 0, np.pi), {}), ("rock", "line", ((70, 4), (100, 4)), {}),
                   ("fill", "open_spline", ([(0, 20, 0), (50, 40, 0), (100, 20, 0)], 2), {}))
    found, _ = built(folder, path, "--bottom", 0, "--tolerance", 0.01)
    rock, clay, fill = 400 + np.pi * 20 * 2 / 2, 1000 + np.pi * 10**2 / 2, 100 * (20 + 2 / 3 * 10)
    return max(abs(found.areas["rock"] - rock), abs(found.areas["clay"] - (clay - rock)), abs(found.areas["fill"] - (fill - clay))), 2 * 100 * 0.01


def outlines(folder):
    """Closed outlines side by side with a vertical face, and one within another: areas to rounding, no hollow at a gap of 1 mm."""
    left, right = [(0, 0), (35, 0), (35, 18), (0, 18)], [(35.001, 0), (90, 0), (90, 8), (35, 8)]
    lens = [(10, 5), (20, 5), (18, 7), (12, 7)]
    path = drawing(folder / "outlines.dxf", line("clay", left, True), line("rock", right[::-1], True), line("WEAK CLAY", lens, True),
                   ("fill", "circle", ((60, 4), 3), {}))
    found, _ = built(folder, path)
    first = [region.material for region in found.regions].index("Weak Clay")
    host = [region.material for region in found.regions].index("clay")
    if found.bottom != 0 or first > host:
        return np.inf, 0
    circle = found.areas["fill"]
    if abs(circle - np.pi * 9) > 2 * np.pi * 3 * found.tolerance:
        return np.inf, 0
    return off(found, clay=35 * 18 - 16.0, rock=55 * 8 - circle, Weak_Clay=16.0, fill=circle), 1e-5


def ends(folder):
    """Lines that end on others: a fill on the slope, a clay that comes to the surface, a lens of clay between rock and clay above."""
    path = drawing(folder / "ends.dxf", line("fill", [(40, 15.5), (45, 17), (50, 10.5)]), line("clay", GROUND), line("rock", [(0, 4), (60, 4), (70, 8)]),
                   line("Weak Clay", [(5, 4), (15, 6), (25, 4)]))
    found, _ = built(folder, path, "--bottom", 0)
    fill = 0.5 * abs((45 - 40) * (10.5 - 15.5) - (50 - 40) * (17 - 15.5))
    rock = 60 * 4 + 10 * 6 + 20 * 8
    return off(found, fill=fill, rock=rock, Weak_Clay=20.0, clay=CLAY_AREA + 360 - rock - 20.0), 1e-6


def coordinates(folder):
    """Units, axes, mirror image, scale and shift: corners of the ground where they belong, m."""
    feet = drawing(folder / "feet.dxf", line("clay", [(0, 60), (100, 60), (200, 30), (300, 30)]), units=2)
    bare = drawing(folder / "bare.dxf", line("clay", [(0, 60), (100, 60), (200, 30), (300, 30)]), units=0)
    deep = drawing(folder / "deep.dxf", ("clay", "polyline3d", ([(0, 7, 60), (100, 7, 60), (200, 7, 30), (300, 7, 30)],), {}))
    worst = 0.0
    for words, x, y in (((feet,), (0, 30.48, 60.96, 91.44), (18.288, 9.144)), ((bare, "--units", "cm"), (0, 1, 2, 3), (0.6, 0.3)),
                        ((feet, "--units", "m"), (0, 100, 200, 300), (60, 30)), ((deep, "--axes", "x,z"), (0, 100, 200, 300), (60, 30)),
                        ((deep, "--axes=-x,z", "--shift", "300,-20"), (0, 100, 200, 300), (10, 40)),
                        ((deep, "--axes", "x,z", "--scale", "0.1,0.2"), (0, 10, 20, 30), (12, 6))):
        found, _ = built(folder, *words, "--bottom", -40)
        ground = found.regions[0].below
        worst = max(worst, abs(ground.x - x).max(), abs(ground.height(np.array(x)[[0, 3]]) - y).max()) if len(ground.x) == 4 else np.inf
    return worst, 1e-3


def tables(folder):
    """The same section as tables: a file each, named columns, marks, units of a heading, without a heading."""
    table(folder / "ground.csv", "x (m),y (m)\n" + rows(GROUND))
    table(folder / "rock.txt", "# rockhead\n" + rows(ROCK, " "))
    table(folder / "both.tsv", "material\televation\tstation\n" + "".join(f"{name}\t{y}\t{x}\n" for name, points in (("clay", GROUND), ("Rock", ROCK)) for x, y in points))
    table(folder / "feet.csv", "x (ft); y (ft); layer\n" + rows([(x / 0.3048, y / 0.3048) for x, y in GROUND], ";", "clay").replace("e+", "e") + rows([(x / 0.3048, y / 0.3048) for x, y in ROCK], ";", "rock"))
    table(folder / "closed.csv", rows([(0, 4), (90, 4), *GROUND[::-1], (0, 4)], name="clay") + rows([(0, 0), (90, 0), (90, 4), (0, 4), (0, 0)], name="rock"))
    found = [built(folder, *words)[0] for words in ((f"clay={folder}/ground.csv", folder / "rock.txt", "--bottom", 0), (folder / "both.tsv", "--bottom", 0),
                                                     (folder / "feet.csv", "--bottom", 0), (folder / "closed.csv",))]
    return max(off(one, clay=CLAY_AREA, rock=360.0) for one in found), 1e-5


def profile(folder):
    """A ground profile alone, with rock at a depth or a height, level ground at the sides, cut, in whole cells."""
    ground = f"clay={table(folder / 'profile.csv', rows(GROUND))}"
    deep, _ = built(folder, ground, "--rock", "ROCK", "--depth", 5, "--bottom", -2, "--level", 10)
    flat, _ = built(folder, ground, "--rock", "rock", "--rockhead", 4, "--bottom", 0, "--sides", "10,80")
    cells, notes = built(folder, ground, "--rock", "rock", "--rockhead", 4, "--bottom", 0, "--cell", 0.7)
    return max(off(deep, clay=110 * 5.0, rock=(45 * 15 + 20 * 10 + 45 * 5.0)), off(flat, clay=CLAY_AREA - 140 - 40, rock=280.0),
               off(cells, clay=CLAY_AREA + 0.3 * 4, rock=90.3 * 4), abs(deep.left + 10), abs(deep.right - 100), abs(cells.right - 90.3),
               float(not any("whole number of cells" in note for note in notes))), 1e-9


def refusals(folder):
    """What is wrong is refused with the place, the layer and the entity."""
    cases = [("loop", "LWPOLYLINE 2F: crosses itself at x = 50 m, y = 10 m", [line("clay", [(0, 10), (60, 10), (60, 20), (50, 20), (50, 5), (90, 5)])]),
             ("overhang", "LWPOLYLINE 2F: hangs over, or turns back, at x = 50 m, y = 15 m", [line("clay", [(0, 18), (50, 15), (45, 8), (90, 8)])]),
             ("overhanging outline", "LWPOLYLINE 2F: hangs over", [line("clay", [(0, 0), (90, 0), (90, 8), (45, 8), (50, 15), (0, 15)], True)]),
             ("short line", "LINE 30: ends at x = 60 m, y = 4 m, neither at a side", [line("clay", GROUND), ("rock", "line", ((0, 4), (60, 4)), {})]),
             ("gap", "ends at x = 40 m, y = 4 m", [line("clay", GROUND), ("rock", "line", ((0, 4), (40, 4)), {}), ("rock", "line", ((50, 4), (90, 4)), {})]),
             ("crossing layers", "LWPOLYLINE 2F: crosses", [line("clay", GROUND), line("rock", [(0, 4), (90, 12)])]),
             ("place of a crossing", "at x = 45 m, y = 8 m", [line("clay", [(0, 8), (90, 8)]), line("rock", [(0, 4), (90, 12)])]),
             ("one line twice", "is the same line as", [line("clay", GROUND), line("rock", GROUND)]),
             ("two upper boundaries", "a material has one upper boundary", [line("clay", GROUND), line("clay", [(0, 10), (90, 7)])]),
             ("unknown layer", "LWPOLYLINE 30: 'rok' is no material; did you mean 'rock'?", [line("clay", GROUND), line("rok", ROCK)]),
             ("list of materials", "There are: rock, clay, Weak Clay, fill", [line("XYZ", GROUND)]),
             ("overlap", "overlaps", [line("clay", [(0, 0), (50, 0), (50, 8), (0, 8)], True), line("rock", [(40, 0), (90, 0), (90, 8), (40, 8)], True)]),
             ("area of an overlap", "by 80 m2", [line("clay", [(0, 0), (50, 0), (50, 8), (0, 8)], True), line("rock", [(40, 0), (90, 0), (90, 8), (40, 8)], True)]),
             ("hollow", "a hollow 2 m high", [line("clay", [(0, 0), (90, 0), (90, 3), (0, 3)], True), line("rock", [(0, 5), (90, 5), (90, 8), (0, 8)], True)]),
             ("nothing below", "a hollow 4 m high", [line("clay", [(0, 0), (40, 4), (90, 4), (90, 8), (0, 8)], True)]),
             ("no ground", "there is no ground at x = 4", [line("clay", [(0, 0), (40, 0), (40, 8), (0, 8)], True), line("rock", [(50, 0), (90, 0), (90, 8), (50, 8)], True)]),
             ("below the base", "encloses no ground", [line("clay", GROUND), line("rock", [(0, -4), (90, -4)])]),
             ("side on", "choose the axes", [("clay", "polyline3d", ([(0, 7, 60), (100, 7, 60)],), {})]),
             ("only a block", "draws nothing", [("clay", "text", ("ground",), {})])]
    failed = 0
    for name, part, entities in cases:
        bottom = () if "closed" in name else ("--bottom", 0)
        failed += not refused(folder, 65, part, drawing(folder / "wrong.dxf", *entities), *bottom)
    failed += not refused(folder, 65, "LWPOLYLINE 2F: '5th' is no material", drawing(folder / "wrong.dxf", line("5th", GROUND)), "--bottom", 0)
    failed += not refused(folder, 64, "--bottom 5", drawing(folder / "wrong.dxf", line("clay", GROUND)))
    failed += not refused(folder, 64, "--extend fill: no open line", drawing(folder / "wrong.dxf", line("clay", GROUND)), "--bottom", 0, "--extend", "fill")
    failed += not refused(folder, 65, "give --units", drawing(folder / "wrong.dxf", line("clay", GROUND), units=0), "--bottom", 0)
    failed += not refused(folder, 65, "in which units is it drawn?", drawing(folder / "wrong.dxf", line("clay", GROUND), units=4), "--bottom", 0)
    failed += not refused(folder, 65, "in which units is it drawn?", drawing(folder / "wrong.dxf", line("clay", GROUND), units=7), "--bottom", 0)
    failed += not refused(folder, 65, "is no DXF", table(folder / "text.dxf", "0 0\n1 1\n"), "--bottom", 0)
    failed += not refused(folder, 66, "there is no such file", folder / "none.dxf", "--bottom", 0)
    return float(failed), 0


def refused(folder, code, part, *words):
    """Whether a command line is refused with the code, and with `part` in what is said."""
    try:
        built(folder, *words)
    except Refused as reason:
        if reason.code == code and part in str(reason):
            return True
        print(f"     {reason.code}: {reason}; expected {code}: {part}")
        return False
    except Exception as reason:  # a traceback is no refusal
        print(f"     {type(reason).__name__}: {reason}; expected {part}")
        return False
    print(f"     not refused: {part}")
    return False


def painted(path, *patches, lines=False, size=(180, 40), pixel=0.5):
    """Writes a picture of size x size (m): (colour, points in m), one over the other; smooth edges, and black lines around them if asked for."""
    fine = 4
    image = Image.new("RGB", tuple(round(fine * length / pixel) for length in size), "white")
    pen = ImageDraw.Draw(image)
    for colour, points in patches:
        pen.polygon([(x / pixel * fine, (size[1] - y) / pixel * fine) for x, y in points], fill=colour, outline="black" if lines else None, width=fine)
    image.resize((image.width // fine, image.height // fine), Image.LANCZOS).save(path)
    return path


def pictures(folder):
    """Pictures, with smooth edges and with black lines, a lens in the clay and a fill on it: areas within their outline times a pixel."""
    low = [(0, 0), (180, 0)]
    clay, rock = [*low, (180, 16), (110, 16), (70, 36), (0, 36)], [*low, (180, 8), (80, 8), (40, 4), (0, 4)]
    lens, fill = [(20, 16), (60, 16), (56, 24), (24, 25)], [(110, 16), (140, 16), (132, 20), (120, 21)]
    legend = [word for name, colour in (("clay", "#c08040"), ("ROCK", "#808080"), ("weak clay", "#40a060"), ("fill", "#f0d040")) for word in ("--colour", f"{name}={colour}")]
    area = {"rock": 180 * 4 + 40 * 2 + 100 * 4, "Weak Clay": shoelace(lens), "fill": shoelace(fill)}
    area["clay"] = shoelace(clay) - area["rock"] - area["Weak Clay"]
    outline = {"rock": 360, "Weak Clay": 85, "fill": 55, "clay": 900}  # m, about
    worst = 0.0
    for lines in (False, True):
        path = painted(folder / "picture.png", ("#c08040", clay), ("#808080", rock), ("#40a060", lens), ("#f0d040", fill), lines=lines)
        found, _ = built(folder, path, "--pixel", 0.5, *legend)
        if set(found.areas) != set(area) or found.bottom != 0:
            return np.inf, 0
        worst = max(worst, *(abs(found.areas[name] - area[name]) / (0.5 * outline[name]) for name in area))
    half, _ = built(folder, path, "--pixel", 0.5, *legend, "--scale", "2,1", "--shift=-100,10", "--bottom", 10)
    worst = max(worst, abs(half.left + 100), abs(half.right - 260), abs(half.areas["fill"] / found.areas["fill"] / 2 - 1))
    seam = [(60, 16), (90, 22), (98, 22), (62, 12)]  # comes to the surface on the slope, y = 16 + (110 - x) / 2
    cut, _ = built(folder, painted(folder / "seam.png", ("#c08040", clay), ("#40a060", seam)), "--pixel", 0.5, *legend[:2], *legend[4:6])
    worst = max(worst, abs(cut.areas["Weak Clay"] - shoelace(seam)) / (0.5 * 90), abs(sum(cut.areas.values()) - shoelace(clay)) / (0.5 * 400))
    over = [*low, (180, 16), (100, 16), (120, 36), (0, 36)]
    cave = painted(folder / "cave.png", ("#c08040", clay), ("#ffffff", [(20, 10), (50, 10), (50, 20), (20, 20)]))
    bad = [refused(folder, 65, "clay hangs over air", painted(folder / "over.png", ("#c08040", over)), "--pixel", 0.5, *legend), refused(folder, 65, "hangs over air", cave, "--pixel", 0.5, *legend),
           refused(folder, 65, "colours of no material, as #4040ff in row ", painted(folder / "blue.png", ("#c08040", clay), ("#4040ff", [(0, 4), (80, 4), (60, 36), (0, 36)])), "--pixel", 0.5, *legend),
           refused(folder, 65, "air in the ground at x = 109.25 m, y = 36 m", painted(folder / "float.png", ("#c08040", clay), ("#808080", [(80, 36), (110, 36), (110, 38), (80, 38)])), "--pixel", 0.5, *legend),
           refused(folder, 65, "above the base", painted(folder / "up.png", ("#c08040", [(x, y + 3 * (x < 90)) for x, y in clay])), "--pixel", 0.5, *legend),
           refused(folder, 64, "its colours are #c08040", path, "--pixel", 0.5), refused(folder, 64, "wants --pixel", path, *legend), refused(folder, 64, "--colour sand: there is no", path, "--pixel", 1, "--colour", "sand=#000000"),
           refused(folder, 64, "stands alone", path, "--pixel", 0.5, *legend, "--rock", "rock", "--depth", 3), refused(folder, 65, "cannot be read", table(folder / "no.png", "x"), "--pixel", 1, *legend),
           refused(folder, 64, "go with a picture", folder / "ground.csv", "--pixel", 1)]
    return worst + bad.count(False), 1


def shoelace(points):
    """Area of a polygon."""
    x, y = np.array(points, dtype=float).T
    return abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def refused_tables(folder):
    """Tables and options that are wrong are refused with line or option."""
    failed, good = 0, f"clay={table(folder / 'good.csv', rows(GROUND))}"
    for name, text, part in (("numbers", "0,18\n35,abc\n", "clay.csv, line 2: must be two numbers"), ("commas", "0;18,5\n35;17,5\n", "with decimal points"),
                             ("depth", "x,depth\n0,1\n1,1\n", "has depths"), ("heading", "a,b\n0,1\n1,1\n", "names no x and y"),
                             ("unit", "x (ell),y (ell)\n0,1\n1,1\n", "states the units ell"), ("one point", "0,1\n", "has no two points"),
                             ("nan", "0,1\n1,nan\n", "line 2: must be two numbers"), ("short", "0\n1\n", "line 1: must be two numbers")):
        failed += not refused(folder, 65, part, table(folder / "clay.csv", text), "--bottom", -5)
    for code, part, words in ((65, "is a DWG", (table(folder / "a.dwg", ""),)), (66, "cannot be read", (folder / "none.csv",)),
                              (64, "a DXF has materials by layer", (f"clay={folder}/a.dxf",)), (65, "'stone' is no material", (f"stone={folder}/good.csv",)),
                              (65, "crosses", (good, "--rock", "rock", "--rockhead", 12)), (65, "drawn, and is to lie", (good, "--rock", "clay", "--depth", 2)),
                              (65, "more than the 20000", (f"clay={table(folder / 'many.csv', ''.join(f'{k},5' + chr(10) for k in range(20_001)))}",))):
        failed += not refused(folder, code, part, *words, "--bottom", 0)
    for part, words in (("--rock goes with", ("--rock", "rock")), ("give one", ("--rock", "rock", "--depth", 3, "--rockhead", 4)), ("--sides", ("--sides", "3,2")),
                        ("give one", ("--sides", "0,9", "--level", 3)), ("names no two axes", ("--axes", "x,x")), ("did you mean '--depth'", ("--dept", 3)),
                        ("invalid choice: 'ell'", ("--units", "ell")), ("is not two lengths", ("--sides", "3"))):
        code, said = spoken(folder, good, *words)
        failed += code != 64 or part not in said
    return float(failed), 0


def spoken(folder, *words, out="none", materials=True):
    """Exit code of the command in this process, and all that it says."""
    sys.argv, said = ["case-from", *map(str, words), "--out", str(folder / out), *(["--materials", str(folder / "materials.yaml")] if materials else [])], io.StringIO()
    with contextlib.redirect_stderr(said), contextlib.redirect_stdout(said):
        try:
            return case_from.main(), said.getvalue()
        except SystemExit as end:
            return end.code, said.getvalue()


def warnings(folder):
    """What a drawing holds and is not used is named: texts, blocks, hidden layers, paper space, the third coordinate, a vertical face, a size."""
    def more(document):
        document.blocks.new("TREE")
        document.modelspace().add_blockref("TREE", (3, 3), dxfattribs={"layer": "plants"})
        document.layers.add("old").off()
        document.modelspace().add_line((0, 1), (90, 1), dxfattribs={"layer": "old"})
        document.layout("Layout1").add_text("title")
        document.modelspace().add_lwpolyline([(5, 5), (5, 5)], dxfattribs={"layer": "clay"})
    path = drawing(folder / "busy.dxf", ("clay", "polyline3d", ([(0, 18, 0), (35, 18, 3), (35, 8, 4), (90, 8, 0)],), {}), ("notes", "text", ("hello",), {}),
                   ("frame", "line", ((0, 0), (90, 0)), {}), prepare=more)
    _, notes = built(folder, path, "--bottom", -1100, "--ignore", "FRAME", "--layer", "sand=clay")
    wanted = ("layer notes: TEXT", "block TREE", "layer old, which is off or frozen: LINE", "layout Layout1: 1 entities", "z runs from 0 to 4 and is not used",
              "is but a point", "vertical at x = 35 m, from y = 18 m to 8 m", "1118 m high", "--layer sand: no line")
    missing = [part for part in wanted if not any(part in note for note in notes)]
    print(*(f"     no warning: {part}" for part in missing), sep="\n", end="\n" if missing else "")
    return float(len(missing)), 0


def whole(folder):
    """The case is one that mpm-static takes and settles, its particles have the areas that are drawn to 1 %, and so has the picture to 3 %."""
    source = table(folder / "whole.csv", rows(GROUND, name="clay") + rows([(0, 4), (30, 4), (90, 5)], name="rock"))
    words = (source, "--bottom", 0, "--cell", 2, "--gauge", "crest=35", "--gauge", "toe=55")
    code, said = spoken(folder, *words, out="made")
    if code:
        print(said)
        return np.inf, 0
    again, why = spoken(folder, *words, out="made")
    forced, _ = spoken(folder, *words, "--force", out="made")
    case = yaml.safe_load((folder / "made" / "case.yaml").read_text())
    run = subprocess.run([PROGRAMS / "mpm-static", folder / "made" / "case.yaml", "--out", folder / "static", "--quiet", "--threads", "1"], capture_output=True, text=True, check=False)
    areas = {line.split()[0]: [float(word) for word in line.split() if word[0].isdigit() and word != "m2"] for line in said.splitlines() if line.endswith(" m2")}
    picture = matplotlib.image.imread(folder / "made" / "section.png")[..., :3]
    seen = [(abs(picture - matplotlib.colors.to_rgb(colour)).max(axis=2) < 0.02).sum() for colour in AREAS[:2]]  # rock is the first region
    exact = {"clay": CLAY_AREA - 30.0, "rock": 390.0}
    wrong = [again != 73, "is there already" not in why, forced != 0, run.returncode != 0, case["output"]["gauges"]["points"] != {"crest": ["35 m", "18 m"], "toe": ["55 m", "8 m"]},
             *(abs(areas[name][0] - area) > 0.01 for name, area in exact.items()), *(abs(areas[name][1] / area - 1) > 0.01 for name, area in exact.items()),
             abs(seen[0] / seen[1] / (exact["rock"] / exact["clay"]) - 1) > 0.03, len(list(folder.glob(".*"))) > 0]
    if any(wrong):
        print(wrong, said, why, run.stderr, areas, seen)
    return float(sum(wrong)), 0


def refused_by_program(folder):
    """What only mpm-static refuses is told with its code, and leaves nothing behind; a gauge and a missing program are refused before."""
    slope = f"clay={table(folder / 'steep.csv', rows([(0, 30), (40, 5)]))}"
    code, said = spoken(folder, slope, "--bottom", 0, out="steep")
    gauge, why = spoken(folder, slope, "--bottom", 0, "--gauge", "far=200", out="steep")
    gone, what = spoken(folder, slope, "--bottom", 0, "--programs", folder, out="steep")
    wrong = [code != 65, "cuts a slope face" not in said, str(folder / ".steep") in said, (folder / "steep").exists(), gauge != 64, "far=200: lies beside" not in why,
             gone != 66, "mpm-static is missing" not in what]
    if any(wrong):
        print(wrong, said, why, what)
    return float(sum(wrong)), 0


def like(folder):
    """--like takes materials, motion and settings of a case to the new one as they are (but for what follows from the cells), its record from where that stands, and long surfaces to files."""
    (folder / "old").mkdir()
    (folder / "old" / "record.txt").write_text("".join(f"{0.01 * k:.2f} {np.sin(0.3 * k):.4f}\n" for k in range(200)))
    text = (ROOT / "cases" / "first" / "case.yaml").read_text().replace("horizontal: built_in", "horizontal: {file: record.txt, unit: m/s2}")
    (folder / "old" / "case.yaml").write_text(text.replace("{spacing: 1 m, ", "{softening: local, spacing: 1 m, "))
    x = np.linspace(0, 90, 61)
    source = table(folder / "long.csv", rows(zip(x, np.round(np.interp(x, *zip(*GROUND)) + 0.01 * np.sin(x), 3)), name="clay"))
    code, said = spoken(folder, source, "--rock", "rock", "--rockhead", 4, "--bottom", 0, "--cell", 2, "--like", folder / "old" / "case.yaml", out="sub/new", materials=False)
    if code:
        print(said)
        return np.inf, 0
    shown = [settings_of(subprocess.run([PROGRAMS / "mpm-seismic", case, "--print-case"], capture_output=True, text=True, check=False).stdout)
             for case in (folder / "old" / "case.yaml", folder / "sub" / "new" / "case.yaml")]
    keep = [{key: value for key, value in one.items() if key.split(".")[0] in ("materials", "static", "seismic", "time_step") and not key.endswith(("file", "spring", "band_width"))} for one in shown]
    record = folder / "sub" / "new" / shown[1]["seismic.motion.horizontal.file"]
    wrong = [keep[0] != keep[1], not keep[0], not record.samefile(folder / "old" / "record.txt"), shown[1]["grid.softening"] != "local",
             len((folder / "sub" / "new" / "ground.csv").read_text().splitlines()) < 50]
    if any(wrong):
        print(wrong, *keep, record)
    return float(sum(wrong)), 0


def checks():
    """Name and (error, tolerance) of every check."""
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        (folder / "materials.yaml").write_text(MATERIALS)
        for check in (lines_of_dxf, arcs, outlines, ends, coordinates, warnings, refusals):
            yield check.__doc__, check(folder) if ezdxf else "there is no ezdxf (apt-get install python3-ezdxf)"
        for check in (tables, profile, pictures, refused_tables, whole, refused_by_program, like):
            yield check.__doc__, check(folder)


if __name__ == "__main__":
    os.environ["OMP_NUM_THREADS"] = "1"
    sys.exit(report(checks()))
