"""Holds the tree to its floors: a file includes its own folder or a lower one, and no two files include each other.

The floors and their order are FLOORS below; the tests stand above all of them.
"""
import os
import re

import tree

# What each folder may include besides itself: these, and all that they may include.
FLOORS = {
    "materials": [],
    "solver/mpm": ["materials"],
    "boundaries/ground_motion": ["solver/mpm"],
    "boundaries": ["boundaries/ground_motion"],
    "io/common": ["boundaries"],
    "io/records": ["io/common"],
    "io/case": ["io/records"],
    "io/results": ["io/common"],
    "io/run_folder": ["io/results"],
    "solver/stages": ["io/case", "io/run_folder"],
}
MADE = {"built_in.hpp", "example.hpp"}  # by CMake, from *.hpp.in


def below(folder):
    """All that `folder` may include besides itself."""
    return {lower for floor in FLOORS[folder] for lower in {floor} | below(floor)}


def includes(path):
    """(number of the line, file) for each #include "..." of a file."""
    for number, line in enumerate(tree.text(path).splitlines(), 1):
        found = re.match(r'\s*#\s*include\s*"([^"]*)"', line)
        if found:
            yield number, found[1]


def faults_of(path, known):
    """What is wrong with the includes of one file."""
    folder = os.path.dirname(path)
    for number, included in includes(path):
        target = os.path.dirname(included)
        if included in MADE:
            continue
        if included not in known:
            yield f'{path}:{number}: "{included}" is no file of the tree; name it by its path from the root'
        elif folder in FLOORS and target != folder and target not in below(folder):
            lower = ", ".join(sorted(below(folder))) or "nothing else"
            yield f'{path}:{number}: {folder} may not include "{included}": only its own folder and {lower}'


def circle(graph):
    """A list of files each of which includes the next and the last the first; empty if there is none."""
    done, way = set(), []

    def walk(path):
        if path in way:
            return way[way.index(path):] + [path]
        if path in done:
            return []
        way.append(path)
        found = next(filter(None, map(walk, graph[path])), [])
        way.pop()
        done.add(path)
        return found

    return next(filter(None, map(walk, graph)), [])


def main():
    paths = tree.files(".cpp", ".hpp")
    known = set(paths)
    faults = [f"{path}: {os.path.dirname(path)} has no floor yet; give it one in test/gates/includes.py"
              for path in paths if os.path.dirname(path) not in FLOORS and not path.startswith("test/")]
    faults += [fault for path in paths for fault in faults_of(path, known)]
    graph = {path: [file for _, file in includes(path) if file in known] for path in paths}
    round_trip = circle(graph)
    if round_trip:
        faults.append("files include each other: " + " -> ".join(round_trip))
    tree.tell("includes", faults, f"{len(paths)} files")


main()
