"""What the gates share: the files of the tree, and how faults are told."""
import os
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
OF_NO_INTEREST = re.compile(r"(.*/)?(\.git|\.cache|__pycache__)|run|build[^/]*|cases/\w+/records")


def files(*endings):
    """Paths of the tree that end with one of `endings` (all without), relative to it and sorted."""
    found = []
    for folder, folders, names in os.walk(ROOT):
        here = pathlib.Path(folder).relative_to(ROOT)
        folders[:] = [name for name in folders if not OF_NO_INTEREST.fullmatch((here / name).as_posix())]
        found += [(here / name).as_posix() for name in names if name != ".git"]  # a file in a worktree
    return sorted(path for path in found if not endings or path.endswith(endings))


def text(path):
    """Text of a file of the tree; what is not UTF-8 comes out as the replacement character."""
    return (ROOT / path).read_text(encoding="utf8", errors="replace")


def tell(gate, faults, looked_at):
    """Prints the faults, or that there are none, and ends the gate: with 1 where there is one.

    `looked_at` says what was searched; a gate that found nothing to look at is broken, and fails as well.
    """
    for fault in faults:
        print(f"{gate}: {fault}", file=sys.stderr)
    print(f"{gate}: {len(faults)} faults in {looked_at}")
    sys.exit(1 if faults or looked_at.startswith("0 ") else 0)
