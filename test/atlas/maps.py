"""The maps of the atlas: what is varied against what, and why.

A map has panels, rows and columns; `settings(panel, row, column)` gives what of cases.USUAL differs there. `quick` picks the
rows and columns of --quick.
"""
from dataclasses import dataclass
from typing import Callable

from cases import ROCK, SOIL, USUAL, p_speed, s_speed, times

TRANSFERS = {"flip, consistent": {"transfer": "flip", "inertia": "consistent"}, "flip, lumped": {"transfer": "flip", "inertia": "lumped"},
           "apic, consistent": {"transfer": "apic", "inertia": "consistent"}, "apic, lumped": {"transfer": "apic", "inertia": "lumped"}}


@dataclass(frozen=True)
class Map:
    """One map: its axes, and what a point of it is."""
    name: str
    title: str
    panel: tuple   # (what, values)
    row: tuple
    column: tuple
    settings: Callable
    reason: str    # why it is drawn, and what follows for a user
    quick: tuple = (slice(0, 1), slice(None, None, 2), slice(None, None, 2))

    def points(self, quick):
        """(panel, row, column) of all points."""
        axes = [list(axis[1]) for axis in (self.panel, self.row, self.column)]
        if quick:
            axes = [values[part] for values, part in zip(axes, self.quick)]
        return [(p, r, c) for p in axes[0] for r in axes[1] for c in axes[2]]


def courant(panel, n, c):
    """A block with free sides and corners on rock, or level ground."""
    method, where = panel.split("; ")
    return {"courant": c, "n": n, "steps": round(200 / c), "block": (3, 9) if where == "free sides" else None,
            "seismic": TRANSFERS[method]}


def poisson(method, nu, c):
    """Soil and rock of the same Poisson's ratio."""
    return {"courant": c, "steps": round(300 / c), "block": (3, 9), "seismic": TRANSFERS[method], "rock": {**ROCK, "poisson_ratio": nu},
            "soil": {**SOIL, "poisson_ratio": nu}}


def contrast(method, ratio, cells):
    """A soft layer of so many cells on rock, long enough for its waves."""
    soil = {**ROCK, "young_modulus": ROCK["young_modulus"] / ratio}
    steps = round(2 * (cells + 12) * p_speed(ROCK) / s_speed(soil) / 0.5)
    paper = {"interfaces": "sharp"} if "lumped" in method else {}
    return {"soil": soil, "soil_cells": cells, "width": 8, "steps": min(steps, 12000), "seismic": TRANSFERS[method], "grid": paper}


def base(sides, ratio, speed):
    """The base stands on a layer whose impedance is so many times that of the ground above, and is set going."""
    rock = {**SOIL, "density": SOIL["density"] * ratio, "young_modulus": SOIL["young_modulus"] * ratio}
    return {"rock": rock, "base_speed": speed, "steps": 1500, "sides": sides, "n": 2, "width": 8}


def spring(method, steps, sides):
    """The base's spring of so many time steps, under a block that a pulse enters."""
    given = {"steps": 1000, "block": (3, 9) if sides == "quiet" else None, "sides": sides}
    dt, _ = times({**USUAL, **given})
    return {**given, "seismic": {**TRANSFERS[method], "base": {"spring": f"{steps * dt!r} s"}}}


def strength(ground, pga, q):
    """Clay of a strength in kPa under a pulse in g; the last strength is elastic ground."""
    soil = SOIL if q is None else {**SOIL, "model": "von_mises", "strength": {"peak": 1e3 * q}}
    block = ground == "block without gravity"
    return {"soil": soil, "pga": 9.81 * pga, "steps": 1000, "block": (3, 9) if block else None, "gravity": 0.0 if block else 9.81}


def friction(ground, phi, share):
    """Ground without cohesion, dilating by a share of its friction angle."""
    soil = {**SOIL, "model": "mohr_coulomb", "friction_angle": (float(phi),), "cohesion": (0.0,), "dilation_angle": float(share * phi)}
    return {"soil": soil, "gravity": 9.81, "pga": 5.0, "steps": 1000, "slope": 1 if ground == "slope" else 0, "rock_cells": 3}


