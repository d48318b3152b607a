"""The ground of a section, as lines y(x) and regions of a case, from the curves of a drawing; checked. Lengths in m."""
from dataclasses import dataclass, field

import numpy as np

import outline
from drawing import FINENESS, at
from resolved_case import Refused


@dataclass
class Line:
    """A surface of a case."""

    name: str
    x: np.ndarray
    y: np.ndarray
    where: str  # how it was drawn

    def height(self, x):
        """Heights at x."""
        return np.interp(x, self.x, self.y)


@dataclass
class Region:
    """A region of a case; None stands for the base and for the sides."""

    material: str
    below: Line
    above: Line = None
    sides: tuple = None
    where: str = ""
    closed: bool = False  # drawn as an outline
    area: float = 0.0  # m2, as drawn


@dataclass
class Section:
    """The whole ground; of its regions the first that holds a point has it."""

    left: float
    right: float
    bottom: float
    regions: list
    tolerance: float
    notes: list = field(default_factory=list)

    def lines(self):
        """The surfaces, from above."""
        found = {line.name: line for region in self.regions for line in (region.below, region.above) if line is not None}
        return sorted(found.values(), key=lambda line: -line.y.mean())

    def outline_error(self, region):
        """By how much the tolerance may change the area of a closed region, m2."""
        return 2 * self.tolerance * (np.ptp(region.sides or (self.left, self.right)) + region.below.y.max() - region.below.y.min() + self.tolerance)

    def ground(self, x):
        """Height of the ground at x."""
        return np.max([np.where(inside(region, x), region.below.height(x), -np.inf) for region in self.regions], axis=0)


def inside(region, x):
    """Whether x lies between the sides of a region."""
    return np.ones(np.shape(x), dtype=bool) if region.sides is None else (x >= region.sides[0]) & (x <= region.sides[1])


def resolved(pieces, sides, drawn, tolerance, level):
    """{material: Line} over the whole section, of {material: [(x, y, where)]}: beyond its ends a line follows the one that it ends on.

    sides: of the model; drawn: of the drawing. Lines of the materials in `level` go on level instead.
    """
    for name, parts in pieces.items():
        parts.sort(key=lambda part: part[0][0])
        for (one, _, _), (other, y, where) in zip(parts, parts[1:]):
            if other[0] < one[-1] - tolerance:
                raise Refused(65, f"{where}: lies above or below another line of {name} at {at(other[0], y[0])}; a material has one upper boundary")
    gaps = [(one[0][-1] + other[0][0]) / 2 for parts in pieces.values() for one, other in zip(parts, parts[1:])]
    x = np.unique(np.concatenate([[*sides, *drawn, *gaps], *(part[0] for parts in pieces.values() for part in parts)]))
    known = {name: np.full(len(x), np.nan) for name in pieces}  # heights at x, where they are known
    for name, parts in pieces.items():
        for k, (px, py, _) in enumerate(parts):
            first = -np.inf if px[0] <= drawn[0] + tolerance or name in level and k == 0 else px[0]
            last = np.inf if px[-1] >= drawn[1] - tolerance or name in level and k == len(parts) - 1 else px[-1]
            here = (x >= first) & (x <= last)
            known[name][here] = np.interp(x[here], px, py)
    drawn_at = {name: ~np.isnan(y) for name, y in known.items()}
    while any([follow(name, known, tolerance) for name in known]):
        pass
    for name, y in known.items():
        ends = np.flatnonzero(np.diff(drawn_at[name].astype(int)) != 0)
        for k, beyond in [(k, k + 1) if drawn_at[name][k] else (k + 1, k) for k in ends]:
            if not any(abs(z[[k, beyond]] - y[[k, beyond]]).max() <= tolerance for other, z in known.items() if other != name):
                near = min(pieces[name], key=lambda part: min(abs(part[0][0] - x[k]), abs(part[0][-1] - x[k])))
                raise Refused(65, f"{near[2]}: ends at {at(x[k], y[k])}, neither at a side of the drawing (x = {drawn[0]:.6g} m and {drawn[1]:.6g} m) "
                                  f"nor on another line; draw it on, or let it go on level (--extend '{name}')")
    return {name: Line(name, *sparse(x, y), "; ".join(part[2] for part in pieces[name])) for name, y in known.items()}


