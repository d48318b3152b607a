"""A rigid-block (Newmark) analysis beside a run: scripts/newmark RUN_FOLDER [options].

The block is shaken by the outcrop motion as the run applied it (twice the upgoing acceleration of history.h5, at the step of
the record), under the gravity of the run's case.
Without --angle it is the ground above the circular slip surface of least yield acceleration, which is sought in the
run's undeformed ground with its von Mises strengths (shear strength q / sqrt 3); the block turns on the circle as a rigid
body, and its strength falls with slip as the case says. With --angle it is a block on a plane of that inclination, whose friction
is given or, with --material, is what a slip_weakening material of the case mobilises.
Results go to RUN_FOLDER/newmark.json, where plot-run finds them, and to pictures/newmark.png.
"""
import hashlib
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
from options import Parser
from plot_common import Missing, array, group_of, open_history
from plot_histories import read_motion, read_outline
from settings import quantity, settings_of
from whole_file import write_whole

USUAL_GRAVITY = "9.81 m/s2"  # of a case that says none
DEPARTED = 0.1  # m, beyond which a run counts ground as out of place


def parse_arguments():
    """The command line."""
    parser = Parser(prog="newmark", description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, metavar="RUN_FOLDER", help="output folder of mpm-seismic")
    parser.add_argument("--angle", type=float, metavar="DEG", help="inclination of a plane; default: a slip circle")
    parser.add_argument("--uphill", choices=("left", "right"), default="left", help="of the plane; default left")
    parser.add_argument("--yield", dest="yields", type=float, metavar="G", help="yield acceleration in g, for --angle")
    parser.add_argument("--friction", type=float, metavar="MU", help="coefficient of friction, for --angle")
    parser.add_argument("--material", metavar="NAME",
                        help="slip_weakening material of the case, instead of --friction, --residual and --slip")
    parser.add_argument("--residual", type=float, metavar="MU", help="friction after the slip of --slip")
    parser.add_argument("--slip", type=float, metavar="M", help="slip (m) over which it weakens")
    parser.add_argument("--weakening", choices=("exponential", "linear"), default="exponential",
                        help="exponential leaves 5 %% of the drop at --slip (default)")
    given = parser.parse_args()
    strengths_given = sum(part is not None for part in (given.yields, given.friction, given.material))
    if given.angle is not None and strengths_given != 1:
        parser.error("--angle needs one of --yield, --friction and --material")
    if given.angle is None and strengths_given:
        parser.error("--yield, --friction and --material need --angle")
    if (given.residual is None) != (given.slip is None) or (given.slip is not None and given.friction is None):
        parser.error("--residual and --slip go together, and with --friction")
    return given


def outcrop(folder):
    """Times (s) and outcrop acceleration [time, (x, y)] (m/s2) as applied."""
    with open_history(folder) as file:
        time, _, acceleration = read_motion(file)
    return time, 2.0 * acceleration


def run_of(folder):
    """What tells the run in the folder, as far as it has come, from another one that may have been there before."""
    with open_history(folder) as file:
        until = float(read_motion(file)[0][-1])
    return {"identity": hashlib.sha256((folder / "identity.json").read_bytes()).hexdigest(), "until": until}


def gravity_of(settings):
    """The gravity of the run (m/s2)."""
    gravity = quantity({"static.gravity": USUAL_GRAVITY} | settings, "static.gravity")
    if gravity <= 0:
        raise Missing("static.gravity is 0: a block without weight has no friction and does not slide")
    return gravity


def strengths(settings, name):
    """Peak and residual shear strength (Pa) of a material, and the slip (m) between them; infinite where elastic."""
    key = f"materials.{name}"
    if settings[f"{key}.model"] == "elastic":
        return np.inf, np.inf, np.inf
    if settings[f"{key}.model"] != "von_mises":
        raise Missing(f"{key}.model is {settings[f'{key}.model']}: a slip circle is sought in von_mises ground only; "
                      "give --angle and --friction")
    peak = quantity(settings, f"{key}.strength.peak") / np.sqrt(3)
    residual = quantity(settings, f"{key}.strength.residual")
    residual = peak if residual is None else residual / np.sqrt(3)
    slip = quantity(settings, f"{key}.softening.displacement")
    if residual < peak and slip is None:
        raise Missing(f"{key}.softening gives no displacement; give --angle and --friction")
    return peak, residual, np.inf if slip is None else slip


