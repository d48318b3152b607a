"""Everything at once: cases drawn at random with a fixed seed, from the whole range of every key.

A draw has a few hundred particles and steps. It has to end with 0 and finite results that no energy from nowhere has grown, or
with a refusal, 80 or 81 that says why.
"""
import random

from cases import ROCK, SOIL, p_speed

SEED = 20210914
SPOILS = [  # settings that no ground has, which have to be refused
    (("materials", "soil", "poisson_ratio"), 0.5), (("materials", "soil", "poisson_ratio"), -1.1), (("materials", "soil", "density"), "0 kg/m3"),
    (("materials", "soil", "density"), "-1800 kg/m3"), (("materials", "soil", "young_modulus"), "nan Pa"), (("materials", "rock", "young_modulus"), "inf Pa"),
    (("time_step", "courant_number"), 0.79), (("time_step", "courant_number"), 0), (("grid", "particles_per_cell"), 0), (("grid", "spacing"), "0 m"),
    (("grid", "spacing"), "1e-9 m"), (("domain", "x"), ["0 m", "-5 m"]), (("static", "damping"), 1), (("seismic", "duration"), "-1 s"), (("regions",), []),
]


def power(rng, low, high):
    """A number between powers of ten."""
    return 10 ** rng.uniform(low, high)


def law(rng, weak, common=None):
    """Any law with any parameters; `weak` scales its strengths, Pa; `common`: density and elasticity, if they are not to be drawn."""
    common = common or {"density": power(rng, 2.5, 4), "young_modulus": power(rng, 4, 11),
              "poisson_ratio": rng.choice([rng.uniform(-0.5, 0.49), 0.3, 0.49, 0.499, 0.0])}
    model = rng.choice(["elastic", "von_mises", "mohr_coulomb", "slip_weakening"])
    found = {**common, "model": model}
    if model == "von_mises":
        peak = weak * power(rng, -4, 3)
        found["strength"] = {"peak": peak, "residual": peak * rng.choice([0.0, rng.random(), 1.0])}
        if found["strength"]["residual"] < peak:  # over more than the elastic strain of the strength lost, which is refused
            found["softening"] = {"strain": 1.01 * 2 * peak / found["young_modulus"] * power(rng, 0, 3)}
    if model == "mohr_coulomb":
        phi = rng.choice([0.0, rng.uniform(0, 60), 30.0])
        found["friction_angle"] = (phi,)
        found["cohesion"] = (rng.choice([0.0, weak * power(rng, -4, 1)]),)
        if rng.random() < 0.5:
            found["dilation_angle"] = phi * rng.choice([0.3, 1.0])
        if phi == 0 and found["cohesion"] == (0.0,):
            found["cohesion"] = (1.0,)
    if model == "slip_weakening":
        found["friction"] = (rng.uniform(0.05, 1.5), rng.uniform(0, 0.05))
        found["critical_slip"] = power(rng, -6, 1)
        found["thickness"] = power(rng, -2, 1)
    return found


def method(rng):
    """Any way of stepping: (seismic settings, kind of base)."""
    transfer = rng.choice(["flip", "apic"])
    seismic = {"transfer": transfer, "inertia": rng.choice(["lumped", "consistent"]), "rest_below": rng.choice(["0 m/s", "1 mm/s", "10 m/s"]),
               "leaving": rng.choice(["remove", "stop"])}
    if transfer == "flip":
        seismic["filter"] = {"time": f"{power(rng, -4, 2)!r} s", "strain": rng.choice([0, 0.001, 0.1])}
    base = rng.choice(["compliant", "compliant", "compliant", "fixed"])
    if base == "compliant":
        seismic["base"] = {"spring": rng.choice(["auto", "none", f"{power(rng, -3, 1)!r} s"])}
    return seismic, base