def follow(name, known, tolerance):
    """Fills a line where it is not drawn from the line that it ends on, as far as that one is known; whether it could."""
    y, changed = known[name], False
    for step in (1, -1):
        leader = None
        for k in range(len(y))[::step]:
            before = k - step
            if not np.isnan(y[k]):
                leader = None
            elif 0 <= before < len(y) and not np.isnan(y[before]):
                if leader is None:
                    under = [z for other, z in known.items() if other != name and abs(z[before] - y[before]) <= tolerance and not np.isnan(z[k])]
                    leader = max(under, key=lambda z: z[k]) if under else None
                if leader is not None and not np.isnan(leader[k]):
                    y[k], changed = leader[k], True
    return changed


def sparse(x, y):
    """A line without the points that lie on the straight between their neighbours."""
    keep, last = [0], 0
    for k in range(1, len(x) - 1):
        straight = y[last] + (y[k + 1] - y[last]) * (x[k] - x[last]) / (x[k + 1] - x[last])
        if abs(straight - y[k]) > 1e-9 * (1 + abs(y[k])):
            keep.append(k)
            last = k
    return x[keep + [len(x) - 1]], y[keep + [len(x) - 1]]


def in_order(lines, tolerance):
    """Lines from below; refused where two cross, or are the same."""
    if not lines:
        return []
    x = np.unique(np.concatenate([line.x for line in lines]))
    lines = sorted(lines, key=lambda line: np.trapz(line.height(x), x))
    for k, upper in enumerate(lines):
        for lower in lines[:k]:
            apart = upper.height(x) - lower.height(x)
            if apart.max() <= tolerance:
                raise Refused(65, f"{upper.where}: is the same line as {lower.where}: one of the two has no ground; "
                                  "materials side by side are drawn as closed outlines")
            if apart.min() < -tolerance:
                change = np.flatnonzero(np.diff(np.sign(apart)) != 0)
                cross = change[np.argmin(np.abs(change - np.argmin(apart)))]
                share = apart[cross] / (apart[cross] - apart[cross + 1])
                place = x[cross] + share * (x[cross + 1] - x[cross])
                raise Refused(65, f"{upper.where}: crosses {lower.where} at {at(place, upper.height(place))}; end the one on the other there")
    return lines


def clipped(line, name, left, right, decimals):
    """A line between the sides, level beyond its ends, under the name of a surface."""
    within = (line.x > left + 10.0**-decimals) & (line.x < right - 10.0**-decimals)
    x = np.concatenate([[left], np.round(line.x[within], decimals), [right]])
    return Line(name, *sparse(x, np.round(line.height(np.concatenate([[left], line.x[within], [right]])), decimals)), line.where)


