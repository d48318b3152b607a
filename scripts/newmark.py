"""A rigid-block (Newmark) analysis beside a run: scripts/newmark RUN_FOLDER [options].

The block is shaken by the outcrop motion as the run applied it (twice the upgoing velocity of history.h5).
Without --angle it is the ground above the circular slip surface of least yield acceleration, which is sought in the
run's undeformed ground with its von Mises strengths (shear strength q / sqrt 3); the block turns on the circle as a rigid
body, and its strength falls with slip as the case says. With --angle it is a block on a plane of that inclination.
Results go to RUN_FOLDER/newmark.json, where plot-run finds them, and to pictures/newmark.png.
"""
import json
import sys
from dataclasses import asdict
from pathlib import Path

import h5py
import matplotlib.pyplot as plt
import numpy as np
from scipy.spatial import cKDTree

import plot_common
import rigid_block
import slip_circle
import spectrum
from options import Parser
from plot_common import Missing, array, group_of, open_history
from plot_histories import read_motion, read_outline

UNITS = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "kg/m3": 1.0, "g/cm3": 1e3, "t/m3": 1e3, "m": 1.0, "cm": 1e-2,
         "mm": 1e-3, "km": 1e3}
DEPARTED = 0.1  # m, beyond which a run counts ground as out of place


def parse_arguments():
    """The command line."""
    parser = Parser(prog="newmark", description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, metavar="RUN_FOLDER", help="output folder of mpm-seismic")
    parser.add_argument("--angle", type=float, metavar="DEG", help="inclination of a plane; default: a slip circle")
    parser.add_argument("--uphill", choices=("left", "right"), default="left", help="of the plane; default left")
    parser.add_argument("--yield", dest="yields", type=float, metavar="G", help="yield acceleration in g, for --angle")
    parser.add_argument("--friction", type=float, metavar="MU", help="coefficient of friction, for --angle")
    parser.add_argument("--residual", type=float, metavar="MU", help="friction after the slip of --slip")
    parser.add_argument("--slip", type=float, metavar="M", help="slip (m) over which it weakens")
    parser.add_argument("--weakening", choices=("exponential", "linear"), default="exponential",
                        help="exponential leaves 5 %% of the drop at --slip (default)")
    given = parser.parse_args()
    if given.angle is not None and (given.yields is None) == (given.friction is None):
        parser.error("--angle needs either --yield or --friction")
    if given.angle is None and (given.yields is not None or given.friction is not None):
        parser.error("--yield and --friction need --angle")
    if (given.residual is None) != (given.slip is None) or (given.slip is not None and given.friction is None):
        parser.error("--residual and --slip go together, and with --friction")
    return given


def outcrop(folder):
    """Times (s) and outcrop acceleration [time, (x, y)] (m/s2) as applied."""
    with open_history(folder) as file:
        time, velocity = read_motion(file)
    parts = [spectrum.acceleration_of(time, 2.0 * velocity[:, k]) for k in range(velocity.shape[1])]
    step = parts[0][1]
    return time[0] + step * np.arange(len(parts[0][0])), np.stack([part[0] for part in parts], axis=1)


def settings_of(folder):
    """The run's settings by key path."""
    return json.loads((folder / "identity.json").read_text())


def quantity(settings, key):
    """A setting in SI, None where it is not given."""
    if key not in settings:
        return None
    number, unit = settings[key].split()
    return float(number) * UNITS[unit]


def strengths(settings, name):
    """Peak and residual shear strength (Pa) of a material, and the slip (m) between them; infinite where elastic."""
    key = f"materials.{name}"
    if settings[f"{key}.model"] == "elastic":
        return np.inf, np.inf, np.inf
    if settings[f"{key}.model"] != "von_mises":
        raise Missing(f"{key}.model is {settings[f'{key}.model']}: a slip circle is sought in von_mises ground only; "
                      "give --angle and --friction")
    peak = quantity(settings, f"{key}.strength.peak") / np.sqrt(3)
    residual = (quantity(settings, f"{key}.strength.residual") or np.sqrt(3) * peak) / np.sqrt(3)
    slip = quantity(settings, f"{key}.softening.displacement")
    if residual < peak and slip is None:
        raise Missing(f"{key}.softening gives no displacement; give --angle and --friction")
    return peak, residual, slip or np.inf


