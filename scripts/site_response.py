"""Response of level ground, layered as a case is at one place: profiles with depth, and amplification.

    scripts/site-response CASE --out DIR [--at X] [--motion FILE] [--scale F] [--profile NAME] [--set KEY=VALUE]

The ground at X (default: the left side, where the case's free-field column is) is made a strip of level layers, eight cells wide,
between its two free-field columns, and shaken by both stages. Its surface follows the columns'; how closely is told.
Greatest acceleration, velocity, shear strain and shear stress with depth go to DIR/profile.csv; the ratio of the smoothed
Fourier transforms of surface and outcrop velocity, beside the closed form of elastic layers without damping (Kramer, S. L. (1996),
Geotechnical Earthquake Engineering, section 7.2.1), to DIR/amplification.csv; pictures of them, and response spectra, to
DIR/site-response.png. Repeated, the command goes on where it was interrupted.
"""
import argparse
import json
import sys
from pathlib import Path

import h5py
import matplotlib.pyplot as plt
import numpy as np

import soil_column
import spectrum
from options import Parser
from plot_common import Missing, array, group_of, open_history, read_summary, save, text
from plot_histories import read_gauges, read_motion
from programs import PROGRAMS
from resolved_case import Refused, first_state, number_and_unit, options_of, program, resolve, setting
from sweep_run import INTERRUPTED, Pool, reason_of
from whole_file import write_whole

CELLS = 8  # width of the strip
MOST_GAUGES = 60  # down the profile
BAND = 1.0 + 0.0125 * np.arange(-2, 3)  # about a frequency, over which spectra are smoothed: a record's have holes


