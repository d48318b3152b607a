"""Checks numerical uncertainties against made and known answers, and how a series of grids goes; prints 'N passed, N failed'."""
import argparse
import contextlib
import io
import json
import sys
import tempfile
from pathlib import Path
from unittest import mock

import numpy as np

import uncertainty_study
from checking import report

import convergence
import grids
import plot_page
import plot_uncertainty
import stages
import turning
import uncertainty
import uncertainty_report
import vary

SPACINGS = (1.0, 1.55, 2.4)
SETTINGS = """# a case
grid:
  spacing: 1 m
domain:
  x: [0 m, 90 m]
  bottom: -2 m
regions:
  - material: clay
    x: [0 m, 30 m]
    below: ground
  - material: rock
seismic:
  base:
    kind: compliant
  sides:
    kind: free_field
"""


def drawn(generator):
    """Levels of a made measure whose true value is 0: a h^p (1 + b h), p from 1 to 3, and scatter of 0.1 to 1000 %."""
    order, bend = generator.choice([1.0, 1.5, 2.0, 3.0]), generator.uniform(-0.3, 0.3) / SPACINGS[-1]
    noise, power = 10 ** generator.uniform(-3, 1), generator.choice([0.5, 1.0, 1.5])
    return [(h, h**order * (1 + bend * h) + noise * h**power * generator.normal(size=count))
            for h, count in zip(SPACINGS, (1, 4, 5))]


def made():
    """Shares of 4000 made measures that lie outside their bars, and of bars that are longer than three errors."""
    generator = np.random.default_rng(20260101)
    told = [convergence.estimate(drawn(generator)) for _ in range(4000)]
    return (np.mean([abs(one.value) > one.uncertainty for one in told]),
            np.mean([one.uncertainty > 3 * abs(one.value) for one in told]))


def exact():
    """An error a h^p without scatter is told with the safety factor of 1.25, and so is its order, up to 3."""
    worst = 0.0
    for order in (0.7, 1.0, 1.7, 2.0, 3.0):
        told = convergence.estimate([(h, [5 + 0.1 * h**order]) for h in SPACINGS])
        worst = max(worst, abs(told.order - order), abs(told.uncertainty / 0.125 - 1), told.kind != "asymptotic")
    return worst, 1e-9


def kinds():
    """Answers that turn, diverge, jump or do not differ are told to, and two grids and one are not three."""
    wanted = {"oscillating": (1.0, 1.1, 0.7), "slow": (1.0, 1.3, 1.35), "fast": (1.0, 1.001, 2.0)}
    wrong = sum(convergence.estimate([(h, [m]) for h, m in zip(SPACINGS, means)]).kind != kind for kind, means in wanted.items())
    noisy = [(h, [1.0, 1.1, 0.9, 1.05]) for h in SPACINGS]
    for levels, kind in ((noisy, "scatter"), (noisy[:1], "one grid"), ([(1.0, [1.0]), (2.0, [1.2])], "two grids")):
        wrong += convergence.estimate(levels).kind != kind
    return float(wrong), 0.0


def profile():
    """The band of a history is what its points would have by themselves, where all have one order."""
    shape = np.linspace(1.0, 2.0, 7)
    half = convergence.band([(h, shape * (1 + 0.1 * h**2) * np.ones((1, 1))) for h in SPACINGS])
    return np.abs(half / (0.125 * shape) - 1).max(), 1e-9


