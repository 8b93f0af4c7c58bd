#!/usr/bin/python3
"""The documentation names files, tests and headings that are there."""
import glob
import os
import re
import subprocess
import sys

FILE = re.compile(r"`([\w/.]+\.(?:cpp|h|yaml|urdf|launch|test|sh|py|png))`")
LINK = re.compile(r"\]\((?!https?:)([^)#]*)(?:#([^)]+))?\)")
TESTS = re.compile(r"`[\w/]+_test\.cpp` \(([\w, ]+)\)")


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def tracked(*pattern):
    return subprocess.run(["git", "ls-files", *pattern], stdout=subprocess.PIPE, text=True, check=True).stdout.split()


def anchors(path):
    headings = re.findall(r"^#+ (.*)$", read(path), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-") for heading in headings}


def problems(path, files, tests):
    text = read(path)
    for name in FILE.findall(text):
        if not any(file == name or file.endswith("/" + name) for file in files):
            yield "there is no file " + name
    for link, anchor in LINK.findall(text):
        target = os.path.normpath(os.path.join(os.path.dirname(path), link)) if link else path
        if not os.path.exists(target):
            yield "there is no " + target
        elif anchor and anchor not in anchors(target):
            yield "%s has no heading #%s" % (target, anchor)
    for names in TESTS.findall(text):
        for name in names.split(", "):
            if name.lower() not in tests:
                yield "there is no test " + name


def main():
    os.chdir(os.path.join(os.path.dirname(os.path.realpath(__file__)), ".."))
    tests = set()
    for path in tracked("test/*.cpp"):
        for suite, name in re.findall(r"^TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", read(path), re.MULTILINE):
            tests |= {name.lower(), suite.lower()}
    found = ["%s: %s" % (path, problem) for path in ["README.md"] + sorted(glob.glob("docs/*.md"))
             for problem in problems(path, tracked(), tests)]
    print("\n".join(found) or "ok")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
