"""Median time of a 640x480 image with all five models of the work cell, one thread, beside EdgeDrawing's features alone."""
from figures import Figure

SCENES = {1: ("easy", "<= 17"), 2: ("medium", "<= 29"), 3: ("hard", "<= 43")}
PEER = "BM_FrontEnd/0/0"  # of the work cell's images in the size that they have


def figures(bench):
    scenes = bench.evaluate("workcell", "dev")
    peer_ms = bench.speed("features", f"--benchmark_filter={PEER}/")[f"{PEER}/iterations:1"]["peer_ms"]
    for number, scene in scenes.items():
        name, target = SCENES.get(number, ("", None))
        label = f"scene {number} {name}".strip()
        yield Figure(f"median, {label}", scene.median_seconds, "s",
                     conditions="plain images, wall-clock time from image to objects; default options, one thread")
        yield Figure(f"the same over lines and ellipses by EdgeDrawing, {label}", 1e3 * scene.median_seconds / peer_ms,
                     "times", target, "EdgeDrawing", 1, f"{peer_ms:.2f} ms, the median of the same images")
