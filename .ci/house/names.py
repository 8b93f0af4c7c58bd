#!/usr/bin/python3
"""names.py ROOT   no type name stands twice in one namespace.

Two different types of one name in one namespace are undefined behaviour as soon as one process loads both. Read are
include/, src/ and the messages, whose types share the namespace. A type in an anonymous namespace belongs to its file."""
import collections
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
import cxx

NAMESPACE = "monocular_eye_hand"
GENERATED = {".msg": ("",), ".srv": ("", "Request", "Response"),
             ".action": ("Action", "ActionGoal", "ActionResult", "ActionFeedback", "Goal", "Result", "Feedback")}


def types(root):
    """(namespace, name, file:line) of every type in the sources that another file can see."""
    for path in cxx.tracked(root, "include", "src"):
        for found in cxx.Code(f"{root}/{path}").types():
            if found.name and "(file)" not in found.namespace:
                yield found.namespace, found.name, f"{path}:{found.line}"


def messages(root):
    """The same of what is generated from messages, services and actions."""
    out = subprocess.run(["git", "-C", root, "ls-files", "msg", "srv", "action"], capture_output=True, text=True, check=True)
    for path in map(pathlib.Path, out.stdout.split()):
        for ending in GENERATED.get(path.suffix, ()):
            yield NAMESPACE, path.stem + ending, f"{path}:1"


def main(root):
    places = collections.defaultdict(list)
    for namespace, name, place in [*types(root), *messages(root)]:
        places[f"{namespace}::{name}"].append(place)
    if not places:
        print("no type found: this check is blind")
        return 1

    doubles = {name: found for name, found in sorted(places.items()) if len(found) > 1}
    for name, found in doubles.items():
        print(f"{name} is defined at {', '.join(found)}")
    print(f"names of types defined twice: {len(doubles)} (of {len(places)} types)")
    return 1 if doubles else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
