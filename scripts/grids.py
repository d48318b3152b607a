"""Which grids a case is computed on to tell its numerical uncertainty: its own, two coarser ones, and shifted ones.

Work goes as the third power of 1/h: half the particles' spacing has four times the particles and twice the steps.
"""
from dataclasses import dataclass, field

from stages import numbers

RATIOS = (1.55, 2.4)  # of the coarser cells to the case's: 0.27 + 0.07 of its work
LEAST_RATIO = 1.15    # of a grid's cells to the next finer one's
ROTATION = (0.7548776662466927, 0.5698402909980532)  # 1/g and 1/g^2, g^3 = g + 1: points that fill the cell evenly


class BadGrid(Exception):
    """Says why a case has no coarser grids."""


@dataclass(frozen=True)
class Grid:
    """A grid of a case: how it is called, its cells (m), where its origin is moved to (cells), and its settings."""
    name: str
    spacing: float
    level: int
    shift: tuple = (0.0, 0.0)
    settings: dict = field(default_factory=dict)

    @property
    def work(self):
        """Work beside that of a grid with cells of 1 m."""
        return self.spacing**-3


def metres(value):
    """A length as a case has it."""
    return f"{value:.12g} m"


def spacings(settings, ratios=RATIOS):
    """Cells (m) of the case and of the coarser grids, a whole number of them between the sides."""
    spacing = numbers(settings["grid.spacing"])[0]
    left, right = numbers(settings["domain.x"])
    cells = round((right - left) / spacing)
    found = [spacing]
    for ratio in ratios:
        found.append((right - left) / max(1, round(cells / ratio)))
        if found[-1] < LEAST_RATIO * found[-2]:
            raise BadGrid(f"domain.x: {cells} cells between the sides leave no room for cells {ratio:g} times as wide; "
                          "widen the model, or give other --ratios")
    return found


def movable(settings):
    """Whether the grid can be moved in x and in y without moving what is physical: roller sides, a fixed base."""
    return settings["seismic.sides.kind"] != "roller", settings["seismic.base.kind"] == "compliant"


def moved_by(settings, spacing, shift):
    """Settings that move sides and base by `shift` cells, and the ends of regions with the sides they stand at."""
    sides, bottom = numbers(settings["domain.x"]), numbers(settings["domain.bottom"])[0]
    along = spacing * shift[0]
    moved = {}
    if along:
        moved["domain.x"] = "[" + ", ".join(metres(side + along) for side in sides) + "]"
        for path, value in settings.items():
            if path.startswith("regions[") and path.endswith("].x"):
                ends = [end + along if end == side else end for end, side in zip(numbers(value), sides)]
                moved[path] = "[" + ", ".join(metres(end) for end in ends) + "]"
    if shift[1]:
        moved["domain.bottom"] = metres(bottom + spacing * shift[1])
    return moved


def shifts(count, may_move):
    """Shifts of the grid's origin, in cells between -1/2 and 1/2: a sequence without clusters, the same every time.

    Roberts, M. (2018), additive recurrence with the plastic number.
    """
    points = [tuple(((0.5 + k * step) % 1.0) - 0.5 for step in ROTATION) for k in range(1, count + 1)]
    return [tuple(part if may else 0.0 for part, may in zip(point, may_move)) for point in points]


def plan(settings, counts, ratios=RATIOS):
    """The grids of a case, coarsest first. counts: shifted grids with the case's cells, with the next and the coarsest."""
    may_move = movable(settings)
    grids = []
    for level, (spacing, count) in enumerate(zip(spacings(settings, ratios), counts)):
        name = "as-is" if level == 0 else f"h{spacing:.4g}"
        own = {} if level == 0 else {"grid.spacing": metres(spacing)}
        grids.append(Grid(name, spacing, level, settings=own))
        for k, shift in enumerate(shifts(count if any(may_move) else 0, may_move), 1):
            grids.append(Grid(f"{name}-shift{k}", spacing, level, shift, own | moved_by(settings, spacing, shift)))
    return sorted(grids, key=lambda grid: -grid.level)