def mobilised_friction(settings, name):
    """What a band of a slip_weakening material mobilises in simple shear, as a function of slip (m)."""
    key = f"materials.{name}"
    model = settings.get(f"{key}.model")
    if model != "slip_weakening":
        raise Missing(f"{key} is " + (f"of the model {model}" if model else "no material of the case") +
                      "; --material takes one of the model slip_weakening")
    peak, residual, slip = (quantity(settings, f"{key}.{part}")
                            for part in ("friction.peak", "friction.residual", "critical_slip"))
    if residual is None or residual >= peak:
        coefficient = rigid_block.constant(peak)
    else:
        coefficient = rigid_block.exponential(peak, residual, slip)
    if settings.get(f"{key}.match", "mc") == "plane":  # sin(phi) = mu
        return coefficient
    return lambda d: coefficient(d) / np.sqrt(1 + coefficient(d) ** 2)  # tan(phi) = mu, a band mobilises sin(phi)


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
        groups = sorted((file[f"materials/{n}"].attrs for n in file["materials"]),
                        key=lambda a: (int(a["begin"]), int(a["end"])))
        names = [a["material"].decode() if isinstance(a["material"], bytes) else a["material"] for a in groups]
        parts = [np.arange(int(a["begin"]), int(a["end"])) for a in groups]
        if "departed" in file:  # ground that has left the model by now was there
            gone = file["departed"]
            owner = gone["material"][...]
            parts = [np.append(part, len(position) + np.flatnonzero(owner == k)) for k, part in enumerate(parts)]
            position = np.concatenate([position, np.stack([gone["reference_x"], gone["reference_y"]], axis=1)])
    bottom = position[:, 1].min() - 0.5 * size
    middles = bottom + size * (np.arange(int(np.ceil((np.nanmax(surface) - bottom) / size))) + 0.5)
    nearest = cKDTree(position).query(np.stack(np.meshgrid(x, middles, indexing="ij"), axis=-1))[1]
    density, peak, residual = (np.empty(len(position)) for _ in range(3))
    slip = np.inf
    for name, part in zip(names, parts):
        density[part] = quantity(settings, f"materials.{name}.density")
        peak[part], residual[part], length = strengths(settings, name)
        slip = min(slip, length)
    ground = slip_circle.Ground(x, surface, bottom, size, density[nearest], peak[nearest], gravity_of(settings))
    return ground, residual[nearest], slip


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
                              radius=circle.radius, gravity=ground.gravity)
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
    settings, angle = settings_of(given.folder), np.radians(given.angle)
    gravity = gravity_of(settings)
    if given.material is not None:
        friction = mobilised_friction(settings, given.material)
    elif given.yields is not None:
        yields = given.yields * rigid_block.STANDARD_GRAVITY / gravity
        friction = rigid_block.constant(np.tan(angle + np.arctan(yields)))
    elif given.slip is None:
        friction = rigid_block.constant(given.friction)
    else:
        friction = getattr(rigid_block, given.weakening)(given.friction, given.residual, given.slip)
    return rigid_block.Block(angle, friction, gravity=gravity)


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
    return {"block": words, "run": run_of(folder), "yield_acceleration": block.yield_acceleration() / rigid_block.STANDARD_GRAVITY,
            "least_yield_acceleration": least / rigid_block.STANDARD_GRAVITY,
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


def stored(folder):
    """newmark.json of the folder, None where there is none of this run."""
    path = folder / "newmark.json"
    if not path.exists():
        return None
    result = json.loads(path.read_text())
    if result.get("run") == run_of(folder):
        return result
    print(f"newmark: {path} is of another run, or of this one before it went on; it is left out: run scripts/newmark again",
          file=sys.stderr)
    return None


def stored_or_estimated(folder):
    """newmark.json of the folder, or the estimate where there is none of this run."""
    return stored(folder) or estimate(folder)


def lines_of(result):
    """The results in words."""
    return [result["block"],
            f"yield acceleration {result['yield_acceleration']:.3f} g, at least {result['least_yield_acceleration']:.3f} g "
            "as it slides" + (": there it goes by itself" if result["least_yield_acceleration"] < 0 else ""),
            "never slips" if result["first_slip"] is None else f"slips first at {result['first_slip']:.2f} s, " + (
                f"never passes {DEPARTED} m" if result["trigger_time"] is None else f"passes {DEPARTED} m at {result['trigger_time']:.2f} s"),
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
            words += f", friction of {given.material}" if given.material else ""
            result = analyse(given.folder, block_on_plane(given), 1 if given.uphill == "left" else -1, words)
        if not (given.folder / "final.h5").exists():
            print(f"newmark: {given.folder}: the run is not finished: this is the motion until t = {result['run']['until']:.2f} s",
                  file=sys.stderr)
        write_whole(given.folder / "newmark.json", json.dumps(result, indent=1) + "\n")
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
