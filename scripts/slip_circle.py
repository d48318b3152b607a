"""The circular slip surface of least yield acceleration in ground without friction (Swedish circle, pseudo-static).

The ground is a raster: columns of width `size` (m) with the height of their surface, and for each cell density (kg/m3)
and undrained shear strength (Pa, infinite where it does not fail).
"""
from dataclasses import dataclass
from itertools import product

import numpy as np

STANDARD_GRAVITY = 9.80665  # m/s2, 1 g
LEAST_COLUMNS = 6  # that a circle must cut
LEAST_DEPTH = 0.3  # of the radius, of the centre of mass below the centre: less is no slide but a block that topples


@dataclass
class Ground:
    """See above; `x` are the columns' middles, `bottom` is the lower end of the first cell (m)."""

    x: np.ndarray
    surface: np.ndarray
    bottom: float
    size: float
    density: np.ndarray  # [column, cell from the bottom up]
    strength: np.ndarray
    gravity: float = STANDARD_GRAVITY  # m/s2

    def __post_init__(self):
        """Sums mass and its first moment up every column, so that a circle's slices are two look-ups each."""
        heights = self.bottom + self.size * np.arange(self.density.shape[1] + 1)
        zero = np.zeros((len(self.x), 1))
        weight = self.density * self.size**2
        self.mass = np.hstack([zero, np.cumsum(weight, axis=1)])  # of a column below each cell's bottom, kg/m
        middle = 0.5 * (heights[1:] + heights[:-1])
        self.moment = np.hstack([zero, np.cumsum(weight * middle, axis=1)])  # times height


@dataclass
class Circle:
    """A slip circle and what it cuts off; `sense` is +1 when the slide goes to the right."""

    x: float
    y: float
    radius: float
    sense: int
    mass: float  # kg/m
    offset: float  # m, of the centre of mass, uphill of the centre
    depth: float  # m, of the centre of mass below the centre
    resistance: float  # N/m, strength times length of the arc
    ends: tuple  # m, x of the first and the last column
    gravity: float  # m/s2
    residual: float = np.nan

    @property
    def safety(self):
        """Factor of safety without shaking."""
        driving = self.gravity * self.mass * self.offset
        return self.radius * self.resistance / driving if driving > 0 else np.inf

    @property
    def yield_acceleration(self):
        """m/s2"""
        return (self.radius * self.resistance / self.mass - self.gravity * self.offset) / self.depth


def below(table, columns, cells):
    """Value of a cumulative table of the columns at a fractional cell."""
    lower = np.clip(cells.astype(int), 0, table.shape[1] - 2)
    return table[columns, lower] + (cells - lower) * (table[columns, lower + 1] - table[columns, lower])


def cut(ground, x, y, radius, sense, strength=None):
    """The circle about (x, y), None where it cuts no slide out of the ground."""
    strength = ground.strength if strength is None else strength
    reach = radius**2 - (ground.x - x) ** 2
    depth = np.sqrt(np.maximum(reach, 0.0))
    arc = y - depth
    columns = np.flatnonzero((reach > 0) & (arc < ground.surface))
    # Where the arc leaves the ground the slide ends, though the circle may meet ground again farther on.
    parts = np.split(columns, np.flatnonzero(np.diff(columns) > 1) + 1)
    columns = parts[0] if sense > 0 else parts[-1]
    if len(columns) < LEAST_COLUMNS:
        return None
    if y < ground.surface[columns].max():
        return None  # part of the arc would overhang
    if columns[0] == 0 or columns[-1] == len(ground.x) - 1 or arc[columns].min() <= ground.bottom:
        return None
    cells = (arc[columns] - ground.bottom) / ground.size
    met = strength[columns, np.clip(cells.astype(int), 0, strength.shape[1] - 1)]
    if not np.isfinite(met).all():
        return None
    top = (ground.surface[columns] - ground.bottom) / ground.size
    mass = below(ground.mass, columns, top) - below(ground.mass, columns, cells)
    moment = below(ground.moment, columns, top) - below(ground.moment, columns, cells)
    total = mass.sum()
    middle_x, middle_y = (mass * ground.x[columns]).sum() / total, moment.sum() / total
    if y - middle_y < LEAST_DEPTH * radius:
        return None
    # The length of the arc within each column, exactly; it ends where it meets the surface between two columns.
    gap = ground.surface - arc
    ends = [inner + (outer - inner) * gap[k] / (gap[k] - gap[j]) for k, j, inner, outer in
            ((columns[0], columns[0] - 1, ground.x[columns[0]], ground.x[columns[0] - 1]),
             (columns[-1], columns[-1] + 1, ground.x[columns[-1]], ground.x[columns[-1] + 1]))]
    edges = np.append(ground.x[columns] - 0.5 * ground.size, ground.x[columns[-1]] + 0.5 * ground.size)
    edges[0], edges[-1] = ends
    length = radius * np.diff(np.arcsin(np.clip((edges - x) / radius, -1, 1)))
    return Circle(x, y, radius, sense, total, sense * (x - middle_x), y - middle_y, (met * length).sum(),
                  (float(ground.x[columns[0]]), float(ground.x[columns[-1]])), ground.gravity)


def better(best, ground, x, y, lowest, sense):
    """The weaker of two circles; the other one is about (x, y) and reaches down to `lowest`."""
    circle = cut(ground, x, y, y - lowest, sense)
    if circle and circle.offset > 0 and (not best or circle.yield_acceleration < best.yield_acceleration):
        return circle
    return best


def weakest(ground, sense):
    """The circle of least yield acceleration among slides in one sense, None if there is none: grid, then finer ones."""
    low, high = np.nanmin(ground.surface), np.nanmax(ground.surface)
    rise = high - low
    axes = (np.linspace(ground.x[0], ground.x[-1], 57), np.linspace(high, high + 1.5 * rise, 13),
            np.linspace(ground.bottom, high, 26)[1:-1])
    best = None
    for point in product(*axes):
        best = better(best, ground, *point, sense)
    step = [axis[1] - axis[0] for axis in axes]
    while best and max(step) > 0.25 * ground.size:
        centre = (best.x, best.y, best.y - best.radius)
        step = [0.6 * part for part in step]
        for point in product(*(c + d * np.arange(-2, 3) for c, d in zip(centre, step))):
            best = better(best, ground, *point, sense)
    return best
