"""What a sweep runs: records, scale factors and variations of a case, each combination once and by a name of its own.

A run is a dictionary: `name`; `record`, `vertical` (paths, empty: the case's), `scale`; `record_options`; `profile`;
`settings` {key: value}; `static`, the name of its static state. Runs that shape the same ground share that state.
"""
import csv
import hashlib
import json
import random
import re
from itertools import product
from pathlib import Path
from statistics import NormalDist

from resolved_case import Refused, number_and_unit, options_of, resolve, setting
from whole_file import write_whole

SCHEMA = "seismpm-sweep/1"
RECORD_OPTIONS = {"dt": "--record-dt", "unit": "--record-unit", "format": "--record-format", "component": "--record-component",
                  "vertical_component": "--vertical-component"}
COLUMNS = {"name", "record", "vertical", "scale", "profile", *RECORD_OPTIONS}
NOT_OF_STATIC = ("name", "output", "time_step")  # parts of a case that leave the static state as it is
NOT_OF_STATIC_SEISMIC = ("motion", "duration")


def read_table(path):
    """Runs of a CSV table: columns of COLUMNS, and keys of the case (with a dot in them); paths relative to the table."""
    with open(path, newline="", encoding="utf-8-sig") as file:
        reader = csv.DictReader(row for row in file if row.strip() and not row.startswith("#"))
        headings = [heading.strip() for heading in reader.fieldnames or []]
        wrong = [heading for heading in headings if heading not in COLUMNS and "." not in heading]
        if wrong or not headings:
            raise Refused(65, f"{path}: column '{wrong[0] if wrong else ''}' is none of {', '.join(sorted(COLUMNS))}, nor a key "
                          "of the case such as materials.clay.strength.peak")
        read_rows = list(reader)
        long = next((number for number, row in enumerate(read_rows, 1) if None in row), None)
        if long:
            raise Refused(65, f"{path}: row {long} has more values than the table has columns")
        rows = [{heading: (value or "").strip() for heading, value in zip(headings, row.values())} for row in read_rows]
    return [row_as_run(path, number, row) for number, row in enumerate(rows, 1)]


def row_as_run(path, number, row):
    """A row of a table as a run without a name, unless it gives one."""
    try:
        scale = float(row.get("scale") or 1.0)
    except ValueError:
        raise Refused(65, f"{path}: row {number}: scale '{row['scale']}' is no number") from None
    run = {"given_name": row.get("name", ""), "scale": scale, "profile": row.get("profile", ""),
           "settings": {key: value for key, value in row.items() if "." in key and value},
           "record_options": [word for key, option in RECORD_OPTIONS.items() if row.get(key) for word in (option, row[key])]}
    for kind in ("record", "vertical"):
        run[kind] = str((Path(path).parent / row[kind]).resolve()) if row.get(kind) else ""
    return run


def records_of(paths):
    """Runs of folders (each file in them is a record), tables (.csv) and single records; the case's own without any."""
    runs = []
    for path in map(Path, paths):
        if not path.exists():
            raise Refused(66, f"{path}: no such record, folder or table")
        if path.suffix.lower() == ".csv":
            runs += read_table(path)
            continue
        files = sorted(p for p in path.iterdir() if p.is_file() and not p.name.startswith(".")) if path.is_dir() else [path]
        if not files:
            raise Refused(66, f"{path}: the folder holds no records")
        runs += [{"given_name": "", "record": str(file.resolve()), "vertical": "", "scale": 1.0, "profile": "", "settings": {},
                  "record_options": []} for file in files]
    return runs or [{"given_name": "", "record": "", "vertical": "", "scale": 1.0, "profile": "", "settings": {},
                     "record_options": []}]


def drawn(seed, key, law, sample):
    """The value of a key in a sample, by its law: normal(mean, deviation), lognormal(median, log. deviation), uniform(a, b).

    It depends on seed, key and number of the sample alone, so that more samples leave the first ones as they are.
    """
    parts = re.fullmatch(r"\s*(normal|lognormal|uniform)\(([^,]+),([^,]+)\)\s*", law)
    if not parts:
        raise Refused(64, f"--draw {key}={law}: write normal(64 kPa, 6 kPa), lognormal(64 kPa, 0.1) or uniform(50 kPa, 70 kPa)")
    (a, unit), (b, other) = (number_and_unit(part) for part in parts.groups()[1:])
    if other != ("" if parts[1] == "lognormal" else unit):
        raise Refused(64, f"--draw {key}={law}: both numbers need the same unit"
                      if parts[1] != "lognormal" else f"--draw {key}={law}: the logarithmic deviation has no unit")
    uniform = random.Random(f"{seed} {key} {sample}").random()
    deviate = NormalDist().inv_cdf(min(max(uniform, 1e-12), 1 - 1e-12))
    if parts[1] == "uniform":
        value = a + (b - a) * uniform
    else:
        value = a + b * deviate if parts[1] == "normal" else a * 2.718281828459045 ** (b * deviate)
    return f"{value:.6g} {unit}".strip()


def variations(given):
    """(profile, settings) of every profile, value of --vary and sample of --draw, each with each."""
    profiles = given.profiles or [""]
    axes = []
    for assignment in given.vary:
        key, values = setting(assignment)
        axes.append([(key, value.strip()) for value in values.split(";")])
    draws = [setting(assignment) for assignment in given.draw]
    samples = [[(key, drawn(given.seed, key, law, k)) for key, law in draws] for k in range(given.samples if draws else 1)]
    common = [setting(assignment) for assignment in given.set]
    for profile, *values, sample in product(profiles, *axes, samples):
        yield profile, dict([*common, *values, *sample])


