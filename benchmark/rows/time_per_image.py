"""Median seconds per 640x480 image with all five models of the work cell, one thread."""
from figures import Figure

SCENES = {1: ("easy", "<= 0.5"), 2: ("medium", None), 3: ("hard", "<= 1.5")}


def figures(bench):
    for number, scene in bench.evaluate("workcell", "dev").items():
        name, target = SCENES.get(number, ("", None))
        yield Figure(f"median, scene {number} {name}".strip(), scene.median_seconds, "s", target,
                     conditions="plain images, wall-clock time from image to objects; default options, one thread")
