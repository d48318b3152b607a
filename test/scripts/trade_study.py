"""Measures what accuracy costs: six scenes, all knobs; writes tables and a picture.

    trade_study.py DIR [--only WORD] [--programs BUILD] [--page DIR]

Every point is a run of both stages on one thread, in DIR/SCENE/POINT. The command goes on where it was interrupted, runs
nothing twice, and tells what is there so far with --page. Errors are held against a closed form, finite elements or a
converged run of the default method. The noise floor is the scatter over eight shifts of the grid; differences below it are
ties. A point is on the front when no other is cheaper and as accurate. Recordings are those in SEISMPM_RECORDINGS.
"""
import argparse
import json
import os
import re
import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, os.fspath(ROOT / "scripts"))
import grids
import trade_page
from stages import Failed, both_stages, resolved_case
from trade_norms import norms_of
from trade_scenes import SCENES, points
from whole_file import write_whole

SHIFTS = 8
LASTING = (65, 80, 81)  # exit codes that a point would end with again


def name_of(knob, spacing):
    """Folder of a point."""
    return re.sub(r"[^\w.]+", "-", f"{knob} {spacing:g}")


def options_of(scene, spacing, settings):
    """Options of both programs; later settings of a key replace earlier ones."""
    chosen = dict(setting.split("=", 1) for setting in (*scene.settings, f"grid.spacing={spacing} m", *settings))
    return ["--threads", "1", "--quiet", *(word for key, value in chosen.items() for word in ("--set", f"{key}={value}"))]


def known(folder):
    """What cost.json says of a point: processor's time (s), and the code that it ended with; none of one that has not ended."""
    path = folder / "cost.json"
    return json.loads(path.read_text()) if path.exists() else {"processor": 0.0, "code": None}


def run(programs, scene, folder, name, spacing, settings):
    """Runs a point once; one that was interrupted begins anew, so that its cost is whole. A refusal keeps its exit code."""
    here, case = folder / name, scene.case_file(folder)
    if known(here)["code"] is not None:
        return here
    shutil.rmtree(here, ignore_errors=True)
    here.mkdir(parents=True)
    before, code = os.times(), 0
    try:
        both_stages(programs, case, (here / "static" if scene.static else None, here / "run"), options_of(scene, spacing, settings),
                    scene.record)
    except Failed as failure:
        if failure.code not in LASTING:
            raise
        code = failure.code
    after = os.times()
    spent = after.children_user + after.children_system - before.children_user - before.children_system
    write_whole(here / "cost.json", json.dumps({"processor": spent, "code": code}) + "\n")
    print(f"trade: {scene.name} {name}: {spent:.1f} s, exit {code}", file=sys.stderr, flush=True)
    return here


def shifted(programs, scene, folder):
    """Names and settings of eight shifts of the grid's origin, with the default at the cells where knobs are turned."""
    settings = resolved_case(programs, scene.case_file(folder), options_of(scene, scene.turned, ()))
    for k, shift in enumerate(grids.shifts(SHIFTS, grids.movable(settings)), 1):
        moved = grids.moved_by(settings, scene.turned, shift)
        yield f"shift-{k}", tuple(f"{key}={value}" for key, value in moved.items())


def run_all(scene, programs, folder):
    """Every point of a scene and its shifts; what is turned last."""
    turned = []
    for knob, spacing, settings in points(scene):
        if knob in ("default", "paper's method"):
            run(programs, scene, folder, name_of(knob, spacing), spacing, settings)
        else:
            turned.append((name_of(knob, spacing), spacing, settings))
    shifts = [(name, scene.turned, settings) for name, settings in shifted(programs, scene, folder)]
    for name, spacing, settings in [*shifts, *turned]:
        run(programs, scene, folder, name, spacing, settings)


def found(scene, folder):
    """What is known of a scene: rows (knob, cells, particle-steps, processor's s, {norm: error}), norms of shifts, failures
    (knob, cells, exit code)."""
    reference = folder / name_of("default", scene.finest) if scene.finest else None
    if reference and known(reference)["code"] != 0:
        return [], [], []
    rows, failures = [], []
    for knob, spacing, _ in points(scene):
        here = folder / name_of(knob, spacing)
        cost = known(here)
        if cost["code"]:
            failures.append((knob, spacing, cost["code"]))
        elif cost["code"] == 0 and here != reference:
            summary = json.loads((here / "run" / "summary.json").read_text())
            rows.append((knob, spacing, summary["particles"] * summary["steps"], cost["processor"], norms_of(scene, here, reference)))
    shifts = [folder / f"shift-{k}" for k in range(1, SHIFTS + 1)]
    return rows, [norms_of(scene, here, reference) for here in shifts if known(here)["code"] == 0], failures


def main():
    """Runs what is asked for, or writes the page."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--programs", type=Path, default=ROOT / "build")
    parser.add_argument("--page", type=Path, help="runs nothing; writes TRADE tables and picture of what is there to this folder")
    arguments = parser.parse_args()
    scenes = [scene for scene in SCENES if re.search(arguments.only, scene.name)]
    out = arguments.out.resolve()
    if arguments.page:
        trade_page.write({scene.name: (scene, *found(scene, out / scene.name)) for scene in scenes}, arguments.page)
        return 0
    for scene in scenes:
        if missing := scene.missing():
            print(f"trade: {scene.name} is skipped: {missing} is not there; SEISMPM_RECORDINGS names their folder", file=sys.stderr)
            continue
        run_all(scene, arguments.programs.resolve(), out / scene.name)
    return 0


if __name__ == "__main__":
    sys.exit(main())
