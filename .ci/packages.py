#!/usr/bin/python3
"""packages.py BUILD DEVEL   scripts/packages.txt is enough for a machine that has nothing.

apt simulates the installation of the list on an empty system. Whatever the build read (headers, CMake packages), its
programs load (libraries), and scripts, launch files and Python files call must come from a package of that set. What
demo.sh and test.sh use must come from the sections that they install; [benchmark] and [ci] only serve their own."""
import ast
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

sys.dont_write_bytecode = True
import debian

ROOT = pathlib.Path(__file__).resolve().parent.parent
USER_SECTIONS = ("build", "ros", "test")
# Commands of the scripts and the README, and of the checks, that Debian's base system does not have.
COMMANDS = """catkin_test_results cmake ctest g++ ninja python3 rosbag roslaunch rosnode rospack rosrun rosservice
              rostest rostopic rviz""".split()
BENCHMARK_CMAKE_PACKAGES = ("benchmark", "Ceres", "gflags", "glog")  # asked for by benchmark/, and by Ceres
CI_COMMANDS = "catkin_lint clang-format git ldd readelf".split()


def listed():
    """{section: packages} of scripts/packages.txt"""
    sections = {}
    for line in (ROOT / "scripts/packages.txt").read_text().splitlines():
        if line.startswith("["):
            names = sections.setdefault(line.strip("[]"), [])
        elif line and not line.startswith("#"):
            names.append(line)
    return sections


def simulated(packages):
    run = subprocess.run(["apt-get", "-o", "Dir::State::status=/dev/null", "-s", "install",
                          "--no-install-recommends", *packages], capture_output=True, text=True)
    if run.returncode:
        sys.exit(f"apt-get cannot install the list on a bare machine:\n{run.stderr}")
    return set(re.findall(r"^Inst (\S+)", run.stdout, re.M))


def base_system():
    """Packages that every Debian machine has."""
    out = subprocess.run(["dpkg-query", "-W", "-f", "${Package} ${Essential} ${Priority}\n"],
                         capture_output=True, text=True, check=True).stdout
    return {line.split()[0] for line in out.splitlines() if line.split()[1] == "yes" or line.endswith(" required")}


def tracked(*patterns):
    out = subprocess.run(["git", "-C", str(ROOT), "ls-files", *patterns], capture_output=True, text=True, check=True)
    return [ROOT / name for name in out.stdout.splitlines()]


def compiled_from(build, benchmarks):
    for name, files in debian.dependencies(str(build)).items():
        if name.startswith("benchmark/") == benchmarks:
            yield from (file for file in files if file.startswith("/usr/"))


def found_by_cmake(build, benchmarks):
    for name, path in re.findall(r"^(\w+)_DIR:PATH=(/usr/.*)$", (build / "CMakeCache.txt").read_text(), re.M):
        if (name in BENCHMARK_CMAKE_PACKAGES) == benchmarks:
            yield from sorted(str(file) for file in pathlib.Path(path).glob("*onfig.cmake"))[:1]


def loaded(binaries):
    for binary in binaries:
        if binary.is_file() and binary.open("rb").read(4) == b"\x7fELF":
            yield from (path for path in debian.linked(str(binary)).values() if path and path.startswith(("/usr", "/lib")))


def launched():
    """Manifest and program of every node of a launch or test file that is not the package's own."""
    for path in tracked("*.launch", "*.test"):
        for node in [*ElementTree.parse(path).iter("node"), *ElementTree.parse(path).iter("test")]:
            package, program = node.get("pkg"), node.get("type") or node.get("test-name")
            if package == "monocular_eye_hand":
                continue
            places = [f"/usr/lib/{package}/{program}", f"/usr/share/{package}/{program}", f"/usr/bin/{program}",
                      *map(str, pathlib.Path("/usr/lib").glob(f"*/{package}/{program}"))]
            yield next((place for place in places if os.path.exists(place)),
                       f"{path.relative_to(ROOT)}: {package}/{program}")
            yield f"/usr/share/{package}/package.xml"


def imported():
    own = {path.stem for path in tracked("*.py")} | {"monocular_eye_hand"}
    for path in tracked("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else \
                [node.module] if isinstance(node, ast.ImportFrom) and node.module and not node.level else []
            for module in {name.split(".")[0] for name in names} - own - set(sys.stdlib_module_names):
                spec = importlib.util.find_spec(module)
                yield (spec and spec.origin) or f"{path.relative_to(ROOT)}: import {module}"


def missing(kind, paths, available):
    """One line per package that owns some of the paths and is not available."""
    by_package = {}
    for path, package in debian.owners(paths).items():
        if package not in available:
            by_package.setdefault(package, []).append(path)
    for package, users in sorted(by_package.items(), key=str):
        more = f" and {len(users) - 1} more" if len(users) > 1 else ""
        yield f"{kind} of {package or 'no package'}, which the list does not bring: {sorted(users)[0]}{more}"


def main(build, devel):
    sections = listed()
    names = [name for packages in sections.values() for name in packages]
    base = base_system()
    for_users = simulated([name for section in USER_SECTIONS for name in sections[section]]) | base
    for_all = simulated(names) | base
    programs = [*devel.glob("lib/*.so"), *devel.glob("lib/monocular_eye_hand/*"), *build.glob("test/*/*")]
    uses = [("header", compiled_from(build, False), for_users),
            ("CMake package", found_by_cmake(build, False), for_users),
            ("library", loaded(programs), for_users),
            ("command", (shutil.which(name) or name for name in COMMANDS), for_users),
            ("launched program", launched(), for_users),
            ("python module", imported(), for_users),
            ("benchmarks' header", compiled_from(build, True), for_all),
            ("benchmarks' CMake package", found_by_cmake(build, True), for_all),
            ("benchmarks' library", loaded(build.glob("benchmark/bench_*")), for_all),
            ("command of the checks", (shutil.which(name) or name for name in CI_COMMANDS), for_all)]
    faults = [f"{name}: listed twice" for name in sorted({name for name in names if names.count(name) > 1})]
    for kind, paths, available in uses:
        paths = {path for path in paths if not path.startswith((str(build), str(devel), str(ROOT) + "/src"))}
        print(f"{kind}: {len(paths)} files looked up")
        faults += missing(kind, paths, available)
        if not paths and kind in ("header", "CMake package", "library"):
            faults.append(f"no {kind} found in {build}: nothing was checked")
    print("\n".join(faults) if faults else f"complete: {len(names)} packages listed, {len(for_all)} with what they need")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*(pathlib.Path(argument).resolve() for argument in sys.argv[1:3])))
