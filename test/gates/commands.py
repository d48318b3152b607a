"""Every command that a page tells can be given: its programs, files, options, presets and tags are there.

    test/gates/commands.py [--list]     after a build; --list prints the commands that were found

Commands are the lines of fenced blocks of sh, or of no language where the line begins as one does, and code in a line
that begins with a program or an option of ours. Words that stand for something (NAME, FILE.yaml, [options], ...) are passed over.
A command with a case is given to its program, which reads and checks the case with the command's profile and settings
(`--print-case`) and writes nothing; commands that only print are run as they stand.
"""
import functools
import json
import re
import shlex
import subprocess
import sys

import tree

BUILD = tree.ROOT / "build"
SHELL = {"sh", "bash", "shell", "console"}
PRINTING = {"--help", "--version", "--keys", "--list", "--check", "--print-case", "--schema", "--example"}
OTHERS = {"cd", "git", "cmake", "ctest", "apt-get", "mkdir", "python3", "export", "nohup", "rm", "cp", "tail", "paraview"}  # no programs of ours
STAGES = ("mpm-static", "mpm-seismic")
BUILT = (*STAGES, "seismpm-tests", "seismpm-verify")  # the others only when they are asked for
NO_PROGRAMS = {"scripts/find-python", "scripts/find-programs", "scripts/install-packages"}  # without options
WITHOUT_FILES = {"--out", "--from", "--motion", "--vertical", "--record-dt", "--record-unit", "--record-format",
                 "--record-component", "--vertical-component"}  # what --print-case of a case does not need
OURS = re.compile(r"(\S*/)?(scripts/[\w-]+|test/campaign/campaign|test/fuzz/fuzz|build[\w-]*/[\w-]+|mpm-static|mpm-seismic|seismpm-\w+)$|seismpm$")
STANDS_FOR = re.compile(r"[\[\]<>*{}|…$]|\.\.\.|\b[A-Z]{1,}[A-Z_]*\b(?![\w-]*\d)")
PATH = re.compile(r"(scripts|test|cases|solver|io|boundaries|materials)/[\w./-]+$")


def blocks(page):
    """(number of the line, language, text) of each line of fenced code, and ('', text) of code within a line."""
    language = None
    for number, line in enumerate(tree.text(page).splitlines(), 1):
        fence = re.match(r"\s*(?:```|~~~)\s*(\w*)", line)
        if fence:
            language = fence[1] if language is None else None
        elif language is not None:
            yield number, language or "none", line
        else:
            for code in re.findall(r"(?<!`)`([^`]+)`(?!`)", line):
                yield number, "inline", code


def commands(page):
    """(place, words) of every command of a page."""
    waiting, start, variables = "", 0, {}
    for number, language, line in blocks(page):
        start = start if waiting else number
        line = waiting + re.sub(r"^\s*\$ ", "", line)
        waiting = ""
        if language != "inline" and re.search(r"\\(\s+#.*)?$", line):  # goes on in the next line
            waiting = re.sub(r"\\(\s+#.*)?$", " ", line)
            continue
        try:
            words = shlex.split(line, comments=True)
        except ValueError:
            words = line.split() if OURS.match(line.split()[0]) else []
        while words and re.match(r"\w+=", words[0]):
            name, _, value = words.pop(0).partition("=")
            variables["$" + name] = value
        words = [variables.get(word, word) for word in words]
        if len(words) > 1 and words[0] == "seismpm":  # where it is installed
            words = ["scripts/" + words[1], *words[2:]] if re.match(r"[a-z]", words[1]) else ["scripts/seismpm", *words[1:]]
        if words and (language in SHELL or OURS.match(words[0]) or re.match("--[a-z]", words[0])
                      or language == "none" and words[0] in OTHERS
                      or language == "inline" and words[0] in ("cmake", "ctest") and "--preset" in words):
            yield f"{page}:{start}", words


@functools.lru_cache(None)
def run(*words):
    """Exit code and all that a command says."""
    done = subprocess.run(words, cwd=tree.ROOT, capture_output=True, text=True, timeout=300)
    return done.returncode, done.stdout + done.stderr


@functools.lru_cache(None)
def program(word):
    """Path of a program of ours as a page names it; where it is built, of the build that is tested."""
    if word.startswith("test/"):
        return word
    name = word.rsplit("/", 1)[-1]
    return f"scripts/{name}" if re.search(r"(^|/)scripts/|^seismpm$", word) else f"build/{name}"


@functools.lru_cache(None)
def options(path):
    """The options that a program's help names."""
    said = tree.text(path) if path in ("scripts/test", "scripts/bench") else run(path, "--help")[1]
    return set(re.findall(r"(?<![\w-])(--?[a-z][\w-]*)", said)) | {"--help"}


