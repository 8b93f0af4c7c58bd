"""Time and memory of compiling a CAD file of 20 000 triangles and 1000 edges, which the node does once."""
import os
import subprocess
import sys
import tempfile
import time

from figures import CannotMeasure, Figure
from meshes import plate, write_stl

BOSSES = 9       # square bosses along each side of a plate, each 12 edges
DIVISIONS = 3    # of the side of a boss, which triangles fill


def figures(bench):
    path = bench.out / "compile_time.stl"
    triangles = write_stl(path, plate(BOSSES, DIVISIONS))
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
