"""Small cases for the atlas: ground of a few cells that a pulse enters, as the programs read them.

Lengths are given in cells and times in steps, so that a case keeps its shape whatever its size and stiffness are.
"""
import copy
import json
import math

ROCK = {"model": "elastic", "density": 2200.0, "young_modulus": 250e6, "poisson_ratio": 0.25}
SOIL = {"model": "elastic", "density": 1800.0, "young_modulus": 40e6, "poisson_ratio": 0.3}
UNITS = {"density": "kg/m3", "young_modulus": "Pa", "peak": "Pa", "residual": "Pa", "displacement": "m", "tension_cutoff": "Pa",
         "critical_slip": "m", "thickness": "m", "dilation_angle": "deg", "friction_angle": "deg", "cohesion": "Pa"}
PULSE_CELLS = 12  # length of the pulse in the softest ground: ten cells a wave are what the method asks for
STABLE = 0.78     # greatest Courant number of a case; beyond it the faulty programs lengthen the step

USUAL = {
    "h": 1.0, "n": 2, "courant": 0.5, "steps": 300, "width": 12, "rock_cells": 3, "soil_cells": 6, "block": None,
    "rock": ROCK, "soil": SOIL, "zone": None, "zone_cells": 0, "slope": 0, "gravity": 0.0, "pga": 1.0, "base_speed": 0.0,
    "seismic": {}, "grid": {}, "static": {}, "sides": "quiet", "base": "compliant", "frames": 1, "spoil": None,
    "vertical": 0.0, "gauges": False, "output": {},
}


def p_speed(law):
    """Speed of pressure waves of a material, m/s."""
    nu = law["poisson_ratio"]
    return math.sqrt(law["young_modulus"] * (1 - nu) / ((1 + nu) * (1 - 2 * nu) * law["density"]))


def s_speed(law):
    """Speed of shear waves of a material, m/s."""
    return math.sqrt(law["young_modulus"] / (2 * (1 + law["poisson_ratio"]) * law["density"]))


def material(law):
    """A material as the case file has it; pairs (peak, residual) become maps."""
    found = {}
    for key, value in law.items():
        if isinstance(value, tuple):
            unit = UNITS.get(key)
            names = ("peak", "residual")[:len(value)]
            found[key] = {name: f"{v!r} {unit}" if unit else v for name, v in zip(names, value)}
        elif key == "strength":
            found[key] = {name: f"{v!r} Pa" for name, v in value.items()}
        elif key == "softening":
            found[key] = {name: f"{v!r} m" if name == "displacement" else v for name, v in value.items()}
        else:
            found[key] = f"{value!r} {UNITS[key]}" if key in UNITS else value
    return found


def metres(value):
    """A length as text."""
    return f"{value!r} m"


def pulse(peak, period, duration, speed=0.0):
    """Acceleration in m/s2 of one sine under a Hann window, and its step; with `speed` the base is first set going to it."""
    dt = min(period, duration) / 40
    values = []
    for k in range(math.ceil(duration / dt) + 2):
        t = k * dt
        a = peak * math.sin(2 * math.pi * t / period) * math.sin(math.pi * t / period) ** 2 if t < period else 0.0
        rise = 0.25 * duration
        a += speed / rise * (1 - math.cos(2 * math.pi * t / rise)) if t < rise else 0.0
        values.append(a)
    return values, dt


def times(s):
    """Step and duration of a case, s."""
    fastest = max(p_speed(law) for law in (s["rock"], s["soil"], s["zone"]) if law)
    dt = min(s["courant"], STABLE) * s["h"] / fastest
    return dt, s["steps"] * dt


