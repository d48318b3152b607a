"""Factor of safety of a slope under its own weight, by reducing all strengths until it does not stand.

    scripts/factor-of-safety CASE --out DIR [--profile NAME] [--set KEY=VALUE] [--tolerance 0.02] [--gone 0.01]

Every trial is a static stage with all strengths divided by a factor F: cohesion and tan(phi), peak and residual, the tension
cut-off where the case gives one, Mises stresses, friction coefficients (Zienkiewicz, O. C., Humpheson, C. and Lewis, R. W. (1975),
Geotechnique 25, 671-689). Ground stands when it settles and nothing has moved by --gone times its height from where it is with ten times its
strength. The factor of safety does not depend on the stiffness (Griffiths, D. V. and Lane, P. A. (1999), Geotechnique 49,
387-403), the displacement of ground that stands does: soft ground is made stiffer for the search, by a factor that is told.
Trials go to DIR/F-..., the result to DIR/factor-of-safety.json and .png. Repeated, the command goes on where it was stopped.
Exit code: that of the program where a trial could not be run.
"""
import argparse
import json
import sys
from math import atan, sqrt, tan
from pathlib import Path

import h5py
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter

from options import Parser
from plot_common import read_summary, save
from programs import PROGRAMS
from resolved_case import Refused, first_state, number_and_unit, options_of, program, resolve, setting
from sweep_run import INTERRUPTED, Pool, reason_of
from whole_file import write_whole

FIRM = 0.1  # the factor of the trial that displacements count from: hardly anything yields
STEP = 1.25  # of the factor while both ends are sought
FEWEST, MOST = 0.2, 20.0  # factors that are tried
SETTLEMENT = 5e-4  # of the height under its own weight, that ground has at most in the search; see cases/verification/slope
RAMP, AT_MOST = 10.0, 300.0  # times 4 D / c_p, the longest period of the ground's compression: static.ramp, static.until.at_most
UNBALANCED = 1e-5  # static.until.unbalanced


def parse_arguments(given):
    """The command line."""
    parser = Parser(prog="factor-of-safety", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", type=Path)
    parser.add_argument("--out", type=Path, required=True, metavar="DIR")
    parser.add_argument("--profile", default="", metavar="NAME")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--tolerance", type=float, default=0.02, metavar="F", help="width of the bracket at the end; default 0.02")
    parser.add_argument("--gone", type=float, default=0.01, metavar="SHARE",
                        help="of the ground's height, beyond which it has failed; default 0.01")
    parser.add_argument("--threads", default="", metavar="N")
    parser.add_argument("--programs", type=Path, default=PROGRAMS, metavar="DIR", help="their folder; default: of the build, or installed")
    arguments = parser.parse_args(given)
    if not (arguments.tolerance > 0.0 and arguments.gone > 0.0):
        parser.error("--tolerance and --gone are above 0")
    return arguments


def weakened(materials, factor):
    """Settings {key: value} that divide every strength of the case's materials by a factor."""
    settings = {}
    for name, material in materials.items():
        for group in ("strength", "cohesion", "friction", "friction_angle"):
            for part, value in (material.get(group) or {}).items():
                number, unit = number_and_unit(value)
                number = atan(tan(number) / factor) if group == "friction_angle" else number / factor  # rad
                settings[f"materials.{name}.{group}.{part}"] = f"{number:.12g} {unit}".strip()
        if "tension_cutoff" in material:
            number, unit = number_and_unit(material["tension_cutoff"])
            settings[f"materials.{name}.tension_cutoff"] = f"{number / factor:.12g} {unit}"
    return settings


def stiffened(case, depth, height):
    """Settings that keep the settlement under the ground's own weight small, times that go with it, and the factor on E."""
    gravity = number_and_unit(case["static"]["gravity"])[0]
    if gravity == 0.0:
        raise Refused(65, "static.gravity is 0: without weight every slope stands")
    moduli, softest = {}, np.inf
    for name, material in case["materials"].items():
        young, poisson = number_and_unit(material["young_modulus"])[0], float(material["poisson_ratio"])
        density = number_and_unit(material["density"])[0]
        moduli[name] = young
        softest = min(softest, young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)) / density)  # c_p squared
    factor = max(1.0, gravity * depth**2 / (2 * softest) / (SETTLEMENT * height))
    period = 4.0 * depth / sqrt(softest * factor)
    settings = {f"materials.{name}.young_modulus": f"{factor * young:.12g} Pa" for name, young in moduli.items()} if factor > 1.0 else {}
    return settings | {"static.ramp": f"{RAMP * period:.6g} s", "static.until.at_most": f"{AT_MOST * period:.6g} s",
                       "static.until.unbalanced": f"{UNBALANCED:g}"}, factor


def shape_of(state):
    """Depth (m) and height of the free surface (m) between its highest and lowest place, of an undeformed ground."""
    with h5py.File(state, "r") as file:
        x, y = file["particles/reference"][:, 0], file["particles/reference"][:, 1]
    edges = np.linspace(x.min(), x.max() + 1e-9, 101)
    tops = [y[chosen].max() for chosen in (np.digitize(x, edges) == k for k in range(1, 101)) if chosen.any()]
    return max(tops) - y.min(), max(tops) - min(tops)