def parse_arguments(given):
    """The command line."""
    parser = Parser(prog="site-response", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", type=Path)
    parser.add_argument("--out", type=Path, required=True, metavar="DIR")
    parser.add_argument("--at", type=float, metavar="X", help="where the layers are taken (m); default: the left side")
    parser.add_argument("--motion", metavar="FILE", help="record instead of the case's horizontal one")
    parser.add_argument("--scale", type=float, metavar="F", help="factor on the motion")
    parser.add_argument("--profile", default="", metavar="NAME")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--threads", default="", metavar="N")
    parser.add_argument("--programs", type=Path, default=PROGRAMS, metavar="DIR", help="their folder; default: of the build, or installed")
    return parser.parse_args(given)


def layers_at(state, x, bottom):
    """Layers [(top in m, material)] from below, of the column of particles nearest to x, to half a row."""
    with h5py.File(state, "r") as file:
        position = file["particles/reference"][...]
        owner = np.empty(len(position), dtype=object)
        for group in file["materials"].values():
            owner[int(group.attrs["begin"]):int(group.attrs["end"])] = text(group.attrs["material"])
    nearest = position[np.abs(position[:, 0] - x).argmin(), 0]
    rows = np.flatnonzero(np.abs(position[:, 0] - nearest) < 1e-6)
    rows = rows[np.argsort(position[rows, 1])]
    y = position[rows, 1]
    height = 2.0 * (y[0] - bottom)
    if len(y) < 2 or np.abs(np.diff(y) - height).max() > 1e-3 * height:
        raise Refused(65, f"at x = {x:g} m the ground is not whole from the base up; choose another place with --at")
    tops = [k for k in range(len(y)) if k + 1 == len(y) or owner[rows[k + 1]] != owner[rows[k]]]
    return [(float(y[k] + 0.5 * height), owner[rows[k]]) for k in tops]


def strip(case, layers, folder):
    """The case as a strip of level layers with gauges down its middle; and the gauges' heights (m) by name."""
    size = number_and_unit(case["grid"]["spacing"])[0]
    bottom, top = number_and_unit(case["domain"]["bottom"])[0], layers[-1][0]
    count = min(MOST_GAUGES, int(round((top - bottom) / size)) + 1)
    heights = {f"g{k:02d}": float(y) for k, y in enumerate(np.linspace(top, bottom, count))}
    made = {key: case[key] for key in ("schema", "grid", "static", "seismic", "time_step")}
    made["name"] = f"{case['name']}: level ground"
    made["domain"] = {"x": ["0 m", f"{CELLS * size:.10g} m"], "bottom": case["domain"]["bottom"]}
    made["surfaces"] = {f"level_{k}": {"points": [["0 m", f"{y:.10g} m"], [f"{CELLS * size:.10g} m", f"{y:.10g} m"]]}
                        for k, (y, _) in enumerate(layers)}
    made["regions"] = [{"material": name, "below": f"level_{k}"} | ({"above": f"level_{k - 1}"} if k else {})
                       for k, (_, name) in enumerate(layers)]
    made["materials"] = {name: case["materials"][name] for _, name in layers}
    points = {name: [f"{0.5 * CELLS * size:.10g} m", f"{y:.10g} m"] for name, y in heights.items()}
    made["output"] = {"frames": {"every": "1000000 s"}, "gauges": {"every": case["output"]["gauges"]["every"], "points": points}}
    for direction in ("horizontal", "vertical"):
        record = (made["seismic"].get("motion") or {}).get(direction)
        if isinstance(record, dict):
            record["file"] = str((folder / record["file"]).resolve())
    made["seismic"]["base"] = {"kind": made["seismic"]["base"]["kind"]}  # its spring is that of this ground
    if made["seismic"]["base"]["kind"] != "compliant" or "motion" not in made["seismic"]:
        raise Refused(65, "a level site is shaken through a compliant base: the case has none, or no seismic.motion")
    made["seismic"]["sides"] = {"kind": "free_field"}
    return made, heights


def shake(given, case, weightless):
    """Both stages of the strip; the folder of the second."""
    commands = [] if weightless else [["mpm-static", case, "--out", given.out / "static"]]
    commands.append(["mpm-seismic", case, "--out", given.out / "run"])
    if not weightless:
        commands[-1] += ["--from", given.out / "static" / "final.h5"]
    for option in ("motion", "scale"):
        if getattr(given, option) is not None:
            commands[-1] += [f"--{option}", getattr(given, option)]
    with Pool(given.threads) as pool:
        for name, *words in commands:
            folder = words[words.index("--out") + 1]
            code = pool.run(folder, [program(given.programs, name), *words, "--quiet"])
            if code:
                raise Refused(code, "interrupted; the same command goes on" if code == INTERRUPTED else f"{folder}: {reason_of(folder)}")
    return given.out / "run"


def speeds(case, layers):
    """Thickness (m), density (kg/m3) and shear-wave speed (m/s) of the layers from the top; of the last one as a half-space below."""
    bottom = number_and_unit(case["domain"]["bottom"])[0]
    found, below = [], bottom
    for top, name in layers:
        material = case["materials"][name]
        density = number_and_unit(material["density"])[0]
        modulus = number_and_unit(material["young_modulus"])[0] / (2.0 * (1.0 + float(material["poisson_ratio"])))
        found.append((top - below, density, np.sqrt(modulus / density)))
        below = top
    return found[::-1]


def closed_form(layers, frequency):
    """|surface / outcrop| of elastic layers (thickness, density, speed), the last a half-space."""
    return 1.0 / np.abs(soil_column.waves(layers, frequency)[-1][0])


def transforms(frequency, dt, *histories):
    """Magnitudes of the Fourier transforms of histories (m/s) with step dt (s), their squares averaged over 5 % of the frequency."""
    time, found = dt * np.arange(len(histories[0])), np.zeros((len(histories), len(frequency)))
    for share in BAND:
        turns = np.exp(-2j * np.pi * np.outer(share * frequency, time))
        found += np.abs(turns @ np.stack(histories, axis=1)).T ** 2
    return dt * np.sqrt(found / len(BAND))


def measure(folder, heights, case, layers):
    """The profile {name: array from the top}, times, velocities of surface and outcrop (m/s), and how far the surface is off its column."""
    with open_history(folder) as file:
        time, names, fields = read_gauges(file)
        order = [names.index(name) for name in heights]
        displacement, velocity = fields["displacement"][:, order, 0], fields["velocity"][:, order, 0]
        acceleration = group_of(file, "gauges")["acceleration"][:, order, 0]
        motion_time, upgoing, _ = read_motion(file)
        column = array(file["free_field/left"], "surface_velocity")[:, 0]
        outcrop = 2.0 * np.interp(time, motion_time, upgoing[:, 0])
    y = np.array(list(heights.values()))
    tops = np.array([top for top, _ in layers])
    owner = [layers[int(np.searchsorted(tops, value - 1e-9))][1] for value in 0.5 * (y[1:] + y[:-1])]
    density = np.array([number_and_unit(case["materials"][name]["density"])[0] for name in owner])
    lengths = -np.diff(y)
    strain = (displacement[:, :-1] - displacement[:, 1:]) / lengths
    # Equilibrium from the surface down: what lies above a height is accelerated by the stress there.
    stress = np.cumsum(density * lengths * 0.5 * (acceleration[:, 1:] + acceleration[:, :-1]), axis=1)
    greatest = lambda values: np.abs(values).max(axis=0)
    profile = {"depth": y[0] - y, "acceleration": greatest(acceleration) / spectrum.GRAVITY, "velocity": greatest(velocity),
               "middle": y[0] - 0.5 * (y[1:] + y[:-1]), "strain": greatest(strain), "stress_depth": (y[0] - y)[1:],
               "stress": greatest(stress), "material": owner}
    off = float(np.abs(velocity[:, 0] - column).max() / np.abs(column).max())
    return profile, time, velocity[:, 0], outcrop, off


def write_tables(out, profile, frequency, model, form):
    """profile.csv and amplification.csv."""
    lines = ["depth (m),greatest acceleration (g),greatest velocity (m/s),depth of the strain (m),greatest shear strain,"
             "depth of the stress (m),greatest shear stress (Pa),material"]
    for k in range(len(profile["depth"])):
        below = [f"{profile[name][k]:.6g}" for name in ("middle", "strain", "stress_depth", "stress")] + [profile["material"][k]] \
            if k < len(profile["middle"]) else [""] * 5
        lines.append(",".join([f"{profile[name][k]:.6g}" for name in ("depth", "acceleration", "velocity")] + below))
    (out / "profile.csv").write_text("\n".join(lines) + "\n")
    lines = ["frequency (Hz),surface / outcrop,closed form of elastic layers"]
    lines += [f"{f:.6g},{m:.6g},{c:.6g}" for f, m, c in zip(frequency, model, form)]
    (out / "amplification.csv").write_text("\n".join(lines) + "\n")


def draw(out, profile, frequency, model, form, motions):
    """site-response.png: three profiles above, amplification and response spectra below."""
    figure = plt.figure(figsize=(10.0, 8.0), layout="constrained")
    upper, lower = figure.subfigures(2, 1, height_ratios=(1.15, 1.0))
    axes = upper.subplots(1, 3, sharey=True)
    for axis, values, depth, words in zip(axes, ("acceleration", "strain", "stress"), ("depth", "middle", "stress_depth"),
                                          ("greatest acceleration (g)", "greatest shear strain (%)", "greatest shear stress (kPa)")):
        axis.plot({"acceleration": 1, "strain": 100, "stress": 1e-3}[values] * profile[values], profile[depth], "o-", ms=2.5, lw=1.2, color="#0072B2")
        axis.set_xlabel(words)
        axis.set_xlim(left=0.0)
        axis.grid(alpha=0.3)
    changes = [k for k in range(1, len(profile["material"])) if profile["material"][k] != profile["material"][k - 1]]
    for axis in axes:
        for k in changes:
            axis.axhline(profile["depth"][k], color="0.4", lw=0.8, ls="--")
    axes[0].set_ylim(profile["depth"][-1], 0.0)
    axes[0].set_ylabel("depth (m)")
    left, right = lower.subplots(1, 2)
    left.plot(frequency, form, color="0.5", lw=2.0, label="elastic layers, closed form")
    left.plot(frequency, model, color="#0072B2", lw=1.0, label="this run")
    left.set_xlabel("frequency (Hz)")
    left.set_ylabel("surface / outcrop")
    left.set_ylim(0.0, 1.15 * max(form.max(), 1.0))
    periods = spectrum.default_periods(100)
    for (name, (acceleration, dt)), style in zip(motions.items(), ({"color": "#0072B2", "lw": 1.2}, {"color": "k", "lw": 1.2, "ls": "--"})):
        shown = periods[periods >= 4.0 * dt]
        right.semilogx(shown, spectrum.pseudo_acceleration(acceleration, dt, shown) / spectrum.GRAVITY, label=name, **style)
    right.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    right.set_xlabel("period (s)")
    right.set_ylabel("5 % Sa (g)")
    right.set_ylim(bottom=0.0)
    for axis in (left, right):
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    save(figure, out / "site-response.png", "Level ground: site response")


def respond(given):
    """All of it."""
    own = options_of(given.profile, dict(setting(assignment) for assignment in given.set))
    case = resolve(given.programs, given.case, own)
    state = first_state(given.programs, given.case, case, own, given.out / "outline")
    x = number_and_unit(case["domain"]["x"][0])[0] if given.at is None else given.at
    layers = layers_at(state, x, number_and_unit(case["domain"]["bottom"])[0])
    made, heights = strip(case, layers, given.case.resolve().parent)
    path = given.out / "case.yaml"
    words = json.dumps(made, indent=1) + "\n"  # which is YAML too
    if path.exists() and path.read_text() != words:
        raise Refused(73, f"{given.out} holds the response of another case or place; give another --out")
    write_whole(path, words)
    folder = shake(given, path, number_and_unit(case["static"]["gravity"])[0] == 0.0)
    profile, time, surface, outcrop, off = measure(folder, heights, case, layers)
    materials = read_summary(folder)["resolution"]["materials"].values()
    carried = min(material["S"]["carried_to"] for material in materials if "S" in material)
    frequency = np.linspace(0.1, min(carried, 25.0), 250)
    top, below = transforms(frequency, time[1] - time[0], surface, outcrop)
    model = np.where(below > 1e-3 * below.max(), top / np.maximum(below, 1e-300), np.nan)  # where the motion has anything
    form = np.sqrt(np.mean([closed_form(speeds(case, layers), share * frequency) ** 2 for share in BAND], axis=0))  # smoothed alike
    write_tables(given.out, profile, frequency, model, form)
    motions = {name: spectrum.acceleration_of(time, velocity) for name, velocity in (("surface", surface), ("outcrop", outcrop))}
    draw(given.out, profile, frequency, model, form, motions)
    peak = int(np.nanargmax(model))
    print(f"{len(layers)} layers at x = {x:g} m, {profile['depth'][-1]:g} m deep; surface {profile['acceleration'][0]:.3f} g and "
          f"{profile['velocity'][0]:.3f} m/s, outcrop {np.abs(motions['outcrop'][0]).max() / spectrum.GRAVITY:.3f} g and "
          f"{np.abs(outcrop).max():.3f} m/s")
    print(f"greatest shear strain {100 * profile['strain'].max():.3g} % at {profile['middle'][profile['strain'].argmax()]:.1f} m; "
          f"amplification {model[peak]:.2f} at {frequency[peak]:.2f} Hz, of elastic layers {form.max():.2f} at "
          f"{frequency[form.argmax()]:.2f} Hz; up to {frequency[-1]:.1f} Hz, which the grid carries")
    print(f"the strip's surface differs from its free-field column's by {100 * off:.2g} % of the greatest velocity")


def main():
    """Responds to the command line; returns the exit code."""
    given = parse_arguments(sys.argv[1:])
    try:
        respond(given)
        return 0
    except (Refused, Missing, OSError) as reason:
        print(f"site-response: {reason}", file=sys.stderr)
        return getattr(reason, "code", 74 if isinstance(reason, OSError) else 66)


if __name__ == "__main__":
    sys.exit(main())