def build(**given):
    """{case, record, speed} for settings that differ from USUAL: two texts, and what motion and gravity can give the ground, m/s."""
    s = copy.deepcopy(USUAL)
    unknown = set(given) - set(s)
    assert not unknown, unknown
    s.update(given)
    h = s["h"]
    dt, duration = times(s)
    width, rock = s["width"] * h, s["rock_cells"] * h
    zone_top = rock + s["zone_cells"] * h
    top = zone_top + s["soil_cells"] * h
    surfaces = {"rockhead": {"points": [[metres(0.0), metres(rock)]]}, "top": {"points": [[metres(0.0), metres(top)]]}}
    if s["slope"]:  # falls by so many cells in the middle third
        low = top - s["slope"] * h
        surfaces["top"]["points"] = [[metres(0.0), metres(top)], [metres(width / 3), metres(top)], [metres(2 * width / 3), metres(low)],
                                     [metres(width), metres(low)]]
    soil = {"material": "soil", "above": "zone" if s["zone"] else "rockhead", "below": "top"}
    if s["block"]:
        soil["x"] = [metres(s["block"][0] * h), metres(s["block"][1] * h)]
    regions = [soil, {"material": "rock", "below": "rockhead"}]
    materials = {"rock": material(s["rock"]), "soil": material(s["soil"])}
    if s["zone"]:
        surfaces["zone"] = {"points": [[metres(0.0), metres(zone_top)]]}
        regions.insert(1, {"material": "zone", "above": "rockhead", "below": "zone"})
        materials["zone"] = material(s["zone"])
    slowest = min(s_speed(law) for law in (s["rock"], s["soil"], s["zone"]) if law)
    period = min(PULSE_CELLS * h / slowest, 0.5 * duration)
    record, step = pulse(s["pga"], period, duration, s["base_speed"])
    seismic = {"duration": f"{duration!r} s", "sides": {"kind": s["sides"]}, "base": {"kind": s["base"]}}
    if s["base"] == "compliant":
        seismic["motion"] = {"recorded_as": "upgoing", "baseline": "none", "taper": "0 s",
                             "horizontal": {"file": "shake.txt", "format": "column", "dt": f"{step!r} s", "unit": "m/s2"}}
        if s["vertical"]:  # the same motion, so many times as strong
            seismic["motion"]["vertical"] = {**seismic["motion"]["horizontal"], "scale": s["vertical"]}
    for key, value in s["seismic"].items():
        seismic[key] = {**seismic.get(key, {}), **value} if isinstance(value, dict) else value
    case = {
        "schema": "seismpm-case/1",
        "grid": {"spacing": metres(h), "particles_per_cell": s["n"], **s["grid"]},
        "domain": {"x": [metres(0.0), metres(width)], "bottom": metres(0.0)},
        "surfaces": surfaces, "regions": regions, "materials": materials,
        "static": {"gravity": f"{s['gravity']!r} m/s2"},
        "seismic": seismic,
        "time_step": {"courant_number": min(s["courant"], STABLE)},
        "output": {"gauges": {"every": f"{duration / 10!r} s"}, "frames": {"every": f"{duration / s['frames']!r} s"},
                   "checkpoint": {"every": "1 h"}, **s["output"]},
    }
    if s["gauges"]:  # in the ground, and on top of it
        case["output"]["gauges"]["points"] = {"middle": [metres(0.4 * width), metres(0.5 * top)], "surface": [metres(0.25 * width), metres(top)]}
    if s["gravity"] > 0:
        ramp = 10 * sum((s["rock_cells"], s["zone_cells"], s["soil_cells"])) * h / slowest
        until = {"unbalanced": 1e-4, "kinetic": 1e-7, "at_most": f"{8 * ramp!r} s", **s["static"].get("until", {})}
        case["static"] |= {"ramp": f"{ramp!r} s", **s["static"], "until": until}
    if s["spoil"]:  # a value that cannot be, in place of one that was there
        path, value = s["spoil"]
        at = case
        for key in path[:-1]:
            at = at[key]
        at[path[-1]] = value
    velocity = max(abs(sum(record[:k])) * step for k in range(len(record) + 1))
    return {"case": json.dumps(case, indent=1), "record": "\n".join(repr(a) for a in record) + "\n",
            "speed": velocity + math.sqrt(2 * s["gravity"] * top), "factor": max(1.0, s["courant"] / STABLE)}