def slip(transfer, d_c, cells):
    """Ground on a zone whose friction falls from 0.6 to 0.1 over a slip of d_c in m."""
    zone = {**SOIL, "model": "slip_weakening", "friction": (0.6, 0.1), "critical_slip": d_c, "thickness": float(cells)}
    return {"zone": zone, "zone_cells": cells, "soil_cells": 4, "gravity": 9.81, "pga": 15.0, "steps": 1000,
            "seismic": {"transfer": transfer}}


LAWS = {
    "elastic": SOIL,
    "clay": {**SOIL, "model": "von_mises", "strength": {"peak": 80e3, "residual": 40e3}, "softening": {"displacement": 0.2}},
    "sand": {**SOIL, "model": "mohr_coulomb", "friction_angle": (35.0,), "cohesion": (0.0,)},
}


def gravity(law, g, slope):
    """Ground under a gravity of any size, shaken by half of it."""
    return {"soil": LAWS[law], "gravity": g, "pga": 0.5 * g, "steps": 300, "slope": slope}


def size(law, h, load):
    """The same ground with cells of any size: loads that strain it alike, or those of the earth."""
    alike = 1 / h if load == "alike" else 1.0
    return {"soil": LAWS[law] | ({"softening": {"displacement": 0.2 * h}} if law == "clay" else {}), "h": h, "gravity": 9.81 * alike,
            "pga": 3 * alike, "seismic": {"filter": {"time": f"{3 * h!r} s"}}}


def particles(law, n, slope):
    """From one to ten particles along each side of a cell."""
    return {"soil": LAWS[law], "n": n, "gravity": 9.81, "pga": 3.0, "width": 9, "soil_cells": 4, "slope": slope, "steps": 300}


def options(sides, method, more):
    """Every choice with every other, on a slope of clay that yields."""
    transfer, inertia, interfaces = method.split(", ")
    softening, volume, spring = more.split(", ")
    return {"soil": LAWS["clay"], "gravity": 9.81, "pga": 8.0, "slope": 2, "sides": sides, "steps": 600,
            "grid": {"interfaces": interfaces, "softening": softening, "volume_average": volume},
            "seismic": {"transfer": transfer, "inertia": inertia, "base": {"spring": spring}, "rest_below": "1 mm/s"}}


def words(*choices):
    """All combinations of words, as 'a, b, c'."""
    texts = [""]
    for choice in choices:
        texts = [f"{text}, {word}" if text else word for text in texts for word in choice]
    return texts


