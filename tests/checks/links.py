#!/usr/bin/env python3
"""Checks the links of the documents. Usage: links.py [ROOT]; prints every broken one, exit status 1 if any.

Every relative link or image of every *.md file in the tree (those that git would ignore left out) leads to a file or
folder, and a part after # to a heading of it. A path in `code` that begins with a folder of the tree exists, from the
root of the tree, unless it holds a placeholder such as <name>.
"""
import pathlib
import re
import sys

IGNORED = re.compile(r"^(build[^/]*|runs|report|Testing|\.git)/")
PATH = re.compile(r"`((?:src|render|tests|inputs|catalyst_scripts|docs)/[\w./-]*)(?: --?\w.*)?`")
LINK = re.compile(r"\]\(\s*<?([^)\s>]+)>?[^)]*\)")


def without_blocks(text):
    return re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)


def without_code(text):
    text = without_blocks(text)
    return re.sub(r"`[^`\n]*`", lambda m: m.group().replace("](", "]_("), text)


def anchor(heading):
    """As web pages of repositories make it: lower case, words joined by hyphens, punctuation dropped."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def anchors(file):
    return {anchor(heading) for heading in re.findall(r"^#+ (.*)$", without_code(file.read_text()), re.M)}


def broken_links(root):
    for page in sorted(root.rglob("*.md")):
        name = page.relative_to(root).as_posix()
        if IGNORED.match(name):
            continue
        for link in LINK.findall(without_code(page.read_text())):
            if re.match(r"[a-z]+:", link):
                continue
            path, _, part = link.partition("#")
            target = page.parent / path if path else page
            if not target.exists():
                yield f"{name}: {link}: no such file"
            elif part and (target.suffix != ".md" or part not in anchors(target)):
                yield f"{name}: {link}: no such heading"
        for path in PATH.findall(without_blocks(page.read_text())):
            if not (root / path).exists():
                yield f"{name}: {path}: no such file"


if __name__ == "__main__":
    found = list(broken_links(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(found) if found else "all links lead somewhere")
    sys.exit(1 if found else 0)