def draw(number):
    """Settings of a draw (cases.build) by its number."""
    rng = random.Random(SEED * 100003 + number)
    h = rng.choice([1.0, power(rng, -3, 3)])
    g = rng.choice([0.0, 0.0, 9.81, power(rng, -4, 3)])
    soil = law(rng, 2000 * max(g, 1.0) * h * 5)
    rock = rng.choice([ROCK, {**SOIL, "density": power(rng, 2.5, 4), "young_modulus": power(rng, 5, 11)}])
    width = rng.choice([6, 8, 12])
    seismic, base = method(rng)
    zone = rng.random() < 0.3
    fall = rng.choice([0, 0, 0.5, 1]) if not zone else 0
    block = rng.choice([None, None, (1, 2), (2, width - 2)])
    sides = rng.choice(["free_field", "quiet", "roller"]) if not (fall or block) else rng.choice(["quiet", "roller"])
    contrast = p_speed(rock) / p_speed(soil)
    static = {"masses": "physical" if 0.1 < contrast < 10 and not zone and rng.random() < 0.5 else "scaled",
              "damping": rng.choice([0.3, 0.5, 0.75, 0.99]), "until": {"unbalanced": 0.02, "kinetic": 1e-4}}
    return {
        "spoil": rng.choice(SPOILS) if rng.random() < 0.04 else None,
        "h": h, "n": rng.choice([1, 1, 2, 2, 3]), "courant": rng.choice([0.78, 0.5, rng.uniform(0.02, 0.78)]), "steps": rng.choice([50, 200, 300]),
        "width": width, "rock_cells": rng.choice([1, 2, 4]), "soil_cells": rng.choice([1, 3, 5]), "zone_cells": rng.choice([1, 3]) if zone else 0,
        "zone": {**law(rng, 1e5)} if zone else None, "block": block,
        "rock": rock, "soil": soil, "slope": fall, "gravity": g,
        "pga": power(rng, -3, 2.7), "base_speed": rng.choice([0.0, 0.0, rng.uniform(0, 1) * 0.05 * p_speed(rock)]),
        "seismic": seismic, "sides": sides, "base": base, "frames": rng.choice([1, 3]),
        "grid": {"softening": rng.choice(["averaged", "local"]), "volume_average": rng.choice(["none", "cell"]),
                 "interfaces": rng.choice(["averaged", "sharp"])},
        "static": static if g > 0 else {},
    }


def weakening(rng, found):
    """A law that softens wherever it can, by all that a state remembers of it."""
    if found["model"] == "von_mises" and "softening" in found:
        found["softening"] = rng.choice([found["softening"], {"displacement": power(rng, -1, 0)}])
        found["strength"]["residual"] = found["strength"]["peak"] * rng.uniform(0.5, 1)
    if found["model"] == "mohr_coulomb" and rng.random() < 0.7:
        found["friction_angle"] += (found["friction_angle"][0] * rng.random(),)
        found["cohesion"] += (found["cohesion"][0] * rng.random(),)
        found["softening"] = {"displacement": power(rng, -2, 0), "band_cells": rng.choice([3, 4])}
        found["tension_cutoff"] = found["cohesion"][0] * rng.random()
    if found["model"] == "slip_weakening":
        found["match"] = rng.choice(["mc", "plane"])
    return found


def draw_to_stop(number):
    """Settings of a draw whose ground mostly stands and then moves, for runs that are stopped and go on: test/scripts/check_continue.py."""
    rng = random.Random(SEED * 100019 + number)
    common = {"density": rng.uniform(1500, 2300), "young_modulus": power(rng, 6, 8), "poisson_ratio": rng.uniform(0.1, 0.45)}
    zone, width = rng.random() < 0.3, rng.choice([8, 12])
    seismic, base = method(rng)
    end = rng.choice(["never", "self_driven", f"{rng.uniform(0.1, 2)!r} s"])
    if base == "compliant":
        seismic["motion"] = {"end": end}
    fall = 0 if zone else rng.choice([0, 0.5, 1, 2])
    static = {"masses": rng.choice(["physical", "scaled"]), "damping": rng.choice([0.5, 0.75]), "until": {"unbalanced": 0.02, "kinetic": 1e-4}}
    gravity = rng.choice([0.0, 9.81, 9.81, 9.81])
    return {
        "n": rng.choice([1, 2, 2, 3]), "courant": rng.choice([0.78, 0.5, 0.2]), "steps": rng.choice([50, 200, 400]), "width": width,
        "rock_cells": rng.choice([1, 3]), "soil_cells": rng.choice([3, 5]), "zone_cells": 2 if zone else 0,
        "zone": weakening(rng, law(rng, 1e5, {**common, "young_modulus": power(rng, 6, 8)})) if zone else None,
        "rock": {**ROCK, "young_modulus": power(rng, 7, 8.5)}, "soil": weakening(rng, law(rng, 1e5, common)), "slope": fall, "gravity": gravity,
        "pga": power(rng, -1, 2), "base_speed": rng.choice([0.0, 0.0, rng.uniform(0, 3)]), "vertical": rng.choice([0.0, 0.0, 0.5]),
        "seismic": seismic, "sides": rng.choice(["quiet", "roller"] if fall else ["free_field", "free_field", "quiet", "roller"]), "base": base,
        "frames": rng.choice([1, 3]), "gauges": rng.random() < 0.7,
        "output": {"checkpoint": {"every": rng.choice(["1 ms", "1 h"]), "keep": rng.choice([1, 2, 3])},
                   "slide": {"moved": rng.choice(["1 m", "1 cm"]), "area": "1 m2"}},
        "grid": {"softening": rng.choice(["averaged", "local"]), "volume_average": rng.choice(["none", "cell"]),
                 "interfaces": rng.choice(["averaged", "sharp"])},
        "static": static if gravity > 0 else {},
    }
