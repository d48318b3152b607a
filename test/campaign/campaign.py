"""Kills runs, fails their disks and damages their files, by a seed; then the same command has to end with the results of a run left alone.

    test/campaign/campaign [--kills N] [--seed S] [--every-call] [--out DIR] [--build DIR]    goes on where it stopped
    test/campaign/campaign --kill K                      one of them again, and what came of it

Without --every-call N befallings are drawn; with it a fault at every single call of the programs comes before them. Exit code 0: all
have survived, or said why not.
"""
import argparse
import hashlib
import json
import sys
import time
from collections import Counter
from pathlib import Path

import befall
import subjects

sys.path.insert(0, str(subjects.ROOT / "test/atlas"))
from store import Store

CARD = ("signals", "call", "damage", *befall.AROUND)


def all_of(bench, given):
    """(key, befalling) of the whole campaign, in order."""
    if given.every_call:
        for what in befall.every_call(bench.subjects):
            yield subjects.described(what), what
    for number in range(given.kills) if given.kill is None else [given.kill]:
        yield f"{given.seed} {number} of {','.join(bench.subjects)}", befall.draw(bench.subjects, given.seed, number)


def table(results):
    """Lines of {subject and kind: how they ended}."""
    rows = {}
    for what, end in results:
        kind = what["kind"] + (f" {what['mode']}" if "mode" in what else "")
        for row in (what["subject"], f"  {kind}"):
            rows.setdefault(row, Counter())[end] += 1
    return subjects.summary(dict(sorted(rows.items(), key=lambda row: row[0].startswith(" "))))


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kills", type=int, default=40, metavar="N", help="how many are drawn (40: two minutes)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--every-call", action="store_true", help="first a fault at every call of the programs")
    parser.add_argument("--kill", type=int, metavar="K", help="this one alone")
    parser.add_argument("--only", default="", metavar="NAME,...", help="of these commands; default: all")
    parser.add_argument("--out", type=Path, default=subjects.ROOT / "run/campaign")
    parser.add_argument("--build", type=Path, default=subjects.ROOT / "build")
    given = parser.parse_args()
    given.out, given.build = given.out.resolve(), given.build.resolve()
    given.out.mkdir(parents=True, exist_ok=True)
    bench = subjects.Bench(given.out, given.build)
    only = [name for name in given.only.split(",") if name] or list(bench.subjects)
    if unknown := [name for name in only if name not in bench.subjects]:
        parser.exit(64, f"campaign: --only: '{unknown[0]}' is none of {', '.join(bench.subjects)}\n")
    bench.subjects = {name: bench.subjects[name] for name in only}
    for subject in bench.subjects.values():
        bench.learn(subject)
        print(f"campaign: {subject.name}: {subject.seconds:.1f} s, {subject.changes} calls that change, {subject.reads} reads", file=sys.stderr)
    store, results, began = Store(given.out / "befallen.jsonl", given.build), [], time.monotonic()
    for count, (name, what) in enumerate(all_of(bench, given), 1):
        key = store.key(name, hashlib.sha256(Path(befall.__file__).read_bytes()).hexdigest())
        if key not in store.found or given.kill is not None:
            end, why = befall.carry_out(bench, what)
            store.add(key, {"what": what, "end": end, "why": why})
            if end not in ("survived", "said why"):
                print(f"campaign: {name}: {subjects.described(what)}: {end}: {why}", file=sys.stderr)
        results.append((store.found[key]["what"], store.found[key]["end"]))
        if count % 50 == 0:
            print(f"campaign: {count} in {time.monotonic() - began:.0f} s", file=sys.stderr)
    print(table(results))
    ends = Counter(end for _, end in results)
    print(f"campaign: {len(results)}: " + ", ".join(f"{number} {end}" for end, number in ends.items()))
    if given.kill is not None:
        print(json.dumps(store.found[key], indent=1))
    return 1 if ends["FAILED"] else 0


if __name__ == "__main__":
    sys.exit(main())
