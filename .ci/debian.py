"""Which Debian package a file belongs to, and what the build read and linked."""
import functools
import os
import pathlib
import re
import subprocess


@functools.lru_cache(maxsize=1)
def _files():
    """{path: package} of everything installed; dpkg's own lists, since dpkg-query -S takes a minute for the paths of a build."""
    found = {}
    for entry in pathlib.Path("/var/lib/dpkg/info").glob("*.list"):
        package = entry.stem.split(":")[0]
        for path in entry.read_text().splitlines():
            found.setdefault(path, package)
    return found


def owners(paths):
    """{path: package, or None when no package owns it}, through links and the merged /usr."""
    names = {path: [path, os.path.realpath(path)] for path in paths}
    for candidates in names.values():
        for name in list(candidates):
            candidates.append(name[4:] if name.startswith("/usr/") else "/usr" + name)
    found = _files()
    return {path: next((found[name] for name in candidates if name in found), None)
            for path, candidates in names.items()}


def sources(packages):
    """{package: its source package}"""
    packages = sorted({package for package in packages if package})
    if not packages:
        return {}
    out = subprocess.run(["dpkg-query", "-W", "-f", "${Package} ${source:Package}\n", *packages],
                         capture_output=True, text=True, check=True).stdout
    return dict(line.split() for line in out.splitlines())


def dependencies(build):
    """{object file: [every file it was compiled from]} out of ninja's log."""
    out = subprocess.run(["ninja", "-C", build, "-t", "deps"], capture_output=True, text=True, check=True).stdout
    result, current = {}, None
    for line in out.splitlines():
        head = re.match(r"(\S.*): #deps \d+, deps mtime \d+ \((\w+)\)", line)
        if head:
            current = None
            if head[2] == "VALID":
                current = result.setdefault(head[1], [])
        elif line.startswith("    ") and current is not None:
            current.append(os.path.normpath(os.path.join(build, line.strip())))
    return result


def linked(binary):
    """{soname that the binary itself asks for: file it resolves to, or None}"""
    dynamic = subprocess.run(["readelf", "-d", binary], capture_output=True, text=True, check=True).stdout
    needed = re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic)
    resolved = dict(re.findall(r"^\s*(\S+) => (/\S+)", subprocess.run(
        ["ldd", binary], capture_output=True, text=True, check=True).stdout, re.M))
    return {soname: resolved.get(soname) for soname in needed if not soname.startswith("ld-linux")}
