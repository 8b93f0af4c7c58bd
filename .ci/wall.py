#!/usr/bin/python3
"""wall.py BUILD DEVEL   rooms and tools know no ROS, and each room only the floors below it.

On Debian the ROS headers lie in /usr/include, so the compiler alone does not keep this wall. Read are the dependency
files of every object compiled from src/ and the libraries that every room and tool asks for. The nodes are the
control: seen without ROS, they would show that this check is blind."""
import pathlib
import re
import sys

sys.dont_write_bytecode = True
import debian

PACKAGE = "monocular_eye_hand"


def room_order(root):
    text = (root / "CMakeLists.txt").read_text()
    return re.search(r"set\(MONOCULAR_EYE_HAND_ROOMS\s+([^)]*)\)", text)[1].split()


def targets(build, devel):
    """(room, target, binary) of every library and program made from src/, from the folders of their objects."""
    for folder in sorted(build.glob("src/*/CMakeFiles/*.dir")):
        if not any(folder.rglob("*.o")):
            continue
        room, target = folder.relative_to(build).parts[1], folder.name[:-len(".dir")]
        library = devel / "lib" / f"lib{target}.so"
        program = devel / "lib" / PACKAGE / re.sub(f"^{PACKAGE}_(tool|node|helper)_", "", target)
        if library.exists() or program.exists():
            yield room, target, library if library.exists() else program


def is_ros(package_sources, package):
    return package is not None and re.match(r"ros2?-", package_sources[package]) is not None


def header_faults(build, devel, order):
    read = {name: files for name, files in debian.dependencies(str(build)).items() if name.startswith("src/")}
    owner = debian.owners({file for files in read.values() for file in files if file.startswith("/usr/")})
    source = debian.sources(owner.values())
    ros_seen = set()
    for name, files in sorted(read.items()):
        room = name.split("/")[1]
        for file in files:
            if file.startswith(f"{devel}/") or is_ros(source, owner.get(file)):
                ros_seen.add(room)
                if room != "nodes":
                    yield f"{name} includes the ROS header {file}"
            header = re.search(f"/include/{PACKAGE}/([a-z_]+)/", file)
            if header and room in order and header[1] in order and order.index(header[1]) > order.index(room):
                yield f"{name} includes {header[1]}/{pathlib.Path(file).name}, a floor above {room}"
    rooms = {name.split("/")[1] for name in read}
    for room in [*order, "tools"]:
        if room not in rooms:
            yield f"no dependency file of {room} in {build}: is it a Ninja build, and built?"
    if "nodes" in rooms and "nodes" not in ros_seen:
        yield "no ROS header found in the nodes: this check does not see ROS headers"


def library_faults(build, devel, order):
    links = {target: (room, binary, debian.linked(str(binary)))
             for room, target, binary in targets(build, devel)}
    owner = debian.owners({path for _, _, needed in links.values() for path in needed.values() if path})
    source = debian.sources(owner.values())
    ros_seen = set()
    for room, binary, needed in links.values():
        for soname, path in needed.items():
            if path is None:
                yield f"{binary.name} asks for {soname}, which is not found"
            elif is_ros(source, owner[path]):
                ros_seen.add(room)
                if room != "nodes":
                    yield f"{binary.name} links the ROS library {path}"
            lower = re.match(f"lib{PACKAGE}_(.*)\\.so", soname)
            if lower and room in order and lower[1] in order and order.index(lower[1]) >= order.index(room):
                yield f"{binary.name} links {soname}, which is no floor below it"
    rooms_seen = {room for room, _, _ in links.values()}
    for room in [*order, "tools"]:
        if room not in rooms_seen:
            yield f"no library or program of {room} found below {devel}"
    if "nodes" in rooms_seen and "nodes" not in ros_seen:
        yield "no ROS library found in the nodes: this check does not see ROS libraries"


def main(build, devel):
    order = room_order(pathlib.Path(__file__).resolve().parent.parent)
    faults = list(header_faults(build, devel, order)) + list(library_faults(build, devel, order))
    print("\n".join(faults) if faults else "kept")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*(pathlib.Path(argument).resolve() for argument in sys.argv[1:3])))