MAPS = [
    Map("courant", "Courant number and particles per cell, elastic ground",
        ("method", [f"{m}; {w}" for w in ("free sides", "level") for m in TRANSFERS]), ("particles along a cell", [1, 2, 3]),
        ("Courant number", [0.05, 0.1, 0.3, 0.5, 0.7, 0.78, 0.9, 1.0, 1.2, 1.5, 1.8]), courant,
        "A case may ask for 0.78 at most; steps beyond it are planted. With apic small steps damp: take 0.5.",
        (slice(0, 4), slice(0, 2), slice(0, None, 2))),
    Map("poisson", "Courant number and Poisson's ratio", ("method", list(TRANSFERS)), ("Poisson's ratio", [-0.9, 0.0, 0.3, 0.45, 0.49, 0.499, 0.4999]),
        ("Courant number", [0.1, 0.3, 0.5, 0.7, 0.78, 1.0, 1.5]), poisson,
        "The step follows the P wave, so that S waves take the more steps the nearer to 1/2: with apic they are damped (warned of above 0.49).",
        (slice(0, None, 3), slice(1, None, 2), slice(0, None, 2))),
    Map("contrast", "Stiffness contrast and cells of the soft layer", ("method", list(TRANSFERS)),
        ("E of rock over E of soil", [1, 10, 100, 1000, 10000]), ("cells of the soft layer", [1, 2, 4, 8]), contrast,
        "Nothing grows up to 1e4. The share is of all energy that came in, of which little enters soft ground; there apic damps a wave by a (kh)^3 / 2C, C being the wave's own Courant number, 1e-2 of the rock's at 1e4: flip is the default for this.",
        (slice(0, None, 3), slice(0, None, 2), slice(0, None, 2))),
    Map("base", "Strength of the base's dashpots and speed of the base, whose face passes every place of its cells",
        ("sides", ["quiet", "free_field"]), ("impedance of the base over the ground's", [1e-3, 1e-2, 0.1, 1, 10, 100, 1e3]),
        ("speed of the base, m/s", [0.0, 0.1, 1.0, 5.0]), base, "Dashpots are centred in time: none is too strong.",
        (slice(0, 2), slice(0, None, 3), slice(0, None, 3))),
    Map("spring", "Time of the base's spring", ("method", list(TRANSFERS)), ("time of the spring, steps", [0.1, 1.0, 2.1, 4.0, 16.0, 256.0]),
        ("sides", ["quiet", "free_field"]), spring, "A spring of less than two steps is refused: drawn at random such springs threw the ground up to 1200 times "
        "as fast as it should be, and their own work hid it from the energy balance.", (slice(0, None, 3), slice(None), slice(0, 1))),
    Map("strength", "Peak acceleration and strength of clay", ("ground", ["block without gravity", "level"]),
        ("peak acceleration, g", [0.001, 0.1, 1.0, 5.0, 50.0]), ("strength q, kPa (none: elastic)", [1e-3, 1.0, 30.0, 1e3, None]), strength,
        "Ground that yields under its own weight has no static state: 81.", (slice(0, 2), slice(0, None, 2), slice(0, None, 2))),
    Map("friction", "Friction and dilation without cohesion", ("ground", ["level", "slope"]), ("friction angle, degrees", [0, 10, 20, 30, 45, 60]),
        ("dilation over friction", [0.0, 0.5, 1.0]), friction, "Without cohesion the surface is at its apex in every step.",
        (slice(0, 2), slice(0, None, 3), slice(0, None, 2))),
    Map("slip", "Critical slip and cells of the zone", ("transfer", ["flip", "apic"]), ("d_c, m", [1e-6, 1e-4, 1e-2, 1.0]),
        ("cells of the zone", [1, 2, 3, 4]), slip, "Weakening at once is no trouble of stability; a zone wants three cells for its slip.",
        (slice(0, 1), slice(0, None, 2), slice(0, None, 2))),
    Map("gravity", "Gravity", ("ground", list(LAWS)), ("gravity, m/s2", [1e-6, 1e-3, 1.0, 9.81, 100.0, 1000.0]),
        ("cells that the slope falls", [0, 1]), gravity, "Criteria are shares of the weight: any gravity ends; ground that it crushes is caught.",
        (slice(0, 3), slice(0, None, 3), slice(0, 1))),
    Map("size", "Size of the model: cells from 0.1 mm to 8 km", ("ground", list(LAWS)), ("cell size, m", [1e-4, 1e-2, 1.0, 100.0, 8e3]),
        ("loads", ["alike", "of the earth"]), size, "A model of 1 mm and one of 100 km are the same when they are strained alike.",
        (slice(0, 3), slice(0, None, 2), slice(0, 2))),
    Map("particles", "Particles per cell under gravity and shaking", ("ground", list(LAWS)), ("particles along a cell", list(range(1, 11))),
        ("cells that the slope falls", [0, 1]), particles, "2 are enough, more cost their square.", (slice(0, 3), slice(0, None, 4), slice(0, 2))),
    Map("options", "Every option with every other, a slope of clay that yields", ("sides", ["free_field", "quiet", "roller"]),
        ("method", words(("flip", "apic"), ("consistent", "lumped"), ("averaged", "sharp"))),
        ("ground and base", words(("averaged", "local"), ("none", "cell"), ("auto", "none"))), options,
        "No combination is unstable; which is right is another question.", (slice(0, 1), slice(0, None, 3), slice(0, None, 3))),
]
