"""Where the programs are stable: the forty extremes, maps, and everything at once by random draws. Run by scripts/atlas."""
import argparse
import hashlib
import json
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import by_name
import cases
import draws
import judge
import page
from extremes import EXTREMES
from maps import MAPS
from store import Store

ROOT = Path(__file__).resolve().parents[2]
DRAWS, QUICK_DRAWS = 2000, 400


def run_all(store, programs, jobs, wanted, what):
    """{name: result} of (name, settings), on so many processors; tells how far it is."""
    built = {name: cases.build(**settings) for name, settings in wanted}
    keys = {name: store.key(b["case"], b["record"], b["factor"]) for name, b in built.items()}
    todo = [name for name in built if keys[name] not in store.found]
    began = time.monotonic()

    def one(name):
        b = built[name]
        return name, judge.run(programs, b["case"], b["record"], b["speed"], b["factor"])

    with ThreadPoolExecutor(jobs) as pool:
        for count, (name, result) in enumerate(pool.map(one, todo), 1):
            store.add(keys[name], result)
            if count % 50 == 0 or count == len(todo):
                print(f"atlas: {what}: {count} of {len(todo)} in {time.monotonic() - began:.0f} s", file=sys.stderr)
    return {name: store.found[keys[name]] for name in built}


def run_tests(store, programs, quick):
    """{pattern: (passed, measure)} of all tests that hold an extreme."""
    found = {}
    patterns = sorted({name for e in EXTREMES for name in (*e.tests, *(() if quick else e.slow))})
    program = programs / "seismpm-tests"
    digest = hashlib.sha256(program.read_bytes()).hexdigest()
    for pattern in patterns:
        key = store.key("test", pattern, digest)
        if key not in store.found:
            print(f"atlas: test {pattern}", file=sys.stderr)
            store.add(key, by_name.run(program, pattern))
        found[pattern] = tuple(store.found[key])
    return found


def say_failures(results):
    """Lines that name every failure among {name: result}."""
    return [f"{name}: {judge.ENDS[r['end']]} ({r['stage']}, code {r['code']}): {r.get('said') or r.get('measures')}"
            for name, r in results.items() if r["end"] in judge.FAILURES]


def write_page(path, found, drawn, tested):
    """ATLAS.md and its picture."""
    map_ends = {name: [r["end"] for r in results.values()] for name, results in found.items()}
    said = [page.verdict(e, tested, map_ends)[0] for e in EXTREMES] if tested else []
    points = sum(map(len, found.values()))
    lines = [
        "# Where it is stable", "",
        "Made by `scripts/atlas`; [test/atlas](../../test/atlas/README.md) tells how a run is judged. Every point of a map and every draw is a "
        "small case run through both programs. Failures, a motion that grows and is not caught, a crash, a hang or a result that holds no "
        "numbers, must be none.", "",
        "| | number | ends |", "| --- | --- | --- |",
        f"| points of maps | {points} | {page.counts(e for ends in map_ends.values() for e in ends)} |",
        f"| draws of everything at once | {len(drawn)} | {page.counts(r['end'] for r in drawn.values())} |", ""]
    if said:
        lines[-1:-1] = [f"| the forty extremes | {len(said)} | " + ", ".join(f"{said.count(v)} {v}" for v in dict.fromkeys(said)) + " |"]
        lines += ["## The forty extremes", "", page.extremes_table(EXTREMES, tested, map_ends), ""]
    lines += ["## The maps", "", "![All maps](atlas.png)", "",
              ", ".join(f"`{letter}` {judge.ENDS[end]}" for end, (_, letter) in page.LOOKS.items()) + ".", ""]
    for of in MAPS:
        if of.name in found:
            lines += [f"### {of.title}", "", of.reason, ""]
            for panel, cells in page.panels(found[of.name], of).items():
                lines += [f"{of.panel[0]}: {panel}", "", page.table(cells, of), ""]
    lines += ["## Everything at once", "",
              f"Settings are drawn from the whole range of every key with the seed {draws.SEED}; `scripts/atlas --draw N --out DIR` runs one. Of those that "
              "ended with 80 or were refused the messages are:", "", "| end | message begins | draws |", "| --- | --- | --- |"]
    kinds = {}
    for r in drawn.values():
        if r["end"] in ("caught", "refused"):
            kinds.setdefault((r["end"], kind_of(r["said"])), []).append(1)
    lines += [f"| {judge.ENDS[end]} | {text} | {len(ones)} |" for (end, text), ones in sorted(kinds.items(), key=lambda k: -len(k[1]))]
    path.write_text("\n".join(lines) + "\n")
    page.picture(path.with_name("atlas.png"), found, MAPS)


