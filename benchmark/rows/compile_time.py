"""Time and memory of compiling a CAD file of 20 000 triangles and 1000 edges, which the node does once."""
import os
import struct
import subprocess
import sys
import tempfile
import time

from figures import CannotMeasure, Figure

BOSSES = 9       # square bosses along each side of a plate, each 12 edges
DIVISIONS = 3    # of the side of a boss, which triangles fill
SIDE_MM = 6.0    # of a boss, as high as wide, and of the gap between two


def figures(bench):
    path = bench.out / "compile_time.stl"
    triangles = write_plate(path)
    command = [bench.program("model_check"), path]
    print("  model_check", path.name, file=sys.stderr, flush=True)
    with tempfile.TemporaryDirectory() as empty_cache:  # what an earlier run compiled must not be read
        start = time.monotonic()
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                   env={**os.environ, "XDG_CACHE_HOME": empty_cache})
        text = process.stdout.read()
        _, status, used = os.wait4(process.pid, 0)
        seconds = time.monotonic() - start
    if status:
        raise CannotMeasure(f"model_check ended with status {status}")

    edges = next((line.split("edges")[1].strip() for line in text.splitlines() if line.startswith("  edges")), "?")
    conditions = f"{triangles} triangles, {edges}; reading, features, symmetries and views"
    yield Figure("CPU time", used.ru_utime + used.ru_stime, "s", "<= 3", conditions=conditions)
    yield Figure("time from start to end", seconds, "s", conditions=conditions)
    yield Figure("memory at most", used.ru_maxrss / 1024, "MB", "<= 300", conditions=conditions)


def write_plate(path):
    """A plate with a grid of square bosses as binary STL [mm]; the number of its triangles."""
    cells = 2 * BOSSES + 1
    step = SIDE_MM / DIVISIONS

    def is_boss(x, y):
        return 0 <= x < cells and 0 <= y < cells and x % 2 == 1 and y % 2 == 1

    quads = []

    def wall(corner, along, up):
        """A cell's side or top, in DIVISIONS x DIVISIONS quads; its normal is along x up."""
        for i in range(DIVISIONS):
            for k in range(DIVISIONS):
                quads.append([[corner[a] + step * ((i + u) * along[a] + (k + v) * up[a]) for a in range(3)]
                              for u, v in ((0, 0), (1, 0), (1, 1), (0, 1))])

    end = cells * SIDE_MM
    for x in range(cells):
        for y in range(cells):
            left, near, top = x * SIDE_MM, y * SIDE_MM, SIDE_MM * is_boss(x, y)
            wall((left, near, top), (1, 0, 0), (0, 1, 0))
            wall((left, near, -SIDE_MM), (0, 1, 0), (1, 0, 0))
            if is_boss(x, y):
                wall((left, near, 0), (1, 0, 0), (0, 0, 1))
                wall((left + SIDE_MM, near, 0), (0, 1, 0), (0, 0, 1))
                wall((left + SIDE_MM, near + SIDE_MM, 0), (-1, 0, 0), (0, 0, 1))
                wall((left, near + SIDE_MM, 0), (0, -1, 0), (0, 0, 1))
    for i in range(cells):
        at = i * SIDE_MM
        wall((at, 0, -SIDE_MM), (1, 0, 0), (0, 0, 1))
        wall((end, at, -SIDE_MM), (0, 1, 0), (0, 0, 1))
        wall((end - at, end, -SIDE_MM), (-1, 0, 0), (0, 0, 1))
        wall((0, end - at, -SIDE_MM), (0, -1, 0), (0, 0, 1))

    with open(path, "wb") as file:
        file.write(b"\0" * 80 + struct.pack("<I", 2 * len(quads)))
        for a, b, c, d in quads:
            for triangle in ((a, b, c), (a, c, d)):
                file.write(struct.pack("<12fH", 0, 0, 0, *triangle[0], *triangle[1], *triangle[2], 0))
    return 2 * len(quads)