class Search:
    """The trials of a case."""

    def __init__(self, given, pool):
        """Reads the case and finds the ground's shape and the state that displacements count from."""
        self.given, self.pool = given, pool
        self.own = dict(setting(assignment) for assignment in given.set)
        self.case = resolve(given.programs, given.case, options_of(given.profile, self.own))
        self.strong = [name for name, material in self.case["materials"].items() if material["model"] != "elastic"]
        if not self.strong:
            raise Refused(65, f"{given.case}: all materials are elastic, so nothing can fail")
        if not weakened(self.case["materials"], 1.0):
            raise Refused(65, f"{given.case}: no strength to reduce in {', '.join(self.strong)}")
        options = options_of(given.profile, self.own)
        depth, self.height = shape_of(first_state(given.programs, given.case, self.case, options, given.out / "outline"))
        if self.height <= 0.0:
            raise Refused(65, f"{given.case}: the ground is level; a factor of safety is of a slope")
        self.settings, self.factor = stiffened(self.case, depth, self.height)
        self.trials = []
        code, folder = self.run(FIRM)
        if code:
            raise Refused(code, f"{folder}: the ground does not settle with {1 / FIRM:g} times its strength")
        self.firm = self.positions(folder)

    def run(self, factor):
        """A trial that has ended: exit code 0 or 81, and its folder."""
        folder = self.given.out / f"F-{factor:.4f}"
        finished = (folder / "finished.json").exists()  # a summary of 0 alone may be that of a trial stopped after it
        code = 0 if finished else read_summary(folder).get("exit")
        if not finished and code != 81:
            settings = {**self.own, **self.settings, **weakened(self.case["materials"], factor)}
            code = self.pool.run(folder, [program(self.given.programs, "mpm-static"), self.given.case, "--out", folder, "--quiet",
                                          *options_of(self.given.profile, settings)])
        if code == INTERRUPTED:
            raise Refused(code, "interrupted; the same command goes on")
        if code not in (0, 81):
            raise Refused(code, f"{folder}: {reason_of(folder)}")
        return code, folder

    @staticmethod
    def positions(folder):
        """Positions [particle, (x, y)] (m) of a settled state, by the particles' ids."""
        with h5py.File(folder / "final.h5", "r") as file:
            return file["particles/position"][:, :2][np.argsort(file["particles/id"][...])]

    def stands(self, factor):
        """Tries a factor; whether the ground stands."""
        code, folder = self.run(factor)
        moved = None
        if code == 0:
            moved = float(np.linalg.norm(self.positions(folder) - self.firm, axis=1).max()) / self.height
        stands = bool(moved is not None and moved < self.given.gone)
        summary = read_summary(folder)
        self.trials.append({"factor": factor, "stands": stands, "settled": code == 0, "moved_over_height": moved,
                            "greatest_plastic_strain": summary.get("greatest_plastic_strain"), "folder": folder.name})
        print(f"F = {factor:.4f}: " + ("stands, " if stands else "fails, ") +
              ("does not settle" if moved is None else f"has moved {100 * moved:.2f} % of its height"), flush=True)
        return stands


def bracket(stands, tolerance):
    """The greatest factor tried at which it stands and the least at which it fails, tolerance apart; None where it never does."""
    low = high = None
    factor = 1.0
    while low is None or high is None:
        if not FEWEST <= factor <= MOST:
            return low, high
        if stands(factor):
            low, factor = factor, factor * STEP
        else:
            high, factor = factor, factor / STEP
    while high - low > tolerance:
        middle = 0.5 * (low + high)
        if stands(middle):
            low = middle
        else:
            high = middle
    return low, high


def draw(search, low, high, out):
    """Displacement of each trial that settled, against its factor."""
    figure, axis = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
    settled = [t for t in search.trials if t["settled"]]
    for colour, shape, words, chosen in (("#0072B2", "o", "stands", [t for t in settled if t["stands"]]),
                                         ("#D55E00", "s", "fails", [t for t in settled if not t["stands"]])):
        if chosen:
            axis.plot([t["factor"] for t in chosen], [max(100 * t["moved_over_height"], 1e-4) for t in chosen], shape, color=colour, label=words)
    restless = [t["factor"] for t in search.trials if not t["settled"]]
    if restless:
        axis.plot(restless, np.full(len(restless), 0.96), "x", color="k", transform=axis.get_xaxis_transform(), label="does not settle")
    if low and high:
        axis.axvspan(low, high, color="0.85", label=f"{low:.3f} to {high:.3f}")
    axis.axhline(100 * search.given.gone, color="0.4", lw=0.8, ls="--")
    axis.set_yscale("log")
    axis.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_xlabel("strengths divided by F")
    axis.set_ylabel("greatest displacement (% of height)")
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8)
    save(figure, out, "Factor of safety")


def find(given, pool):
    """Searches, stores, prints."""
    search = Search(given, pool)
    if search.factor > 1.0:
        print(f"the ground is made {search.factor:.3g} times as stiff for the search")
    low, high = bracket(search.stands, given.tolerance)
    found = 0.5 * (low + high) if low and high else None
    result = {"factor_of_safety": found, "stands": low, "fails": high, "height": search.height, "gone": given.gone,
              "stiffness": search.factor, "trials": sorted(search.trials, key=lambda trial: trial["factor"])}
    write_whole(given.out / "factor-of-safety.json", json.dumps(result, indent=1) + "\n")
    draw(search, low, high, given.out / "factor-of-safety.png")
    print(f"factor of safety {found:.3f}: stands at {low:.3f}, fails at {high:.3f}" if found else
          f"no factor of safety: it {'stands' if low else 'fails'} at all factors from {FEWEST:g} to {MOST:g}")


def main():
    """Carries out the command line; returns the exit code."""
    given = parse_arguments(sys.argv[1:])
    try:
        with Pool(given.threads) as pool:
            find(given, pool)
        return 0
    except Refused as reason:
        print(f"factor-of-safety: {reason}", file=sys.stderr)
        return reason.code
    except OSError as reason:
        print(f"factor-of-safety: {reason}", file=sys.stderr)
        return 74


if __name__ == "__main__":
    sys.exit(main())