def kind_of(said):
    """What a message says, without its numbers and names."""
    for words in ("moves by", "moves at", "is deformed", "is squeezed", "has swollen", "energy has grown", "in motion or have been radiated", "is where the step failed", "shorter than two time steps", "has a ", "out of reach", "not finite"):
        if words in said:
            return words.strip()
    return " ".join(word for word in said.split(": ")[-1].split() if not any(c.isdigit() for c in word))[:60].replace("|", "/")


def main():
    """Command line."""
    parser = argparse.ArgumentParser(prog="scripts/atlas", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer points and draws: minutes")
    parser.add_argument("--out", type=Path, default=ROOT / "run/atlas", help="folder of the results (run/atlas)")
    parser.add_argument("--only", default="", help="these maps, and 'draws' and 'extremes', separated by commas")
    parser.add_argument("--jobs", type=int, default=1, help="cases at a time")
    parser.add_argument("--draws", type=int, help=f"how many draws ({DRAWS}; quick: {QUICK_DRAWS})")
    parser.add_argument("--draw", type=int, help="writes and runs this draw alone")
    parser.add_argument("--list", action="store_true", help="names the maps and the extremes")
    parser.add_argument("--build", type=Path, default=ROOT / "build", help="folder of the programs")
    options = parser.parse_args()
    names = [of.name for of in MAPS] + ["draws", "extremes"]
    only = [word for word in options.only.split(",") if word] or names
    if unknown := [word for word in only if word not in names]:
        parser.exit(64, f"atlas: --only: {unknown[0]} is none of {', '.join(names)}\n")
    if options.list:
        print("\n".join([f"{of.name}: {of.title}" for of in MAPS] + [f"{e.number}: {e.question}" for e in EXTREMES]))
        return 0
    options.out.mkdir(parents=True, exist_ok=True)
    if options.draw is not None:
        b = cases.build(**draws.draw(options.draw))
        (options.out / "case.yaml").write_text(b["case"])
        (options.out / "shake.txt").write_text(b["record"])
        print(json.dumps(judge.run(options.build, b["case"], b["record"], b["speed"], b["factor"]), indent=1))
        return 0
    store = Store(options.out / "points.jsonl", options.build)
    found = {of.name: run_all(store, options.build, options.jobs, [(point, of.settings(*point)) for point in of.points(options.quick)],
                              f"map {of.name}") for of in MAPS if of.name in only}
    count = options.draws or (QUICK_DRAWS if options.quick else DRAWS)
    drawn = run_all(store, options.build, options.jobs, [(n, draws.draw(n)) for n in range(count)], "draws") if "draws" in only else {}
    tested = run_tests(store, options.build, options.quick) if "extremes" in only else {}
    write_page(options.out / "ATLAS.md", found, drawn, tested)
    failures = [f"map {name}, {line}" for name, results in found.items() for line in say_failures(results)]
    failures += [f"draw {line}" for line in say_failures(drawn)]
    failures += [f"test {name}: {measure or 'failed'}" for name, (passed, measure) in tested.items() if not passed]
    print("\n".join(failures) or "atlas: nothing grew that was not caught, nothing broke", file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except OSError as reason:
        print(f"atlas: {reason}; what is done is kept, and the same command goes on", file=sys.stderr)
        sys.exit(74)