def planned():
    """Coarser grids have whole cells between the sides; a shift moves sides, base and the ends of regions at a side."""
    settings = stages.settings_of(SETTINGS)
    plan = grids.plan(settings, (0, 1, 2))
    shifted = plan[1]
    moved, along = shifted.settings, shifted.spacing * shifted.shift[0]
    wrong = [[grid.level for grid in plan] != [2, 2, 2, 1, 1, 0], plan[3].name != "h1.552" or plan[-1].settings != {},
             abs(90 / plan[0].spacing - 38) > 1e-9,
             max(abs(part) for grid in plan for part in grid.shift) > 0.5,
             max(abs(np.array(stages.numbers(moved["domain.x"])) - [along, 90 + along])) > 1e-9,
             max(abs(np.array(stages.numbers(moved["regions[0].x"])) - [along, 30])) > 1e-9,
             abs(stages.numbers(moved["domain.bottom"])[0] + 2 - shifted.spacing * shifted.shift[1]) > 1e-9,
             any(any(grid.shift) for grid in grids.plan({**settings, "seismic.base.kind": "fixed", "seismic.sides.kind": "roller"},
                                                        (1, 1, 1)))]
    try:
        grids.plan({**settings, "domain.x": "[0 m, 2 m]"}, (0, 0, 0))
    except grids.BadGrid:
        return float(sum(wrong)), 0.0
    return 1.0, 0.0


def options():
    """Options of the motion go to the second program only; a setting of the series takes the place of the user's."""
    both, seismic = stages.split_options(["--set", "a.b=1", "--motion", "r.AT2", "--threads", "2", "--scale=2"])
    wrong = [both != ["--set", "a.b=1", "--threads", "2"], seismic != ["--motion", "r.AT2", "--scale=2"],
             stages.with_settings(both, {"a.b": "3"}) != ["--threads", "2", "--set", "a.b=3"],
             uncertainty.scaled(seismic, 1.5) != ["--motion", "r.AT2", "--scale", "3"]]
    return float(sum(wrong)), 0.0


def turned():
    """A slope that turns at a scale of 0.83 is found between neighbours, from above and below, in as many runs as allowed."""
    wrong = 0
    for limit in (0.83, 1.17):
        calls = []
        stands, fails, made_runs = turning.turning(lambda scale: calls.append(scale) or scale > limit, limit < 1, 5)
        wrong += not (stands <= limit < fails and fails / stands < 1.02 and made_runs == len(calls) == 5)
    wrong += turning.turning(lambda scale: True, True, 2) != (None, 0.64, 2)
    return float(wrong), 0.0


def refused():
    """Wrong options end with 64, a case that is missing with 66."""
    wrong = 0
    for words, code in ((["a.yaml"], 64), (["a.yaml", "--out", "o", "--shifts", "1,2"], 64),
                        (["a.yaml", "--out", "o", "--", "--fresh"], 64), (["no such.yaml", "--out", "o"], 66)):
        with contextlib.redirect_stderr(io.StringIO()), mock.patch("sys.argv", ["uncertainty", *words]):
            try:
                wrong += uncertainty.main() != code
            except SystemExit as end:
                wrong += end.code != code
    return float(wrong), 0.0


def known(folder):
    """The closed form of a soft layer on rock lies within the bars of cells of 0.5 m, all 14."""
    rows = uncertainty_study.judged(*uncertainty_study.series_of("layer", 0.5, folder, (0, 2, 3)))
    return 1 - uncertainty_study.shares(rows)[0], 0.05


def repeated(folder):
    """The same command again runs nothing, and another one on the same folder is refused by the programs with 73."""
    before = {path: path.stat().st_mtime_ns for path in folder.rglob("*.h5")}
    uncertainty_study.series_of("layer", 0.5, folder, (0, 2, 3))
    wrong = before != {path: path.stat().st_mtime_ns for path in folder.rglob("*.h5")}
    try:
        with mock.patch.dict("known_answers.SITES", layer=uncertainty_study.known_answers.SITES["layer"]), \
                mock.patch("known_answers.SITE", [*uncertainty_study.known_answers.SITE, "--set", "seismic.duration=1 s"]):
            uncertainty_study.series_of("layer", 0.5, folder, (0, 2, 3))
        wrong += 1
    except stages.Failed as failure:
        wrong += failure.code != 73
    return float(wrong), 0.0