@functools.lru_cache(None)
def options_of_any():
    """The options of all our programs."""
    paths = [path for path in tree.files() if re.match(r"scripts/[\w-]+$", path) and path not in NO_PROGRAMS]
    return {option for path in paths + [f"build/{stage}" for stage in STAGES] for option in options(path)}


def made_by_cmake():
    """Names of the programs that CMakeLists.txt can build."""
    told = tree.text("CMakeLists.txt")
    return set(re.findall(r"add_executable\(([\w-]+)", told)) | set(STAGES) | {f"fuzz-{path.stem}" for path in (tree.ROOT / "test/fuzz/corpus").iterdir()}


def check_preset(words):
    """Whether CMakePresets.json has the preset that cmake or ctest is given."""
    presets = json.loads(tree.text("CMakePresets.json"))
    kind = "testPresets" if words[0] == "ctest" else "buildPresets" if "--build" in words else "configurePresets"
    if "--preset" in words:
        name = words[words.index("--preset") + 1]
        if not STANDS_FOR.search(name) and name not in [preset["name"] for preset in presets[kind]]:
            yield f"there is no preset {name} in CMakePresets.json, {kind}"


def check_tests(words):
    """Whether seismpm-tests has tests of these names and tags."""
    for word in words[1:]:
        if word.startswith("[") or not word.startswith("-"):
            _, said = run("build/seismpm-tests", "--list-tests", word)
            if re.search(r"^(0 matching|No test cases matched)", said, re.M) or "No test cases matched" in said:
                yield f"seismpm-tests has no test for '{word}'"


def check_case(stage, words):
    """Gives a command with a case to a stage's program, without the files that it would read or write besides."""
    kept, rest = [f"build/{stage}"], iter(words[1:])
    for word in rest:
        name, given, _ = word.partition("=")
        if name in WITHOUT_FILES:
            next(rest) if not given else None
        elif name not in PRINTING:
            kept.append(word)
    code, said = run(*kept, "--print-case")
    if code:
        yield f"{' '.join(kept)} --print-case ends with {code}: {said.strip().splitlines()[-1]}"


def check_profiles(words):
    """The profiles that scripts/vary is given, one after the other."""
    for profile in words[words.index("--profiles") + 1].split(",") if "--profiles" in words else []:
        yield from check_case("mpm-seismic", ["", words[1], "--profile", profile])


def check_ours(words):
    """What is wrong with a command of a program of ours."""
    path = program(words[0])
    if path.startswith("build/") and path[6:] not in made_by_cmake():
        yield f"CMakeLists.txt makes no {path[6:]}"
        return
    if not (tree.ROOT / path).exists():
        if path.startswith("scripts/"):
            yield f"there is no {path}"
        elif path[6:] in BUILT:
            yield f"{path} is not built, so that this cannot be checked"
        return
    for word in words[1:words.index("--") if "--" in words else None]:  # beyond are options of the programs that a script starts
        option = word.split("=")[0]
        if re.match(r"--[a-z]", word) and option not in options(path):
            yield f"{path} has no option {option}"
    if path == "build/seismpm-tests":
        yield from check_tests(words)
    if any(STANDS_FOR.search(word) for word in words[1:]):
        return
    case = next((word for word in words[1:] if word.endswith(".yaml")), "")
    if path == "scripts/vary" and case:
        yield from check_profiles(words)
    elif case and path[6:] in STAGES:
        yield from check_case(path[6:], words)
    elif case and path == "scripts/run":
        yield from check_case("mpm-seismic", [word for word in words if word not in ("--fresh", "--check")])
    elif set(words[1:]) & PRINTING and path.startswith("build/"):
        code, said = run(path, *words[1:])
        if code:
            yield f"{' '.join(words)} ends with {code}: {said.strip().splitlines()[-1]}"


def check(words):
    """What is wrong with a command."""
    for word in words:
        if PATH.match(word) and not STANDS_FOR.search(word) and not (tree.ROOT / word).exists() \
                and not re.match(r"cases/\w+/records(/|$)", word):
            yield f"there is no {word}"
    if words[0] in ("cmake", "ctest"):
        yield from check_preset(words)
    elif OURS.match(words[0]):
        yield from check_ours(words)
    elif words[0].startswith("--"):
        for word in words:
            if re.match("--[a-z]", word) and word.split("=")[0] not in options_of_any():
                yield f"no program of ours has an option {word.split('=')[0]}"
    elif words[0] not in OTHERS and not re.match(r"\$\w+$", words[0]):
        yield f"'{words[0]}' is no program that this gate knows; name it in OTHERS of test/gates/commands.py"


def main():
    found = [(place, words) for page in tree.files(".md") for place, words in commands(page)]
    if "--list" in sys.argv[1:]:
        for place, words in found:
            print(place, shlex.join(words))
        return
    faults = [f"{place}: {shlex.join(words)}: {fault}" for place, words in found for fault in dict.fromkeys(check(words))]
    tree.tell("commands", faults, f"{len(found)} commands")


main()
