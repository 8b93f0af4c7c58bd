"""Median time of a 640x480 image with all five models of the work cell, one thread, beside EdgeDrawing's features alone."""
from figures import CannotMeasure, Figure

# Of a scene: its level, most seconds, and most times EdgeDrawing's time.
SCENES = {1: ("easy", "<= 0.5", "<= 17"), 2: ("medium", None, "<= 29"), 3: ("hard", "<= 1.5", "<= 43")}
PEER = "BM_FrontEnd/0/0"  # of the work cell's images in the size that they have


def figures(bench):
    scenes = bench.evaluate("workcell", "dev")
    for number, scene in scenes.items():
        label, seconds, _ = described(number)
        yield Figure(f"median, {label}", scene.median_seconds, "s", seconds,
                     conditions="plain images, wall-clock time from image to objects; default options, one thread")

    peer = bench.speed("features", f"--benchmark_filter={PEER}/").get(f"{PEER}/iterations:1")
    if not peer:
        raise CannotMeasure("the data lack the images of the work cell")
    peer_ms = peer["peer_ms"]
    for number, scene in scenes.items():
        label, _, times = described(number)
        yield Figure(f"the same over lines and ellipses by EdgeDrawing, {label}", 1e3 * scene.median_seconds / peer_ms,
                     "times", times, "EdgeDrawing", 1, f"{peer_ms:.2f} ms of CPU time, the median of the same images")


def described(number):
    name, seconds, times = SCENES.get(number, ("", None, None))
    return f"scene {number} {name}".strip(), seconds, times
