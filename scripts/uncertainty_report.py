"""What a series of grids says of a case: measures with their uncertainty, bands of histories, where the slope turns."""
import numpy as np

import convergence
import run_measures
from newmark import run_of
from plot_uncertainty import in_words as named
from turning import in_words

POINTS = 300  # of a history, as it is kept
WORDS = {"asymptotic": "", "scatter": "all sizes of cells agree as well as shifts do",
         "oscillating": "not asymptotic: finer cells turn the other way",
         "slow": "not asymptotic: finer cells differ no less, or diverge",
         "fast": "not asymptotic: the coarsest cells do not carry it",
         "two grids": "cells of two sizes only: order 1 and a safety factor of 3 are assumed",
         "one grid": "cells of one size only",
         "bifurcates": "bifurcates: the range of all grids"}


def by_level(grids, values):
    """[(h, values)] of the grids whose value is finite, finest first and the case's own first of all."""
    levels = {}
    for grid in sorted(grids, key=lambda grid: (grid.level, any(grid.shift))):
        if values[grid.name] is not None and np.isfinite(values[grid.name]).all():
            levels.setdefault(grid.spacing, []).append(values[grid.name])
    return list(levels.items())


def entry(unit, levels, bifurcates):
    """The entry of one measure: its estimate, and the numbers that it is made of."""
    found = convergence.estimate(levels)
    uncertainty, kind = found.uncertainty, found.kind
    if bifurcates:
        uncertainty = max(abs(value - found.value) for _, row in levels for value in row)
        kind = "bifurcates"
    return {"unit": unit, "value": found.value, "uncertainty": uncertainty, "order": found.order, "kind": kind,
            "discretization": found.error, "scatter": found.scatter,
            "cells": [{"spacing": spacing, "values": row} for spacing, row in levels]}


def measured(folders):
    """{grid: {Measure: value}} of the runs; measures of a slide only where something slides."""
    found = {name: run_measures.measures(folder) for name, folder in folders.items()}
    slides = any(row[run_measures.Measure("moved_area", "m²")] for row in found.values())
    return {name: {measure: value for measure, value in row.items() if slides or measure.name not in run_measures.SLIDE}
            for name, row in found.items()}


def levels_of(grids, found):
    """{Measure: levels} of all that the case's own run has."""
    return {measure: by_level(grids, {grid.name: found[grid.name].get(measure) for grid in grids})
            for measure, value in found["as-is"].items() if value is not None}


def listed(values):
    """Numbers for JSON: null where there is none."""
    return [float(f"{value:.6g}") if np.isfinite(value) else None for value in values]


def bands(series, folders, bifurcates):
    """{name: band} of the histories: abscissa, the case's own values and their uncertainty, at POINTS points at most."""
    found = {name: run_measures.histories(folder) for name, folder in folders.items()}
    kept = {}
    for key, (along, _) in found["as-is"].items():
        along = along[::max(1, len(along) // POINTS)]
        values = {name: np.interp(along, *rows[key]) for name, rows in found.items() if key in rows}
        sound = np.all([np.isfinite(row) for row in values.values()], axis=0)
        half = np.full(len(along), np.nan)
        if bifurcates:
            half[sound] = np.max([np.abs(row - values["as-is"])[sound] for row in values.values()], axis=0)
        elif sound.any():
            levels = by_level(series.grids, {name: row[sound] for name, row in values.items()})
            half[sound] = convergence.band(levels)
        kept[key[0]] = {"unit": key[1], "along": listed(along), "value": listed(values["as-is"]), "uncertainty": listed(half)}
    return kept


def report(series, verdicts, turnings):
    """All that is known, as it is stored in uncertainty.json."""
    folders = {grid.name: series.folder(grid) for grid in series.grids}
    bifurcates = len(set(verdicts.values())) > 1
    own = next(grid for grid in series.grids if grid.name == "as-is")
    grids = [{"name": grid.name, "spacing": grid.spacing, "shift": grid.shift, "fails": verdicts[grid.name],
              "work": grid.work / own.work} for grid in series.grids]
    levels = levels_of(series.grids, measured(folders))
    return {"run": run_of(folders["as-is"]), "confidence": convergence.CONFIDENCE, "grids": grids,
            "left_out": series.left_out, "bifurcates": bifurcates,
            "turning_scale": {name: {"stands": bracket[0], "fails": bracket[1], "runs": bracket[2]}
                              for name, bracket in turnings.items()},
            "measures": {measure.name: entry(measure.unit, rows, bifurcates) for measure, rows in levels.items()},
            "histories": bands(series, folders, bifurcates)}


def plus_minus(entry):
    """A measure's value and uncertainty, told to two digits of the latter."""
    value, half = entry["value"], entry["uncertainty"]
    if half <= 0:
        return f"{value:.4g}", "0"
    digits = int(np.clip(1 - np.floor(np.log10(half)), 0, 12))
    return f"{value:.{digits}f}", f"{half:.{digits}f}"


def order_text(entry):
    """The observed order, a dash where there is none."""
    return "–" if entry["order"] is None or entry["kind"] == "bifurcates" else "> 4" if entry["order"] > 4 else f"{entry['order']:.1f}"


def verdict(result, grid):
    """What the slope does on a grid, and the scale of the motion at which it turns, where that was looked for."""
    said = f"{grid['name']} (h = {grid['spacing']:.4g} m) {'fails' if grid['fails'] else 'stands'}"
    bracket = result["turning_scale"].get(grid["name"], {"runs": 0})
    found = f"; it turns under {in_words(bracket['stands'], bracket['fails'])} the motion" if bracket["runs"] else ""
    return said + found


def remarks(result):
    """What is to be said of the series as a whole: grids left out, where the slope turns."""
    said = [f"{name} ended with {code} and is left out" for name, code in result["left_out"].items()]
    if result["bifurcates"]:
        said.append("the answer bifurcates: the slope stands on one grid and fails on another")
        said += [verdict(result, grid) for grid in result["grids"]]
    return said


def lines(result):
    """The table as Markdown, and remarks below it."""
    found = ["| measure | value | uncertainty | unit | order | |", "| --- | --- | --- | --- | --- | --- |"]
    for name, entry_of in result["measures"].items():
        found.append(f"| {named(name).strip()} | {' | '.join(plus_minus(entry_of))} | {entry_of['unit']} | "
                     f"{order_text(entry_of)} | {WORDS[entry_of['kind']]} |")
    return found + ["", *remarks(result)]
