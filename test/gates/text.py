"""What is said in the tree can be read by someone who has only the tree, and stays short.

- no file names a document or a folder that is not shipped, nor a machine's own paths;
- the front page has at most 150 lines, a file of C++ at most 300 lines of code;
- of the lines of program code 12 to 20 % are comments, in each of its folders.
"""
import re

import tree

FRONT_PAGE_LINES = 150
CODE_LINES = 300
COMMENT_SHARE = (0.12, 0.20)
PROGRAM_FOLDERS = ["materials/", "solver/mpm/", "boundaries/", "io/", "solver/stages/"]

# In two halves each, so that this file does not name them.
ELSEWHERE = re.compile("|".join([
    r"\b(METHO" + r"DS|INTERFA" + r"CE|ECOSY" + r"STEM|PERFORMA" + r"NCE|DESI" + r"GN)(\.md)?\b",
    r"\.\./sha" + r"red\b",
    r"(?<![\w./~$}-])/(wo" + r"rk|tm" + r"p|ho" + r"me|ro" + r"ot)(?=/\w)",
]))


def references():
    """Names of what is not in the repository."""
    for path in tree.files():
        if path.endswith((".png", ".h5", ".hdf")):
            continue
        for number, line in enumerate(tree.text(path).splitlines(), 1):
            found = ELSEWHERE.search(line)
            if found:
                yield f"{path}:{number}: '{found[0]}' is nothing that a reader has; say what it says, or cite what is published"


def count(path):
    """Lines of code and of comment of a file of C++; a line with both is one of each, an empty one neither."""
    code = comment = 0
    inside = False
    for line in tree.text(path).splitlines():
        line = line.strip()
        if inside or line.startswith(("//", "/*")):
            comment += 1
            inside = (inside or line.startswith("/*")) and "*/" not in line
        elif line:
            code += 1
            comment += bool(re.search(r"(?<!:)//", line))
    return code, comment


def lengths():
    """Pages and files that are too long."""
    lines = len(tree.text("README.md").splitlines())
    if lines > FRONT_PAGE_LINES:
        yield f"README.md: {lines} lines, {FRONT_PAGE_LINES} are allowed; move what is for readers of one folder to its card"
    for path in tree.files(".cpp", ".hpp"):
        code, _ = count(path)
        if code > CODE_LINES:
            yield f"{path}: {code} lines of code, {CODE_LINES} are allowed; cut it into files with names of their own"


def comments():
    """Folders of program code that say too little, or too much."""
    least, most = COMMENT_SHARE
    for folder in PROGRAM_FOLDERS:
        counts = [count(path) for path in tree.files(".cpp", ".hpp") if path.startswith(folder)]
        code, comment = (sum(column) for column in zip(*counts))
        share = comment / (code + comment)
        if not least <= share <= most:
            advice = "say why, with the equation" if share < least else "cut what the code says itself"
            yield f"{folder}: {share:.1%} of the lines are comments, {least:.0%} to {most:.0%} are allowed; {advice}"


def main():
    tree.tell("text", [*references(), *lengths(), *comments()], f"{len(tree.files())} files")


main()
