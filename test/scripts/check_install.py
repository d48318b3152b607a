"""Installs the build elsewhere, moves it, and uses it as its users do; prints 'N passed, N failed'.

    check_install.py [BUILD] [--whole]

With --whole the library is built anew as part of another project, which takes as long as building it; without, that project
links the one of BUILD.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from checking import report

ROOT = Path(__file__).resolve().parent.parent.parent
WORDS = [word for word in sys.argv[1:] if not word.startswith("--")]
BUILD = Path(WORDS[0]).resolve() if WORDS else ROOT / "build"
CONSUMER = ROOT / "test" / "scripts" / "consumer"
CASE = "cases/first/case.yaml"
PROGRAMS = ("mpm-static", "mpm-seismic", "seismpm-verify", "seismpm")


def wrong(*claims):
    """Number of claims that do not hold, and the number that may."""
    return float(sum(not claim for claim in claims)), 0.0


def call(*words, folder=None, **environment):
    """Exit code, stdout and stderr of a command."""
    done = subprocess.run([str(word) for word in words], cwd=folder, capture_output=True, text=True, check=False,
                          env={**os.environ, **environment})
    return done.returncode, done.stdout, done.stderr


def needs(program):
    """Why a check cannot be made, if a program is missing."""
    return "" if shutil.which(program) else f"there is no {program}"


class Installation:
    """An installation that was moved from where it was made."""

    def __init__(self, folder):
        first, self.prefix, self.work = folder / "first", folder / "moved to", folder / "work"
        self.work.mkdir()
        code, _, said = call("cmake", "--install", BUILD, "--prefix", first)
        if code:
            raise SystemExit(f"{BUILD} cannot be installed; build it first (scripts/test build)\n{said}")
        first.rename(self.prefix)
        self.share = self.prefix / "share" / "seismpm"
        self.made_in = [str(path).encode() for path in (ROOT, BUILD, first)]

    def run(self, program, *words, **environment):
        """Runs an installed program in the folder of work, as found by its name."""
        path = f"{self.prefix}/bin:{os.environ['PATH']}"
        return call(program, *words, folder=self.work, **{"PATH": path, **environment})


def there(installed):
    """Programs and commands tell their help and version; scripts of the tree alone are not among them."""
    code, listed, _ = installed.run("seismpm", "--help")
    commands = re.findall(r"^  ([a-z-]+)  +\S", listed, re.M)
    answers = [installed.run(program, word) for program in PROGRAMS for word in ("--help", "--version")]
    _, said, _ = installed.run("seismpm", "vary", "--help")
    return wrong(code == 0, {"run", "plot-run", "report", "sweep"} <= set(commands), not {"test", "package", "verify"} & set(commands),
                 all(code == 0 and said for code, said, _ in answers), "seismpm vary" in said, "scripts/vary" not in said)


def movable(installed):
    """No file names the folder in which it was made or first installed."""
    files = [path for path in installed.prefix.rglob("*") if path.is_file() and not path.is_symlink()]
    found = [path for path in files if any(word in path.read_bytes() for word in installed.made_in)]
    links = [path for path in installed.prefix.rglob("*") if path.is_symlink()]
    for path in found:
        print(f"{path} names a folder of this machine")
    return wrong(len(files) > 100, not found, len(links) > 1, all(path.resolve().is_relative_to(installed.prefix.resolve()) for path in links))


def found(installed):
    """Installed scripts start the installed programs, those of the tree those of its build, and $SEISMPM_PROGRAMS decides."""
    where = [call(folder / "find-programs")[1].strip() for folder in (ROOT / "scripts", installed.share / "scripts")]
    chosen = call(ROOT / "scripts" / "find-programs", SEISMPM_PROGRAMS="elsewhere")[1].strip()
    _, listed, said = installed.run("seismpm", "sweep", installed.share / CASE, "--out", "swept", "--list")
    checked, told, _ = installed.run("seismpm", "run", installed.share / CASE, "--check", "--set", "grid.spacing=2 m", "--threads", "1")
    if not listed or checked:
        print(said, told)
    return wrong(where == [str(ROOT / "build"), str(installed.prefix / "bin")], chosen == "elsewhere",
                 f"{installed.prefix}/bin/mpm-static" in listed, checked == 0, not (installed.share / "run").exists())


def refusals(installed):
    """A wrong command or option ends with 64, the right one is named, as the command was called."""
    good = []
    for words, part in ((("swep",), "did you mean 'sweep'?"), (("--vresion",), "'--version'"), (("zzz",), "no command"),
                        (("sweep", "--recrods", "x"), "seismpm sweep: --recrods"), (("run", "--sclae", "2"), "seismpm run: --sclae")):
        code, _, said = installed.run("seismpm", *words)
        good.append(code == 64 and part in said)
        if not good[-1]:
            print(words, code, said)
    return wrong(*good)


def ladder(installed):
    """The verification ladder finds its cases and runs one."""
    code, listed, said = installed.run("seismpm-verify", "--list")
    ran, _, told = installed.run("seismpm-verify", "--only", "kernel", "--quick", "--out", "ladder")
    return wrong(code == 0, "kernel" in listed, not said, ran == 0 or print(told), (installed.work / "ladder" / "RESULTS.md").exists())


def pages(installed):
    """Every program and every command has a man page with its name, all its options and the exit codes, and no page's link to another is broken."""
    man, good = installed.prefix / "share" / "man" / "man1", []
    commands = re.findall(r"^  ([a-z][a-z-]+)  +\S", installed.run("seismpm", "--help")[1], re.M)
    documented = {program: (program,) for program in PROGRAMS} | {f"seismpm-{name}": ("seismpm", name) for name in commands}
    for name, words in documented.items():
        path = man / f"{name}.1"
        page = path.read_text().replace("\\", "") if path.exists() else ""
        _, said, _ = installed.run(*words, "--help")
        options = set(re.findall(r"--[a-z][a-z-]+", said))
        good.append(all(option in page for option in options) and "diverged" in page and re.search(rf"^{name} - \S", page, re.M) is not None)
        if not good[-1]:
            print(f"{path}: {'is not there' if not page else 'has no name, no exit codes or not all options'}")
    good += [len(commands) > 10, {path.stem for path in man.iterdir()} == set(documented)]
    doc = installed.prefix / "share" / "doc" / "seismpm"
    links = [(page, link) for page in doc.rglob("*.md") for link in re.findall(r"\]\(([^)#:]+\.(?:md|png|yaml))[)#]", page.read_text())]
    broken = [(page, link) for page, link in links if not (page.parent / link).exists()]
    for page, link in broken:
        print(f"{page}: {link} leads nowhere")
    return wrong(*good, len(links) > 50, not broken, (doc / "LICENSE").exists())


