#!/usr/bin/python3
"""circles.py ROOT   no two file units include each other, directly or through others.

A unit is what one thing consists of: room/name stands for include/<package>/room/name.h, src/room/name.h and
src/room/name.cpp, and the same in folders of a room. A source that implements another unit's header is a unit of its
own. What ends a circle: the plain structs that both sides need stand in a header of their own."""
import collections
import pathlib
import sys

sys.dont_write_bytecode = True
import cxx

PACKAGE = "include/monocular_eye_hand/"


def unit(path):
    name = path.with_suffix("").as_posix()
    return name[len(PACKAGE):] if name.startswith(PACKAGE) else name[len("src/"):]


def resolved(name, path, files):
    """The file that an include names, of those of the package; None for others'."""
    for place in ("include/" + name, "src/" + name, (path.parent / name).as_posix()):
        if pathlib.Path(place) in files:
            return pathlib.Path(place)
    return None


def includes(root, files):
    """{unit: {included unit: [(file, line), ...]}}"""
    graph = collections.defaultdict(lambda: collections.defaultdict(list))
    for path in sorted(files):
        text = cxx.text_of(f"{root}/{path}")
        for match in cxx.INCLUDE.finditer(text):
            header = resolved(match[1], path, files)
            if header and unit(header) != unit(path):
                graph[unit(path)][unit(header)].append((path, text.count("\n", 0, match.start(1)) + 1))
    return graph


def circles(graph):
    """Groups of units each of which includes all others, directly or through others (Tarjan 1972)."""
    index, low, stack, found = {}, {}, [], []

    def visit(node):
        index[node] = low[node] = len(index)
        stack.append(node)
        for other in graph.get(node, ()):
            if other not in index:
                visit(other)
            if other in stack:
                low[node] = min(low[node], low[other])

        if low[node] == index[node]:
            place = stack.index(node)
            if len(stack) - place > 1:
                found.append(sorted(stack[place:]))
            del stack[place:]

    for node in sorted(graph):
        if node not in index:
            visit(node)
    return sorted(found)


def main(root):
    sys.setrecursionlimit(10000)
    files = set(cxx.tracked(root, "include", "src"))
    graph = includes(root, files)
    if not graph:
        print("no file includes another: this check is blind")
        return 1

    found = circles(graph)
    for circle in found:
        print("circle:", ", ".join(circle))
        for one in circle:
            for other in sorted(set(graph[one]) & set(circle)):
                for path, line in graph[one][other]:
                    print(f"  {path}:{line} includes {other}")
    print(f"circles between file units: {len(found)} (of {len({unit(path) for path in files})} units)")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
