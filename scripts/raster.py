"""The ground of a section from a picture whose colours are materials: PNG, or what else Pillow reads. Lengths in m."""
import numpy as np
from PIL import Image
from scipy import ndimage

import section
from drawing import at
from resolved_case import Refused

NEAR = 60.0  # in RGB of 0 to 255: as near a pixel's colour has to be to one of the legend
MOST_STRANGE = 0.1  # of the pixels: lines and lettering, which take the colour beside them
MOST_PIXELS = 20_000_000
LEAST = 1e-4  # of the picture: a smaller patch is no ground of its own


def patches_of(path, legend, air, notes):
    """Pixels [row, column] as numbers of the legend's materials, -1 where there is air."""
    try:
        with Image.open(path) as picture:
            if picture.size[0] * picture.size[1] > MOST_PIXELS:
                raise Refused(65, f"{path}: has {picture.size[0]} x {picture.size[1]} pixels, more than {MOST_PIXELS}; make it smaller")
            white = Image.new("RGBA", picture.size, (*air, 255))
            pixels = np.asarray(Image.alpha_composite(white, picture.convert("RGBA")))[..., :3]
    except OSError as reason:
        raise Refused(66 if not path.is_file() else 65, f"{path}: cannot be read: {reason}") from None
    distance = np.stack([sum((pixels[..., k].astype(np.float32) - colour[k]) ** 2 for k in range(3)) for colour in [air, *legend.values()]])
    owner, strange = distance.argmin(axis=0) - 1, distance.min(axis=0) > NEAR**2
    if strange.any():
        rows, columns = np.nonzero(strange)
        code = pixels[rows, columns].astype(np.int64) @ (65536, 256, 1)
        values, first, count = np.unique(code, return_index=True, return_counts=True)
        most = count.argmax()
        place = f"#{values[most]:06x} in row {rows[first[most]]}, column {columns[first[most]]}"
        if (share := strange.mean()) > MOST_STRANGE:
            raise Refused(65, f"{path}: {share:.0%} of the pixels have colours of no material, as {place}; name them with --colour MATERIAL=#rrggbb")
        notes.append(f"{path.name}: {strange.sum()} pixels have colours of no material, as {place}; they take the nearest material")
        nearest = ndimage.distance_transform_edt(strange, return_distances=False, return_indices=True)
        owner = owner[tuple(nearest)]
    return owner


def cleaned(owner, notes, where):
    """The patches, without what is thinner than three pixels or but a speck: that takes the nearest material. Edges that are drawn smooth have such colours."""
    core = np.zeros(owner.shape, dtype=bool)
    for k in np.unique(owner):
        mask = ndimage.binary_opening(np.pad(owner == k, 1, mode="edge"), np.ones((3, 3)))[1:-1, 1:-1]
        numbers, count = ndimage.label(mask)
        sizes = np.bincount(numbers.ravel(), minlength=count + 1)
        specks = np.flatnonzero(sizes[1:] < LEAST * owner.size) + 1
        if len(specks):
            notes.append(f"{where}: {len(specks)} patches of less than {LEAST:.2%} of the picture take the material around them")
        core |= mask & ~np.isin(numbers, specks)
    nearest = ndimage.distance_transform_edt(~core, return_distances=False, return_indices=True)
    return owner[tuple(nearest)]


def simplified(x, y, tolerance):
    """The points of a line that keep it within the tolerance (Douglas and Peucker)."""
    keep, pending = {0, len(x) - 1}, [(0, len(x) - 1)]
    while pending:
        a, b = pending.pop()
        if b - a < 2:
            continue
        away = np.abs(y[a:b + 1] - np.interp(x[a:b + 1], x[[a, b]], y[[a, b]]))
        if away.max() > tolerance:
            k = a + int(away.argmax())
            keep.add(k)
            pending += [(a, k), (k, b)]
    order = sorted(keep)
    return x[order], y[order]


class Patch:
    """A coherent patch of one material: its uppermost and lowest pixel in each column, -1 where it is not."""

    def __init__(self, number, mask):
        """Of the number of its material and its pixels."""
        self.number, self.mask = number, mask
        here = mask.any(axis=0)
        self.top = np.where(here, mask.argmax(axis=0), -1)
        self.low = np.where(here, len(mask) - 1 - mask[::-1].argmax(axis=0), -1)
        self.columns = np.flatnonzero(here)
        self.hosts = set()

    def beside(self, other):
        """Whether both are in a column, for each."""
        return (self.top >= 0) & (other.top >= 0)

    def within(self, other):
        """Whether the other is above and below this in some column."""
        return bool(((other.top < self.top) & (other.low > self.low))[self.beside(other)].any())

    def absorb(self, lens):
        """Takes the place of a lens where both are: that goes before this."""
        both = self.beside(lens)
        self.top[both] = np.minimum(self.top, lens.top)[both]
        self.low[both] = np.maximum(self.low, lens.low)[both]

    def beneath(self, other):
        """Whether this lies below the other in some column."""
        return bool((self.top > other.top)[self.beside(other)].any())


