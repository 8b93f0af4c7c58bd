"""The whole loop without ROS: random scenes of the work cell, cleared by the program clear_frame."""
import json
import os
import statistics
import subprocess
import sys
import time

from clearing import outcome
from figures import CannotMeasure, Figure

SCENES = int(os.environ.get("CLEAR_FRAME_SCENES", "50"))  # fewer for a quick look


def clear(bench, scenes):
    """The reports of scenes 0 to scenes - 1; those that could not be run are missing."""
    out = bench.out / "clear_frame"
    out.mkdir(parents=True, exist_ok=True)
    path = out / "report.json"
    path.unlink(missing_ok=True)
    print(f"  clear_frame --seeds 0-{scenes - 1}", file=sys.stderr, flush=True)
    with open(out / "log", "w", encoding="utf-8") as log:
        subprocess.run([bench.program("clear_frame"), "--seeds", f"0-{scenes - 1}", "--json", path], stdout=log,
                       stderr=subprocess.STDOUT, check=False)
    if not path.exists():
        raise CannotMeasure(f"no scene ran, see {out / 'log'}")
    return json.loads(path.read_text(encoding="utf-8"))["scenes"]


def precision(ran):
    picks = [pick for report in ran for pick in report["picks"] if "grasp_error_mm" in pick]
    if not picks:
        return
    conditions = f"{len(picks)} picks: the hand against the true object, modulo its symmetries"
    yield Figure("grasp position error, median", statistics.median(p["grasp_error_mm"] for p in picks), "mm", "<= 2",
                 conditions=conditions)
    yield Figure("grasp position error, largest", max(p["grasp_error_mm"] for p in picks), "mm", conditions=conditions)
    yield Figure("grasp rotation error, median", statistics.median(p["grasp_error_deg"] for p in picks), "deg", "<= 1",
                 conditions=conditions)


def times(ran, minutes):
    yield Figure("cell time of a scene, median", statistics.median(report["cell_seconds"] for report in ran), "s")
    yield Figure("cell time of a scene, longest", max(report["cell_seconds"] for report in ran), "s", "<= 60")
    yield Figure("time of a scene, median", statistics.median(report["wall_s"]["all"] for report in ran), "s",
                 conditions="wall clock, one process")
    everything = sum(report["wall_s"]["all"] for report in ran)
    for part in ("recognition", "rendering", "planning", "grasps", "motion"):
        yield Figure(f"of that {part}", 100 * sum(report["wall_s"][part] for report in ran) / everything, "%")
    yield Figure("all scenes", minutes, "min", "<= 17", conditions="wall clock; a third of the ROS graph's time")


def figures(bench):
    begin = time.time()
    ran = clear(bench, SCENES)
    minutes = (time.time() - begin) / 60
    yield from outcome(ran, SCENES, "", ">= 100")
    yield from precision(ran)
    yield from times(ran, minutes)