def measured(section):
    """Gives the regions their areas; refuses hollows, outlines that overlap, and regions without ground."""
    lines, regions = section.lines(), section.regions
    x = np.unique(np.concatenate([[section.left, section.right], *(line.x for line in lines), *(r.sides for r in regions if r.sides)]))
    x = np.unique(np.concatenate([x, *(crossings(a, b, x) for k, a in enumerate(lines) for b in lines[:k])]))
    x = x[(x >= section.left) & (x <= section.right)]
    step = np.diff(x)
    where = np.stack([x[:-1] + 1e-6 * step, x[1:] - 1e-6 * step], axis=1).ravel()
    low, high = (np.full((len(regions), len(where)), section.bottom) for _ in range(2))
    for k, region in enumerate(regions):
        here = inside(region, where)
        high[k, here] = np.maximum(section.bottom, region.below.height(where[here]))
        if region.above is not None:
            low[k, here] = np.maximum(section.bottom, region.above.height(where[here]))
    cut = np.sort(np.concatenate([np.full((1, len(where)), section.bottom), low, high]), axis=0)
    thick, middle = np.diff(cut, axis=0), (cut[1:] + cut[:-1]) / 2
    holds = (low[:, None] <= middle) & (middle <= high[:, None]) & (thick > 0)
    owner = np.where(holds.any(axis=0), holds.argmax(axis=0), -1)
    width = np.repeat(step / 2, 2)
    refuse_hollows(section, owner, thick, middle, where)
    for k in [k for k, region in enumerate(regions) if region.closed]:
        for j in [j for j in range(k) if regions[j].closed]:
            both = np.where(holds[j] & holds[k], thick, 0.0)
            shared, own = (both.sum(axis=0) * width).sum(), (np.where(holds[j], thick, 0.0).sum(axis=0) * width).sum()
            if section.outline_error(regions[j]) < shared < own - section.outline_error(regions[j]):
                row, m = np.unravel_index(np.argmax(both), both.shape)
                raise Refused(65, f"{regions[j].where}: overlaps {regions[k].where} by {shared:.4g} m2, at {at(where[m], middle[row, m])}; "
                                  "let them touch, or one lie within the other")
    for k, region in enumerate(regions):
        region.area = float((np.where(owner == k, thick, 0.0).sum(axis=0) * width).sum())
        if region.area <= section.tolerance**2:
            raise Refused(65, f"{region.where or region.below.where}: encloses no ground of {region.material} above the base, y = {section.bottom:g} m, "
                              f"between x = {section.left:g} m and {section.right:g} m")


def refuse_hollows(section, owner, thick, middle, where):
    """Refuses ground that is missing below other ground, or wholly."""
    filled = owner >= 0
    if (bare := ~filled.any(axis=0)).any():
        raise Refused(65, f"there is no ground at x = {where[np.argmax(bare)]:.6g} m above the base, y = {section.bottom:g} m")
    covered = np.flip(np.cumsum(np.flip(filled, 0), axis=0), 0) > 0
    hollow = np.where(covered & ~filled, thick, 0.0)
    if (hollow > section.tolerance).any():
        row, k = np.unravel_index(np.argmax(hollow), hollow.shape)
        raise Refused(65, f"the ground has a hollow {hollow[row, k]:.4g} m high at {at(where[k], middle[row, k])}: draw what lies there, "
                          "or raise the base above it with --bottom")


def crossings(one, other, x):
    """Where two lines cross, between places x."""
    apart = one.height(x) - other.height(x)
    k = np.flatnonzero(apart[:-1] * apart[1:] < 0)
    return x[k] + (x[k + 1] - x[k]) * apart[k] / (apart[k] - apart[k + 1])


def build(curves, wish):
    """The section of curves by material, as the command line (`wish`) has it."""
    corners = np.concatenate([curve.points for curve in curves])
    drawn, notes = (float(corners[:, 0].min()), float(corners[:, 0].max())), []
    tolerance = wish.tolerance or max(np.ptp(corners, axis=0)) / FINENESS
    curves = outline.snapped(outline.joined(curves, tolerance), tolerance)
    pieces, closed = {}, []
    for curve in curves:
        outline.refuse_crossing(curve)
        if curve.closed:
            closed.append((curve, *outline.chains(curve, tolerance, notes)))
        else:
            pieces.setdefault(curve.name, []).append((*outline.rising(curve.points, tolerance, curve.where, notes), curve.where))
    left, right = sides_of(drawn, wish, notes)
    for name in wish.extend:
        if name not in pieces:
            raise Refused(64, f"--extend {name}: no open line draws it; open lines draw {', '.join(pieces) or 'nothing'}")
    lines = list(resolved(pieces, (left, right), drawn, tolerance, wish.extend).values()) if pieces else []
    if wish.rock:
        lines.append(rockhead(lines, wish))
    lines = in_order(lines, tolerance)
    decimals = max(0, int(np.ceil(-np.log10(tolerance / 100))))
    cut = lambda line, name: clipped(line, name, left, right, decimals)
    regions = outlines(closed, drawn, (left, right), cut, notes)
    for line in lines:
        regions.append(Region(line.name, cut(line, "ground" if line is lines[-1] else f"{line.name}_top"), where=line.where))
    section = Section(left, right, bottom_of(regions, wish), regions, tolerance, notes)
    for region in regions:
        if region.above is not None and region.above.y.max() <= section.bottom + tolerance:
            region.above = None
    measured(section)
    return section