def ordered(patches, place, names):
    """Patches as regions take them, the first that holds a point: lenses, the innermost first, and the others from below."""
    for one in patches:
        one.hosts = {k for k, other in enumerate(patches) if other is not one and one.within(other)}
    inner, lenses = [patch for patch in patches if patch.hosts], []
    while inner:
        free = next((one for one in inner if not any(patches.index(one) in other.hosts for other in inner)), None)
        if free is None:
            raise Refused(65, f"{place(inner[0], inner[0].columns[0])}: {names[inner[0].number]} and {names[inner[1].number]} lie within each other; draw them as outlines")
        inner.remove(free)
        lenses.append(free)
        for k in free.hosts:
            patches[k].absorb(free)
    rest, found = [patch for patch in patches if not patch.hosts], []
    while rest:
        lowest = next((one for one in rest if not any(other.beneath(one) for other in rest if other is not one)), None)
        if lowest is None:
            raise Refused(65, f"{place(rest[0], rest[0].columns[0])}: {names[rest[0].number]} lies above {names[rest[1].number]} in one place and below it in another; "
                              "draw it as outlines")
        found.append(lowest)
        rest.remove(lowest)
    return lenses, found


def refuse_folds(patches, owner, place, names):
    """Refuses a patch with something else in it than a lens: air, or a material that it is folded around."""
    for patch in patches:
        rows = np.arange(len(owner))[:, None]
        between = (rows > patch.top) & (rows < patch.low) & (patch.top >= 0) & ~patch.mask
        for other in patches:
            if patches.index(patch) in other.hosts:
                between &= ~other.mask
        if between.any():
            row, column = np.argwhere(between)[0]
            what = "air" if owner[row, column] < 0 else names[owner[row, column]]
            raise Refused(65, f"{place(patch, column)}: {names[patch.number]} hangs over {what}; a line of a case has one height at each x")


def build(path, legend, wish, notes):
    """The section of a picture, whose legend is {material: RGB}."""
    owner = cleaned(patches_of(path, legend, wish.air, notes), notes, path.name)
    if not (owner >= 0).any():
        raise Refused(65, f"{path}: has none of the colours {', '.join(wish.colour)}")
    names, pixel = list(legend), np.abs(np.multiply(wish.pixel, wish.scale))
    patches = [Patch(k, numbers == j) for k in range(len(names)) for numbers, count in [ndimage.label(owner == k)] for j in range(1, count + 1)]
    notes += [f"--colour {name}: the picture has no ground of it" for k, name in enumerate(names) if not any(patch.number == k for patch in patches)]
    x_of = lambda column: column * pixel[0] + wish.shift[0]
    y_of = lambda row: (len(owner) - row) * pixel[1] + wish.shift[1]
    place = lambda patch, column: f"{path.name}, {at(x_of(column + 0.5), y_of(patch.top[column]))}"
    lenses, layers = ordered(patches, place, names)
    refuse_folds(patches, owner, place, names)
    drawn = x_of(min(patch.columns[0] for patch in patches)), x_of(max(patch.columns[-1] for patch in patches) + 1)
    left, right = section.sides_of(drawn, wish, notes)
    tolerance = wish.tolerance or 1.01 * pixel[1]  # a step is one pixel
    decimals = max(0, int(np.ceil(-np.log10(tolerance / 100))))

    def edge(patch, rows, name):
        x, y = simplified(x_of(patch.columns + 0.5), y_of(rows[patch.columns]), tolerance)
        return section.clipped(section.Line(name, x, y, f"{path.name}, {names[patch.number]}"), name, left, right, decimals)

    regions, count = [], {}
    for patch in [*lenses, *layers]:
        material = names[patch.number]
        count[material] = count.get(material, 0) + 1
        name = material + (f"_{count[material]}" if count[material] > 1 else "")
        first, last = x_of(patch.columns[0]), x_of(patch.columns[-1] + 1)
        limits = float(max(left, first if first > drawn[0] else left)), float(min(right, last if last < drawn[1] else right))
        if limits[0] < limits[1]:
            lower = edge(patch, patch.low + 1, f"{name}_bottom") if patch.hosts else None
            regions.append(section.Region(material, edge(patch, patch.top, f"{name}_top"), lower, None if limits == (left, right) else limits,
                                          f"{path.name}, {material}", bool(patch.hosts)))
    bottom = y_of(max(patch.low.max() for patch in patches) + 1) if wish.bottom is None else wish.bottom
    found = section.Section(left, right, float(bottom), regions, 2 * max(tolerance, pixel[1]))
    refuse_gaps(owner, found.bottom, x_of, y_of, path)
    section.measured(found)
    return found


def refuse_gaps(owner, bottom, x_of, y_of, path):
    """Refuses air below the ground, down to the base; two rows at the base may be missing."""
    air = (owner < 0) & (np.cumsum(owner >= 0, axis=0) > 0)
    low = len(owner) - 1 - (owner >= 0)[::-1].argmax(axis=0)
    rows = np.arange(len(owner))[:, None]
    gap = air & ((rows < low) | (y_of(low + 1) - bottom > 2 * (y_of(0) - y_of(1)))) & (y_of(rows) > bottom)
    if gap.any():
        column = gap.sum(axis=0).argmax()
        row = gap[:, column].argmax()
        raise Refused(65, f"{path.name}: there is air in the ground at {at(x_of(column + 0.5), y_of(row))}, above the base, y = {bottom:.6g} m; "
                          "paint what lies there, or raise the base with --bottom")


def colours_of(path):
    """The colours that a picture has most of, for a message."""
    try:
        with Image.open(path) as picture:
            small = picture.convert("RGB")
            small.thumbnail((400, 400), Image.Resampling.NEAREST)
    except OSError as reason:
        raise Refused(66 if not path.is_file() else 65, f"{path}: cannot be read: {reason}") from None
    count = sorted(small.getcolors(maxcolors=small.size[0] * small.size[1]), reverse=True)
    whole = sum(number for number, _ in count)
    return ", ".join(f"#{red:02x}{green:02x}{blue:02x} ({number / whole:.0%})" for number, (red, green, blue) in count[:8])
