"""Curves of a section from drawings: DXF by ezdxf, and tables of points; in m, x to the right and y up."""
import re
from collections import defaultdict
from dataclasses import dataclass

import numpy as np

from resolved_case import Refused

UNITS = {"m": 1.0, "mm": 0.001, "cm": 0.01, "dm": 0.1, "km": 1000.0, "in": 0.0254, "ft": 0.3048, "us-ft": 1200 / 3937, "yd": 0.9144, "mi": 1609.344}
INSUNITS = {1: "in", 2: "ft", 3: "mi", 4: "mm", 5: "cm", 6: "m", 7: "km", 10: "yd", 14: "dm", 21: "us-ft"}  # as DXF counts units
DRAWN = ("LINE", "LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE")
FINENESS = 5000  # of the width of a drawing: gaps as small are closed, curves run as near to their chords
MOST_POINTS = 20_000  # of all curves
FAR, UP = ("x", "distance", "station", "chainage"), ("y", "z", "elevation", "height", "level", "altitude")
NAMES = ("material", "layer", "name", "soil", "unit")


@dataclass
class Curve:
    """A curve as it is drawn."""

    name: str  # of its layer
    points: np.ndarray  # [n, 2] in m; the first of a closed one is not repeated
    closed: bool
    where: str  # for messages


@dataclass
class Placing:
    """How coordinates of a drawing become x and y in m."""

    units: str = ""  # a name of UNITS; empty: as the drawing says
    axes: tuple = ((0, 1.0), (1, 1.0))  # number and sign of the coordinates that become x and y
    scale: tuple = (1.0, 1.0)
    shift: tuple = (0.0, 0.0)  # m
    tolerance: float = 0.0  # m; 0: the width of the drawing over FINENESS

    def metre(self, stated, where, notes):
        """The unit of a drawing in m, from what it states and what was asked for."""
        if not self.units and not stated:
            raise Refused(65, f"{where}: does not say its units; give --units, one of {', '.join(UNITS)}")
        if self.units and stated and self.units != stated:
            notes.append(f"{where}: states {stated}, and is taken as {self.units}, as --units says")
        return UNITS[self.units or stated]

    def place(self, points, metre):
        """x, y (m) of points [n, 2 or 3] of a drawing."""
        return np.stack([sign * points[:, axis] * metre * scale + shift
                         for (axis, sign), scale, shift in zip(self.axes, self.scale, self.shift)], axis=1)


def at(x, y):
    """A place, for messages."""
    return f"x = {x:.6g} m, y = {y:.6g} m"


def some(handles):
    """The first few of a list, for messages."""
    return ", ".join(handles[:5]) + (", ..." if len(handles) > 5 else "")


def read_dxf(path, placing, ignored, notes):
    """The curves in the model space of a DXF; what is left out is told in `notes`. Names in `ignored` are casefolded."""
    try:
        import ezdxf
        from ezdxf import path as ezdxf_path, recover
    except ImportError:
        raise Refused(66, "ezdxf is missing, which reads DXF: apt-get install python3-ezdxf, or set PYTHON to a python3 that has it") from None
    if not path.is_file():
        raise Refused(66, f"{path}: there is no such file")
    try:
        document = ezdxf.readfile(path)
    except ezdxf.DXFError:
        try:
            document, audit = recover.readfile(path)
        except ezdxf.DXFError as reason:
            raise Refused(65, f"{path}: is a damaged DXF: {reason}") from None
        if audit.has_errors:
            raise Refused(65, f"{path}: is a damaged DXF: {audit.errors[0].message}; save it anew") from None
    except (OSError, UnicodeDecodeError) as reason:
        raise Refused(65, f"{path}: is no DXF: {reason}") from None
    stated = document.header.get("$INSUNITS", 0)
    if stated not in INSUNITS and stated and not placing.units:
        raise Refused(65, f"{path}: is drawn in units that DXF counts as {stated}; give --units, one of {', '.join(UNITS)}")
    metre = placing.metre(INSUNITS.get(stated, ""), path.name, notes)
    drawn, left_out = [], defaultdict(list)
    hidden = {layer.dxf.name.casefold() for layer in document.layers if layer.is_off() or layer.is_frozen()}
    for entity in document.modelspace():
        layer, kind, handle = entity.dxf.layer, entity.dxftype(), entity.dxf.handle
        if layer.casefold() in ignored:
            continue
        if layer.casefold() in hidden:
            left_out[f"layer {layer}, which is off or frozen"].append(f"{kind} {handle}")
        elif kind == "INSERT":
            left_out[f"layer {layer}: block {entity.dxf.name}; explode it where it draws ground"].append(f"{kind} {handle}")
        elif kind not in DRAWN or kind == "POLYLINE" and not (entity.is_2d_polyline or entity.is_3d_polyline):
            left_out[f"layer {layer}"].append(f"{kind} {handle}")
        else:
            drawn.append((layer, f"{path.name}, layer {layer}, {kind} {handle}", ezdxf_path.make_path(entity)))
    for layout in document.layouts:
        if layout.name != "Model" and (count := sum(entity.dxftype() != "VIEWPORT" for entity in layout)):
            left_out[f"layout {layout.name}"].append(f"{count} entities of paper space")
    notes += [f"{path.name}: not used: {what}: {some(handles)}" for what, handles in left_out.items()]
    return flattened(drawn, placing, metre, path.name, notes)