def ground_of(folder):
    """The undeformed ground as a raster with its peak strengths; the residual ones, and the shortest slip (m)."""
    path = folder / "final.h5"
    if not path.exists():
        raise Missing("no final.h5: the run is not finished")
    settings = settings_of(folder)
    with open_history(folder) as file:
        x, surface, _ = read_outline(file)
    size = x[1] - x[0]
    with h5py.File(path, "r") as file:
        position = array(file, "particles/reference")[:, :2]
        groups = [file[f"materials/{n}"].attrs for n in file["materials"]]
        names = [a["material"].decode() if isinstance(a["material"], bytes) else a["material"] for a in groups]
        parts = [slice(int(a["begin"]), int(a["end"])) for a in groups]
    bottom = position[:, 1].min() - 0.5 * size
    middles = bottom + size * (np.arange(int(np.ceil((np.nanmax(surface) - bottom) / size))) + 0.5)
    nearest = cKDTree(position).query(np.stack(np.meshgrid(x, middles, indexing="ij"), axis=-1))[1]
    density, peak, residual = (np.empty(len(position)) for _ in range(3))
    slip = np.inf
    for name, part in zip(names, parts):
        density[part] = quantity(settings, f"materials.{name}.density")
        peak[part], residual[part], length = strengths(settings, name)
        slip = min(slip, length)
    return slip_circle.Ground(x, surface, bottom, size, density[nearest], peak[nearest]), residual[nearest], slip


def block_on_circle(folder):
    """The ground above the weakest circle as a block; the circle; which way it slides."""
    ground, residual, slip = ground_of(folder)
    found = [circle for circle in (slip_circle.weakest(ground, sense) for sense in (1, -1)) if circle]
    if not found:
        raise Missing("no slip circle cuts a slide out of this ground; give --angle")
    circle = min(found, key=lambda c: c.yield_acceleration)
    circle.residual = slip_circle.cut(ground, circle.x, circle.y, circle.radius, circle.sense, residual).resistance
    inertia = turning_inertia(ground, circle)
    arm = np.hypot(circle.offset, circle.depth)
    gain = circle.radius * arm * circle.mass / inertia
    peak, last = (circle.radius**2 * force / inertia for force in (circle.resistance, circle.residual))
    strength = rigid_block.linear(peak, last, slip) if last < peak else rigid_block.constant(peak)
    block = rigid_block.Block(np.arctan2(circle.offset, circle.depth), resistance=strength, gain=gain,
                              radius=circle.radius)
    return block, circle, circle.sense


def turning_inertia(ground, circle):
    """Moment of inertia (kg m2/m) about the centre of what the circle cuts off."""
    y = ground.bottom + ground.size * (np.arange(ground.density.shape[1]) + 0.5)
    squared = (ground.x[:, None] - circle.x) ** 2 + (y - circle.y) ** 2
    within = (ground.x >= circle.ends[0]) & (ground.x <= circle.ends[1])
    inside = within[:, None] & (squared < circle.radius**2) & (y < ground.surface[:, None])
    return (ground.density * ground.size**2 * squared)[inside].sum()


def block_on_plane(given):
    """The block that the command line describes."""
    angle = np.radians(given.angle)
    if given.yields is not None:
        return rigid_block.Block(angle, rigid_block.constant(np.tan(angle + np.arctan(given.yields))))
    if given.slip is None:
        return rigid_block.Block(angle, rigid_block.constant(given.friction))
    return rigid_block.Block(angle, getattr(rigid_block, given.weakening)(given.friction, given.residual, given.slip))


def first(time, reached):
    """The first time at which something holds, None if it never does."""
    return float(time[np.argmax(reached)]) if np.any(reached) else None