def pictured(folder):
    """Table, JSON, picture and the page's words are made; the run folder's is taken by plot-run, one of another run is not."""
    series, _ = uncertainty_study.series_of("layer", 0.5, folder, (0, 2, 3))
    result = uncertainty_report.report(series, {grid.name: grid.level == 2 for grid in series.grids},
                                       {"as-is": (1.0, 1.25, 1)})
    text = json.dumps(result, allow_nan=False)
    (folder / "as-is" / "uncertainty.json").write_text(text)
    lines = uncertainty_report.lines(result)
    with contextlib.redirect_stdout(io.StringIO()):
        plot_uncertainty.draw(result, folder)
    bar = {"measures": {"moved_area": {"uncertainty": 12.34, "unit": "m²", "kind": "asymptotic"}}}
    words = dict(plot_page.measures(plot_page.read_summary(folder / "as-is"), bar))
    wrong = [not (folder / "uncertainty.png").exists(), words["moved area (over 1 m)"] != "0.0 m² ± 12 m²",
             plot_uncertainty.stored(folder / "as-is") != json.loads(text),
             not any("it turns under 1 to 1.25 times the motion" in line for line in lines),
             sum(line.startswith("| top: ") for line in lines) != 7]
    (folder / "as-is" / "uncertainty.json").write_text(text.replace('"until"', '"since"'))
    try:
        plot_uncertainty.stored(folder / "as-is")
        wrong.append(True)
    except plot_uncertainty.Missing:
        pass
    return float(sum(wrong)), 0.0


def left_out():
    """A coarse grid that does not stand is left out and not tried again; a run that is interrupted or killed ends the series."""
    tried, code = [], 81

    def both_stages(_programs, _case, folders, *_options):
        tried.append(folders[1].name)
        folders[1].mkdir(parents=True, exist_ok=True)
        if folders[1].name.startswith("h2.3"):
            raise stages.Failed(code)

    settings = {**stages.settings_of(SETTINGS), "static.gravity": "9.81 m/s2", "output.slide.area": "10 m2"}
    with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(io.StringIO()), \
            mock.patch("uncertainty.resolved_case", return_value=settings), mock.patch("uncertainty.both_stages", both_stages):
        arguments = argparse.Namespace(case=Path("c.yaml"), out=Path(folder), both=[], seismic=[], shifts=(0, 0, 1),
                                       ratios=(1.5, 2.4), programs=Path("p"), bisections=0)
        series = uncertainty.Series(arguments)
        series.run_all()
        first, again = list(tried), uncertainty.Series(arguments)
        again.run_all()
        wrong = [first != ["h2.368", "h2.368-shift1", "h1.5", "as-is"], tried != first + first[2:],
                 [grid.name for grid in series.grids] != first[2:], again.left_out != {name: 81 for name in first[:2]}]
        for code in (75, 137):  # stopped; killed, for want of memory say
            try:
                uncertainty.Series(argparse.Namespace(**{**vars(arguments), "both": ["--quiet"]})).run_all()
                wrong.append(True)
            except stages.Failed as failure:
                wrong.append(failure.code != code)
        try:
            stages.call("/bin/sh", "-c", "kill -9 $$")
            wrong.append(True)
        except stages.Failed as failure:
            wrong.append(failure.code != 137)
    return float(sum(wrong)), 0.0


def varied():
    """vary ends a profile with the code of the program that failed."""
    with mock.patch("vary.both_stages", side_effect=stages.Failed(81)):
        return float(vary.run(argparse.Namespace(out=Path("o"), programs=Path("p"), case=Path("c"), more=[]), None)[1] != 81), 0.0


def checks():
    """Name and (error, tolerance) of every check."""
    outside, long = made()
    yield "made measures lie within their bars, 19 of 20", (outside, 0.05)
    yield "made measures: bars of at most three errors, half of them", (long, 0.5)
    for check in (exact, kinds, profile, planned, options, turned, refused, left_out, varied):
        yield check.__doc__.splitlines()[0], check()
    with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(io.StringIO()):
        for check in (known, repeated, pictured):
            yield check.__doc__.splitlines()[0], check(Path(folder))


if __name__ == "__main__":
    sys.exit(report(checks()))
