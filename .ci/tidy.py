#!/usr/bin/python3
"""tidy.py BUILD [UNIT...]   clang-tidy has nothing to say of src/ and of the headers; .clang-tidy has the checks.

By hand: .clang-tidy says what it costs. Most of the work is to read Eigen, OpenCV and ROS, so all sources of a module
(src/pose), or of a node (src/nodes/task), are one unit that is read as one file; a tool is one by itself. Without units:
all. A file of planted faults is the control: unless they are seen, this check is blind. What clang cannot compile of
GCC's library is left to GCC."""
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SEEN_OF_PLANTED = {
    "readability-identifier-naming": "void Wrong_name();",
    "modernize-use-override": "struct A { virtual ~A() = default; virtual void f(); }; struct B : A { void f(); };",
    "modernize-use-nullptr": "const int* none() { return 0; }",
    "performance-for-range-copy": "struct Big { ~Big(); int i[99]; }; int sum(const Big (&all)[9]) { "
                                  "int s = 0; for (const Big big : all) s += big.i[0]; return s; }",
    "bugprone-sizeof-container": "#include <string>\nunsigned long size(const std::string& s) { return sizeof(s); }",
}
FOUND = re.compile(r"^(.*?):(\d+):\d+: (?:warning|error): (.*) \[([\w.,-]+)\]$", re.M)


def commands(build):
    """(source, its compile command) of everything that the build compiles."""
    out = subprocess.run(["ninja", "-C", build, "-t", "compdb"], capture_output=True, text=True, check=True)
    for entry in json.loads(out.stdout):
        if entry["file"].endswith((".cpp", ".cxx")) and " -c " in entry["command"]:
            yield pathlib.Path(entry["file"]), shlex.split(entry["command"])


def flags(command):
    """What says how a file is read; paths of precompiled headers, warnings and optimisation do not."""
    kept = []
    for word, value in zip(command, [*command[1:], ""]):
        if word.startswith(("-D", "-I", "-std=")):
            kept.append(word)
        elif word == "-isystem":
            kept += [word, value]
    return kept


def units_of(source, build):
    """src/<module> that a source, or a batch of sources in the build folder, is of. A batch does not tell of which node or
    tool it is: every folder of src/nodes, every file of src/tools by itself. Nothing for what is no source of the package."""
    parts = ()
    for root in (ROOT, build):
        if source.is_relative_to(root / "src"):
            parts = source.relative_to(root / "src").parts
    if not parts:
        return []
    if parts[0] == "tools":
        return [path.relative_to(ROOT) for path in sorted((ROOT / "src/tools").glob("*.cpp"))]
    if parts[0] == "nodes":
        return sorted({path.parent.relative_to(ROOT) for path in (ROOT / "src/nodes").glob("*/*.cpp")})
    return [pathlib.Path("src", parts[0])]


def units(build):
    """{unit: (its sources, the flags)}"""
    found = {}
    for source, command in commands(str(build)):
        for unit in units_of(source, build):
            if unit not in found:
                path = ROOT / unit
                found[unit] = (sorted(path.rglob("*.cpp")) if path.is_dir() else [path], flags(command))
    return found


def tidy(text, options, folder, name):
    """{(file, line, what, check)} that clang-tidy finds in a file of this text."""
    path = pathlib.Path(folder, name.replace("/", "_") + ".cpp")
    path.write_text(text, encoding="utf-8")
    command = ["clang-tidy", "--quiet", f"--config-file={ROOT / '.clang-tidy'}",
               f"--header-filter=^{re.escape(str(ROOT))}/(include|src)/", str(path), "--", *options]
    out = subprocess.run(command, capture_output=True, text=True)
    found = {match.groups() for match in FOUND.finditer(out.stdout)}
    if out.returncode and not found:
        found.add((name, "0", (out.stdout + out.stderr).strip(), "clang-tidy"))
    return {fault for fault in found if not fault[3].startswith("clang-diagnostic")}


def blind(folder):
    """The checks that do not see their planted fault."""
    found = tidy("\n".join(SEEN_OF_PLANTED.values()) + "\n", ["-std=c++17"], folder, "planted")
    seen = {check for _, _, _, checks in found for check in checks.split(",")}
    return sorted(set(SEEN_OF_PLANTED) - seen)


def main(build, *wanted):
    with tempfile.TemporaryDirectory() as folder:
        faults = [f"{check} does not see its planted fault" for check in blind(folder)]
        chosen = units(pathlib.Path(build).resolve())
        if not {pathlib.Path("src/geometry"), pathlib.Path("src/tools/recognize.cpp")} <= set(chosen):
            faults.append(f"{build} does not compile src/: is it a Ninja build?")
        if wanted:
            chosen = {pathlib.Path(unit): chosen[pathlib.Path(unit)] for unit in wanted}

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            runs = [pool.submit(tidy, "".join(f'#include "{source}"\n' for source in sources), options, folder, str(unit))
                    for unit, (sources, options) in chosen.items()]
            found = set().union(*(run.result() for run in runs))

    faults += [f"{os.path.relpath(file, ROOT)}:{line}: {what} [{check}]" for file, line, what, check in sorted(found)]
    print("\n".join(faults) or f"nothing found in {len(chosen)} units")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