def sides_of(drawn, wish, notes):
    """Sides of the model, from those of the drawing: a whole number of cells apart, where the cell is given."""
    left, right = wish.sides or (drawn[0] - wish.level, drawn[1] + wish.level)
    if wish.cell:
        whole = left + np.ceil((right - left) / wish.cell - 1e-9) * wish.cell
        if whole - right > 1e-9 * wish.cell:
            notes.append(f"the right side is moved from x = {right:.6g} m to {whole:.6g} m, for a whole number of cells of {wish.cell:g} m")
        right = whole
    return round(left, 9), round(right, 9)


def rockhead(lines, wish):
    """The line of the rock, parallel to the ground or level."""
    if not lines:
        raise Refused(65, "--depth and --rockhead go with open lines, and the drawing has none; draw the rock as an outline")
    if any(line.name == wish.rock for line in lines):
        raise Refused(65, f"{wish.rock} is drawn, and is to lie at --depth or --rockhead too; give one of them, or another --rock")
    x = np.unique(np.concatenate([line.x for line in lines]))
    top = np.max([line.height(x) for line in lines], axis=0)
    if wish.depth is not None:
        return Line(wish.rock, x, top - wish.depth, f"--depth {wish.depth:g}")
    return Line(wish.rock, x[[0, -1]], np.full(2, wish.rockhead), f"--rockhead {wish.rockhead:g}")


def outlines(closed, drawn, sides, cut, notes):
    """Regions of the closed curves (curve, upper, lower), the smaller first: it may lie within the greater."""
    regions, count = [], {}
    for curve, upper, lower in sorted(closed, key=lambda one: np.trapz(one[1][1], one[1][0]) - np.trapz(one[2][1], one[2][0])):
        first = sides[0] if upper[0][0] <= drawn[0] else upper[0][0]
        last = sides[1] if upper[0][-1] >= drawn[1] else upper[0][-1]
        if last <= sides[0] or first >= sides[1]:
            notes.append(f"{curve.where}: lies beyond the sides, and is not used")
            continue
        count[curve.name] = count.get(curve.name, 0) + 1
        name = curve.name + (f"_{count[curve.name]}" if count[curve.name] > 1 else "")
        limits = float(max(first, sides[0])), float(min(last, sides[1]))
        regions.append(Region(curve.name, cut(Line(name, *upper, curve.where), f"{name}_top"),
                              cut(Line(name, *lower, curve.where), f"{name}_bottom"),
                              None if limits == tuple(sides) else limits, curve.where, True))
    return regions


def bottom_of(regions, wish):
    """Height of the base; where all is closed and ends level below, that is the base."""
    if wish.bottom is not None:
        return wish.bottom
    lowest = min(line.y.min() for region in regions for line in (region.below, region.above) if line is not None)
    top = max(region.below.y.max() for region in regions)
    if not all(region.closed for region in regions):
        raise Refused(64, f"how deep does the ground go? Give the height of the base, as --bottom {np.floor(lowest - 0.25 * (top - lowest)):g} "
                          f"(the lowest line reaches down to y = {lowest:.6g} m)")
    return float(lowest)
