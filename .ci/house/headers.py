#!/usr/bin/python3
"""headers.py ROOT   every public header is used outside of its room.

Used: by another room, a tool, a node or the test of a package downstream (.ci/downstream.sh); or by a public header
that is. Tests and benchmarks do not count: they may include the headers in src/, too."""
import pathlib
import re
import sys

sys.dont_write_bytecode = True
import cxx

PACKAGE = "monocular_eye_hand"
DOWNSTREAM = pathlib.Path(".ci/downstream.sh")


def room_of(path):
    """Of a file in include/ or src/."""
    return path.parts[2] if path.parts[0] == "include" else path.parts[1]


def users(root):
    """{public header: files that include it}"""
    found = {path: set() for path in cxx.tracked(root, "include")}
    files = cxx.tracked(root, "include", "src") + [DOWNSTREAM] * (pathlib.Path(root) / DOWNSTREAM).exists()
    for path in files:
        for name in re.findall(rf'#include "({PACKAGE}/[^"]+)"', cxx.text_of(f"{root}/{path}")):
            header = pathlib.Path("include") / name
            if header in found:
                found[header].add(path)
    return found


def needed(found):
    """Headers that others use, and what those include."""
    outside = {header for header, files in found.items() for path in files
               if path == DOWNSTREAM or room_of(path) != room_of(header)}
    while True:
        through = {header for header, files in found.items() if files & outside} - outside
        if not through:
            return outside
        outside |= through


def main(root):
    found = users(root)
    if not any(found.values()):
        print("no public header is included: this check is blind")
        return 1

    unused = sorted(set(found) - needed(found))
    for header in unused:
        print(f"{header}: no other room uses it, its place is src/{'/'.join(header.parts[2:])}")
    print(f"public headers that no other room uses: {len(unused)} of {len(found)}")
    return 1 if unused else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