def analyse(folder, block, sense, words, circle=None):
    """Shakes the block; the results as they are stored."""
    time, ground = outcrop(folder)
    slip, speed = rigid_block.slide(block, time, ground * [sense, 1.0])
    path = np.unique(slip)
    least = min(block.yield_acceleration(d) for d in path[::max(1, len(path) // 200)])
    every = max(1, round(0.05 / (time[1] - time[0])))
    return {"block": words, "yield_acceleration": block.yield_acceleration() / rigid_block.GRAVITY,
            "least_yield_acceleration": least / rigid_block.GRAVITY,
            "first_slip": first(time, slip > 0), "trigger_time": first(time, slip > DEPARTED),
            "displacement": float(slip[-1]), "greatest_velocity": float(speed.max()),
            "circle": asdict(circle) | {"safety": circle.safety} if circle else None,
            "time": time[::every].tolist(), "slip": slip[::every].tolist()}


def estimate(folder):
    """The analysis of the weakest slip circle."""
    block, circle, sense = block_on_circle(folder)
    words = (f"slip circle about ({circle.x:.1f}, {circle.y:.1f}) m, radius {circle.radius:.1f} m, "
             f"{circle.mass / 1e3:.0f} t/m, factor of safety {circle.safety:.2f} at peak strength")
    return analyse(folder, block, sense, words, circle)


def stored_or_estimated(folder):
    """newmark.json of the folder, or the estimate where there is none."""
    path = folder / "newmark.json"
    return json.loads(path.read_text()) if path.exists() else estimate(folder)


def lines_of(result):
    """The results in words."""
    time = lambda t: "never" if t is None else f"{t:.2f} s"
    return [result["block"],
            f"yield acceleration {result['yield_acceleration']:.3f} g, at least {result['least_yield_acceleration']:.3f} g "
            "as it slides" + (": there it goes by itself" if result["least_yield_acceleration"] < 0 else ""),
            f"slips first at {time(result['first_slip'])}, passes {DEPARTED} m at {time(result['trigger_time'])}",
            f"displacement {result['displacement']:.3f} m, greatest velocity {result['greatest_velocity']:.2f} m/s"]


def draw(axis, folder, result):
    """Slip of the block beside the displacement of the run's moved ground and gauges (m)."""
    axis.plot(result["time"], result["slip"], "k", lw=1.2, label="rigid block")
    with open_history(folder) as file:
        slide = group_of(file, "slide")
        moved = np.linalg.norm(array(slide, "centre_of_mass_displacement"), axis=1)
        axis.plot(array(slide, "time"), np.where(moved > 0, moved, np.nan), "C2", lw=1.2, label="moved ground")
    axis.set_title("rigid block (Newmark) beside the run: displacement (m)")
    axis.legend(fontsize=6)
    axis.grid(alpha=0.3)


def main():
    """Analyses, stores, draws, prints; returns the exit code."""
    given = parse_arguments()
    try:
        if given.angle is None:
            result = estimate(given.folder)
        else:
            words = f"block on a plane of {given.angle:g} degrees, uphill on the {given.uphill}"
            result = analyse(given.folder, block_on_plane(given), 1 if given.uphill == "left" else -1, words)
        (given.folder / "newmark.json").write_text(json.dumps(result, indent=1) + "\n")
        print("\n".join(lines_of(result)))
        (given.folder / "pictures").mkdir(exist_ok=True)
        figure, axis = plt.subplots(figsize=(plot_common.WIDTH, 4.5), layout="constrained")
        draw(axis, given.folder, result)
        axis.set_xlabel("time (s)")
        heading = plot_common.heading_of(given.folder, plot_common.read_summary(given.folder))
        plot_common.save(figure, given.folder / "pictures" / "newmark.png", heading)
    except (Missing, OSError) as reason:
        print(f"newmark: {given.folder}: {reason}", file=sys.stderr)
        return 66
    return 0


if __name__ == "__main__":
    sys.exit(main())