def completed(installed, *words):
    """Candidates of the function that completes in bash."""
    program = words[0]
    script = installed.prefix / "share" / "bash-completion" / "completions" / program
    line = " ".join(words)
    code = f'source "{script}"; compopt() {{ :; }}; COMP_LINE="{line}" COMP_POINT=${{#COMP_LINE}}; _{program.replace("-", "_")}; printf "%s\\n" "${{COMPREPLY[@]}}"'
    return installed.run("bash", "--norc", "-c", code)[1].split()


def bash(installed):
    """bash completes options, folders, profiles and keys of the case that was named, and commands."""
    shutil.copy(ROOT / "cases" / "slope" / "case.yaml", installed.work / "case.yaml")
    (installed.work / "outputs").mkdir()
    expected = ((("mpm-static", "case.yaml", "--pro"), {"--profile"}), (("mpm-static", "case.yaml", "--profile", "q"), {"quick"}),
                (("mpm-static", "case.yaml", "--profile=q"), {"quick"}), (("mpm-static", "case.yaml", "--profile", "sta"), {"standard"}),
                (("mpm-seismic", "--mot"), {"--motion"}),
                (("mpm-static", "--mot"), set()), (("mpm-static", "--quiet", "--qui"), set()), (("mpm-static", "cas"), {"case.yaml"}),
                (("mpm-static", "--out", "outp"), {"outputs"}), (("mpm-static", "case.yaml", "--set", "grid.sp"), {"grid.spacing="}),
                (("mpm-seismic", "case.yaml", "--set=materials.soil.dens"), {"materials.soil.density="}),
                (("mpm-static", "case.yaml", "--set", "grid.softening=a"), {"averaged"}),
                (("seismpm-verify", "--only", "kern"), {"kernel"}), (("seismpm", "plot"), {"plot-run"}),
                (("seismpm", "run", "case.yaml", "--profile", "pap"), {"paper"}), (("seismpm", "sweep", "--rec"), {"--records"}))
    good = []
    for words, wanted in expected:
        got = set(completed(installed, *words))
        good.append(got == wanted)
        if got != wanted:
            print(words, got)
    return wrong(*good)


