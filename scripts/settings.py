"""The settings of a run by key path, as its identity.json has them, in SI."""
import json
import re

from plot_common import Missing

UNITS = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "kg/m3": 1.0, "g/cm3": 1e3, "t/m3": 1e3, "m": 1.0, "cm": 1e-2,
         "mm": 1e-3, "km": 1e3, "m/s2": 1.0, "cm/s2": 1e-2, "g": 9.80665, "s": 1.0, "rad": 1.0,
         "deg": 0.017453292519943295, "": 1.0}


def settings_of(folder):
    """The run's settings by key path."""
    return json.loads((folder / "identity.json").read_text())


def quantity(settings, key):
    """A setting in SI, None where it is not given."""
    if key not in settings:
        return None
    parts = re.fullmatch(r"([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)\s*(.*)", settings[key].strip())
    unit = parts and parts[2].replace("^", "")
    if not parts or unit not in UNITS:
        raise Missing(f"{key} in identity.json is '{settings[key]}', which is no number with a unit")
    return float(parts[1]) * UNITS[unit]


def names_below(settings, branch):
    """Names of the maps below a key path, as materials or output.gauges.points, in their order."""
    found = (re.match(re.escape(branch) + r"\.(.+?)(?:\.\w[\w.]*|\[\d\])$", key) for key in settings)
    return list(dict.fromkeys(match[1] for match in found if match))


def gauge_positions(settings):
    """x, y (m) of each gauge in the undeformed ground, by name."""
    points = "output.gauges.points"
    return {name: tuple(quantity(settings, f"{points}.{name}[{k}]") for k in range(2))
            for name in names_below(settings, points)}
