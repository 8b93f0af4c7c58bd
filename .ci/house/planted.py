#!/usr/bin/python3
"""planted.py [MEASURE...]   the measures of this folder see a fault that was planted, and nothing where there is none.

Each is run on a small repository of its own, first a sound one, then the same with the fault. Without names: all."""
import contextlib
import importlib
import io
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import cxx

HERE = pathlib.Path(__file__).resolve().parent
PACKAGE = "include/monocular_eye_hand"
SOUND = {
    f"{PACKAGE}/low/a.h": """
        namespace monocular_eye_hand {
        struct A { struct Inner { int i; }; };
        struct Later;
        template <class T, class = void>
        struct Has {};
        template <class T>
        struct Has<T, int> {};
        }""",
    "src/low/a.cpp": """
        #include "monocular_eye_hand/low/a.h"
        namespace monocular_eye_hand {
        namespace {
        struct Own { Own() : a_{1}, b_{2} {} int a_, b_; };
        }
        struct Later { struct Inner {}; };
        // struct A {};
        const char* text() { struct A { int i; }; return "struct A {"; }
        }""",
    "src/high/b.cpp": """
        #include "monocular_eye_hand/low/a.h"
        namespace monocular_eye_hand {
        namespace {
        struct Own {};
        }
        namespace other { struct A {}; }
        }""",
    f"{PACKAGE}/low/api.h": '#include "monocular_eye_hand/low/part_of_api.h"\n',
    f"{PACKAGE}/low/part_of_api.h": "",
    ".ci/downstream.sh": 'echo \'#include "monocular_eye_hand/low/api.h"\'\n',
    "msg/Found.msg": "int32 found\n",
}
PLANTED = {
    "circles": [
        {"src/low/a.h": '#include "monocular_eye_hand/low/part_of_api.h"\n',
         f"{PACKAGE}/low/part_of_api.h": '#include "monocular_eye_hand/low/a.h"\n'},
        {"src/low/one.h": '#include "two.h"\n', "src/low/two.h": '#include "low/three.h"\n',
         "src/low/three.cpp": '#include "low/one.h"\n', "src/low/three.h": ""},
        {"src/high/folder/b.h": '#include "high/b.h"\n', "src/high/b.h": '#include "high/folder/b.h"\n'},
    ],
    "headers": [
        {f"{PACKAGE}/low/lonely.h": "", "src/low/lonely.cpp": '#include "monocular_eye_hand/low/lonely.h"\n'},
        {f"{PACKAGE}/low/lonely.h": "", f"{PACKAGE}/low/brings.h": '#include "monocular_eye_hand/low/lonely.h"\n'},
        {f"{PACKAGE}/low/tested.h": "", "test/high/b_test.cpp": '#include "monocular_eye_hand/low/tested.h"\n'},
    ],
    "names": [
        {"src/high/c.cpp": "namespace monocular_eye_hand {\nclass A final : public B {\n};\n}\n"},
        {"src/high/c.cpp": "namespace monocular_eye_hand {\nenum class Later : int { kOne };\n}\n"},
        {"src/high/c.cpp": "namespace monocular_eye_hand {\nstruct Has : Base {};\n}\n"},
        {"src/high/c.h": "namespace monocular_eye_hand {\ntemplate <class T>\nstruct Found {\n  T t;\n};\n}\n"},
    ],
}


def outcome(measure, files):
    """(exit code, output) of a measure on a repository of these files."""
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            path = pathlib.Path(root, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        for command in (["init", "-q"], ["add", "-A"]):
            subprocess.run(["git", "-C", root, *command], check=True, capture_output=True)

        cxx.text_of.cache_clear()
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            failed = measure.main(root)
        return failed, out.getvalue()


def faults(name):
    """What is wrong with a measure."""
    measure = importlib.import_module(name)
    failed, said = outcome(measure, SOUND)
    if failed:
        yield f"{name} complains where nothing is wrong: {said}"
    for number, files in enumerate(PLANTED.get(name, []), 1):
        if not outcome(measure, {**SOUND, **files})[0]:
            yield f"{name} does not see planted fault {number}"
    if name not in PLANTED:
        yield f"{name} has no planted fault"


def main(*wanted):
    present = sorted(path.stem for path in HERE.glob("*.py") if path.stem not in ("cxx", "planted"))
    found = [fault for name in wanted or present for fault in faults(name)]
    print("\n".join(found) or f"seen by {', '.join(wanted or present)}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