def fish(installed):
    """fish completes options with their meanings, and profiles of the case that was named."""
    if needs("fish"):
        return needs("fish")
    script = installed.prefix / "share" / "fish" / "vendor_completions.d" / "mpm-static.fish"
    ask = lambda line: installed.run("fish", "--no-config", "-c", f"source '{script}'; complete -C '{line}'")[1].splitlines()
    return wrong(ask("mpm-static --pro") == ["--profile\tapply one of the case's profiles; --set goes on top"],
                 ask("mpm-static case.yaml --profile q")[:1] == ["quick\tprofile of the case"])


def zsh(installed):
    """zsh reads what completes there."""
    if needs("zsh"):
        return needs("zsh")
    scripts = list((installed.prefix / "share" / "zsh" / "site-functions").iterdir())
    return wrong(len(scripts) == len(PROGRAMS), *(installed.run("zsh", "-n", script)[0] == 0 for script in scripts))


def consumer(installed):
    """Another project finds the library with find_package, links it and computes with it."""
    build = installed.work / "found"
    configured = call("cmake", "-S", CONSUMER, "-B", build, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={installed.prefix}", "-DCMAKE_BUILD_TYPE=Debug")
    built = call("cmake", "--build", build)
    if configured[0] or built[0]:
        print(*configured[1:], *built[1:])
        return wrong(False)
    code, said, _ = call(build / "consumer", ROOT / CASE)
    newer = call("cmake", "-S", CONSUMER, "-B", build, "-DWANTED=99")
    return wrong(code == 0, said.endswith(" J/m\n"), float(said.split()[-2]) > 0, newer[0] != 0, "version" in newer[2])


def part(installed):
    """The sources are part of another project with add_subdirectory, whose warnings and build type are its own."""
    build = installed.work / "part"
    configured = call("cmake", "-S", CONSUMER, "-B", build, "-G", "Ninja", f"-DSEISMPM_TREE={ROOT}", "-DCMAKE_BUILD_TYPE=Release")
    whole = "--whole" in sys.argv
    built = call("cmake", "--build", build, "--target", "consumer" if whole else "CMakeFiles/consumer.dir/main.cpp.o")
    if configured[0] or built[0]:
        print(*configured[1:], *built[1:])
    commands = call("ninja", "-C", build, "-t", "commands", "consumer")[1]
    compiled, linked = [line for line in commands.splitlines() if "consumer.dir/main.cpp.o" in line]
    if not whole:
        shutil.copy(BUILD / "libseismpm.a", build / "seismpm")
        call("sh", "-c", linked, folder=build)
    return wrong(configured[0] == 0, built[0] == 0, "-std=" in compiled, "-Wall" not in compiled,
                 call(build / "consumer", ROOT / CASE)[0] == 0)


def checks():
    """Name and (error, tolerance) of every check."""
    with tempfile.TemporaryDirectory() as folder:
        installed = Installation(Path(folder))
        for check in (there, movable, found, refusals, ladder, pages, bash, fish, zsh, consumer, part):
            yield check.__doc__, check(installed)


if __name__ == "__main__":
    sys.exit(report(checks()))