def name_of(run, common):
    """RECORD-xSCALE-PROFILE, and six digits that stand for settings that are not common to all runs."""
    stem = run["given_name"] or (Path(run["record"]).stem if run["record"] else "case")
    parts = [stem] + [f"x{run['scale']:g}"] * (run["scale"] != 1.0) + [run["profile"]] * bool(run["profile"])
    own = {key: value for key, value in run["settings"].items() if (key, value) not in common}
    if own:
        parts.append(hashlib.sha256(json.dumps(own, sort_keys=True).encode()).hexdigest()[:6])
    return re.sub(r"[^\w.+=-]", "_", "-".join(parts))


def static_digest(programs, case, run, more):
    """Six digits that stand for what the static state depends on; empty for a case without gravity."""
    resolved = resolve(programs, case, options_of(run["profile"], run["settings"]) + more)
    if resolved["static"]["gravity"].split()[0] in ("0", "0.0"):
        return ""
    for key in NOT_OF_STATIC:
        resolved.pop(key, None)
    for key in NOT_OF_STATIC_SEISMIC:
        resolved["seismic"].pop(key, None)
    return hashlib.sha256(json.dumps(resolved, sort_keys=True).encode()).hexdigest()[:6]


def make(given):
    """The plan of a command line: {schema, case, programs, more, from, statics, runs}, every case of it checked."""
    case = given.case.resolve()
    if not case.exists():
        raise Refused(66, f"{given.case}: no such case")
    if given.start and not given.start.exists():
        raise Refused(66, f"{given.start}: no such static state")
    common = {setting(assignment) for assignment in given.set}
    runs, statics, digests = {}, {}, {}
    for record, scale, (profile, settings) in product(records_of(given.records), given.scales, list(variations(given))):
        if profile and record["profile"]:
            raise Refused(64, f"--profiles {profile}: the table gives {record['given_name'] or record['record']} a profile too")
        run = {**record, "scale": record["scale"] * scale, "profile": profile or record["profile"],
               "settings": {**settings, **record["settings"]}}
        run["name"] = name_of(run, common)
        del run["given_name"]
        shape = json.dumps([run["profile"], run["settings"]], sort_keys=True)
        if shape not in digests:
            digests[shape] = static_digest(given.programs, case, run, given.more)
        digest = digests[shape]
        run["static"] = digest if not given.start else ""
        if run["static"]:
            statics.setdefault(digest, {"profile": run["profile"], "settings": run["settings"]})
        if runs.setdefault(run["name"], run) != run:
            raise Refused(65, f"two runs would be called {run['name']}; give records of one name a `name` in a table")
    return {"schema": SCHEMA, "case": str(case), "programs": str(given.programs.resolve()), "more": given.more,
            "from": str(given.start.resolve()) if given.start else "", "statics": statics, "runs": list(runs.values())}


def commands_of_static(plan, out, digest):
    """Output folder and command of a static state."""
    static, folder = plan["statics"][digest], Path(out) / "static" / digest
    return folder, [str(Path(plan["programs"]) / "mpm-static"), plan["case"], "--out", str(folder),
                    *options_of(static["profile"], static["settings"]), *plan["more"]]


def command_of_run(plan, out, run):
    """Output folder and command of a run."""
    folder = Path(out) / "runs" / run["name"]
    start = plan["from"] or (str(Path(out) / "static" / run["static"] / "final.h5") if run["static"] else "")
    command = [str(Path(plan["programs"]) / "mpm-seismic"), plan["case"], "--out", str(folder)]
    command += ["--from", start] if start else []
    command += ["--motion", run["record"]] if run["record"] else []
    command += ["--vertical", run["vertical"]] if run["vertical"] else []
    command += ["--scale", f"{run['scale']:.10g}"] if run["scale"] != 1.0 else []
    return folder, [*command, *run["record_options"], *options_of(run["profile"], run["settings"]), *plan["more"]]


def read(out):
    """The plan in a sweep's folder."""
    path = Path(out) / "sweep.json"
    if not path.exists():
        raise Refused(66, f"{path} is missing: {out} is no folder of scripts/sweep")
    plan = json.loads(path.read_text())
    if plan.get("schema") != SCHEMA:
        raise Refused(65, f"{path} is of schema {plan.get('schema')}, not {SCHEMA}")
    return plan


def store(plan, out):
    """Writes the plan to its folder; one that is there may grow by runs, but none may change or go. Returns what is stored."""
    path = Path(out) / "sweep.json"
    if path.exists():
        old = read(out)
        changed = [key for key in ("case", "from", "more") if old[key] != plan[key]]
        new = {run["name"]: run for run in plan["runs"]}
        changed += [run["name"] for run in old["runs"] if new.get(run["name"]) != run]
        if changed:
            raise Refused(73, f"{out} holds another sweep: {changed[0]} differs or is gone; runs may be added to a sweep, not "
                          "changed. Give another --out")
        known = {run["name"] for run in old["runs"]}
        plan = {**plan, "runs": old["runs"] + [run for run in plan["runs"] if run["name"] not in known]}
    write_whole(path, json.dumps(plan, indent=1) + "\n")
    return plan
