"""Every link of every *.md leads somewhere: to a file, to a heading of a page, or out by https."""
import os
import re

import tree

LINK = re.compile(r"!?\[[^\]]*\]\(([^()\s]*(?:\([^()\s]*\)[^()\s]*)*)\)")


def prose(page):
    """Lines of a page with what stands in code blanked out, so that code that looks like a link is none."""
    fenced = False
    for line in tree.text(page).splitlines():
        if re.match(r"\s*(```|~~~)", line):
            fenced = not fenced
            yield ""
        else:
            yield "" if fenced else line


def anchors(page):
    """The anchors of a page's headings, as GitHub and GitLab make them."""
    found = set()
    for line in prose(page):
        heading = re.match(r"#{1,6}\s+(.*?)\s*#*$", line)
        if heading:
            plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading[1]).lower()
            anchor = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
            repeated = sum(1 for known in found if re.fullmatch(re.escape(anchor) + r"(-\d+)?", known))
            found.add(f"{anchor}-{repeated}" if repeated else anchor)
    return found


def fault(page, link):
    """What is wrong with a link, or nothing."""
    if re.match(r"(https|mailto):", link):
        return ""
    if re.match(r"\w+:", link) or link.startswith("/"):
        return "is neither https nor relative to the page"
    path, _, anchor = link.partition("#")
    target = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
    if target.startswith("..") or not (tree.ROOT / target).exists():
        return f"leads to {target}, which is not there"
    if anchor and (not target.endswith(".md") or anchor not in anchors(target)):
        return f"leads to a heading that {target} does not have"
    return ""


def main():
    faults, count = [], 0
    for page in tree.files(".md"):
        for number, line in enumerate(prose(page), 1):
            for link in LINK.findall(re.sub(r"`[^`]*`(?!\])", "", line)):
                count += 1
                wrong = fault(page, link)
                if wrong:
                    faults.append(f"{page}:{number}: the link '{link}' {wrong}")
    tree.tell("links", faults, f"{count} links")


main()