def flattened(drawn, placing, metre, where, notes):
    """Curves of (layer, where, path of ezdxf), as straight segments within the tolerance."""
    if not drawn:
        return []
    corners = np.array([vertex.xyz for _, _, path in drawn for vertex in path.control_vertices()])
    extent = np.ptp(corners, axis=0)
    used = [axis for axis, _ in placing.axes]
    unused = ({0, 1, 2} - set(used)).pop()
    if extent[used[1]] == 0 or extent[used[0]] == 0:
        raise Refused(65, f"{where}: has no extent in {'xyz'[used[extent[used[1]] == 0]]}; choose the axes of the section, as --axes x,z")
    if extent[unused] > max(extent[used]) / FINENESS:
        notes.append(f"{where}: {'xyz'[unused]} runs from {corners[:, unused].min():g} to {corners[:, unused].max():g} and is not used (--axes)")
    tolerance = placing.tolerance / (metre * max(map(abs, placing.scale))) or max(extent[used]) / FINENESS
    curves = []
    for layer, place, path in drawn:
        points = np.array([vertex.xyz for vertex in path.flattening(tolerance, segments=4)])
        if len(points) < 2 or np.ptp(points[:, used], axis=0).max() <= tolerance:
            notes.append(f"{place}: is but a point, and not used")
        else:
            curves.append(Curve(layer, placing.place(points, metre), False, place))
    return curves


def columns_of(words, where):
    """Indices of x, y and name (None: there is none) by the words of a heading, and the unit that it states."""
    names = [re.sub(r"[\W_]+.*", "", word.strip().casefold()) for word in words]
    if "depth" in names:
        raise Refused(65, f"{where}: has depths; write heights y, positive upwards")
    find = lambda wanted: next((k for k, name in enumerate(names) if name in wanted), None)
    x, y = find(FAR), find(UP)
    if x is None or y is None:
        raise Refused(65, f"{where}: the heading names no x and y: {', '.join(words)}")
    units = {found[1].casefold() for k in (x, y) if (found := re.search(r"[(\[]\s*([\w-]+)\s*[)\]]", words[k]))}
    if len(units) > 1 or not units <= set(UNITS):
        raise Refused(65, f"{where}: states the units {', '.join(sorted(units))}; known are {', '.join(UNITS)}, one for both columns")
    return (x, y, find(NAMES)), next(iter(units), "")


def read_table(path, name, placing, ignored, notes):
    """The curves of a table of x, y and, where it has a third column, the material; an empty row or another material begins a new curve."""
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as reason:
        raise Refused(66, f"{path}: cannot be read: {reason}") from None
    columns, stated, rows, pieces = None, "", [], []
    for number, line in enumerate(lines, 1):
        line = line.split("#")[0].strip()
        mark = next((mark for mark in "\t;," if mark in line), None)
        words = [word.strip().strip('"') for word in line.split(mark)] if line else []
        where = f"{path.name}, line {number}"
        if not words:
            rows.append(None)
        elif columns is None and any(re.match(r"[a-zA-Z]", word) for word in words[:2]):
            columns, stated = columns_of(words, where)
        else:
            columns = columns or (0, 1, 2)
            rows.append((number, *values_of(words, columns, where)))
    for row in rows:
        if row is None or not pieces or not pieces[-1] or row[3] != pieces[-1][-1][3]:
            pieces.append([])
        pieces[-1] += [row] if row else []
    metre, curves = placing.metre(stated or placing.units or "m", path.name, notes), []
    for piece in filter(None, pieces):
        layer = piece[0][3] or name
        if layer.casefold() in ignored:
            continue
        place = f"{path.name}, line {piece[0][0]}" + (f", {piece[0][3]}" if piece[0][3] else "")
        if len(piece) < 2:
            notes.append(f"{place}: is but a point, and not used")
        else:
            curves.append(Curve(layer, placing.place(np.array([row[1:3] for row in piece]), metre), False, place))
    return curves


def values_of(words, columns, where):
    """x, y and the name of a row, empty where it has none."""
    x, y, name = columns
    try:
        values = float(words[x]), float(words[y])
    except (ValueError, IndexError):
        values = np.nan, np.nan
    if not np.isfinite(values).all():
        raise Refused(65, f"{where}: must be two numbers x and y, with decimal points, and perhaps a material: {' '.join(words)}")
    return *values, words[name] if name is not None and name < len(words) else ""


def read(path, name, placing, ignored, notes):
    """The curves of a file, by its ending; those of a table without names have `name`."""
    kind = path.suffix.lower()
    if kind == ".dwg":
        raise Refused(65, f"{path}: is a DWG, which only its maker's programs read; save it as DXF")
    curves = read_dxf(path, placing, ignored, notes) if kind == ".dxf" else read_table(path, name, placing, ignored, notes)
    if not curves:
        raise Refused(65, f"{path}: draws nothing: {', '.join(DRAWN).lower()} in model space are read" if kind == ".dxf"
                      else f"{path}: has no two points")
    if (count := sum(len(curve.points) for curve in curves)) > MOST_POINTS:
        raise Refused(65, f"{path}: has {count} points, more than the {MOST_POINTS} that are read; thin them out, or give a greater --tolerance")
    return curves
