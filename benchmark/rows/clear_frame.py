"""The task end to end: random scenes of the work cell, cleared by the nodes that drive a real arm."""
import json
import os
import statistics
import subprocess
import sys
import time

from figures import CannotMeasure, Figure

SCENES = int(os.environ.get("CLEAR_FRAME_SCENES", "50"))  # fewer for a quick look


def figures(bench):
    script = bench.root / "scripts" / "clear_frame.py"
    setup = bench.programs.parents[1] / "setup.bash"
    if not setup.exists():
        raise CannotMeasure(f"{setup} is missing: the task needs the build with ROS")
    reports = []
    begin = time.time()
    for seed in range(SCENES):
        out = bench.out / "clear_frame" / str(seed)
        print(f"  clear_frame seed {seed}", file=sys.stderr, flush=True)
        out.mkdir(parents=True, exist_ok=True)
        report = out / "report.json"
        report.unlink(missing_ok=True)
        with open(out / "log", "w", encoding="utf-8") as log:
            subprocess.run(["bash", "-c", f". '{setup}' && '{script}' --seed {seed} --out '{out}'"], stdout=log,
                           stderr=subprocess.STDOUT, check=False)
        reports.append(json.loads(report.read_text(encoding="utf-8")) if report.exists() else None)
    minutes = (time.time() - begin) / 60
    ran = [r for r in reports if r]
    if not ran:
        raise CannotMeasure(f"no scene ran, see {bench.out / 'clear_frame'}")
    picks = [p for r in ran for p in r["picks"] if "grasp_error_mm" in p]
    how = f"seeds 0 to {SCENES - 1}, 3 objects each; a scene that could not be run counts as not cleared"
    yield Figure("scenes with every object carried out", 100 * sum(r["cleared"] for r in ran) / SCENES, "%", ">= 95",
                 conditions=how)
    yield Figure("objects carried out", 100 * sum(o["in_drop_zone"] for r in ran for o in r["objects"]) / (3 * SCENES),
                 "%", conditions=how)
    yield Figure("collisions with the true geometry", sum(r["collisions"] for r in ran), "", "<= 0", conditions=how)
    if picks:
        how = f"{len(picks)} picks: the hand against the true object, modulo its symmetries"
        yield Figure("grasp position error, median", statistics.median(p["grasp_error_mm"] for p in picks), "mm", "<= 2",
                     conditions=how)
        yield Figure("grasp rotation error, median", statistics.median(p["grasp_error_deg"] for p in picks), "deg", "<= 1",
                     conditions=how)
    cleared = [r["cell_seconds"] for r in ran if r["cleared"]]
    if cleared:
        yield Figure("cell time of a scene, longest", max(cleared), "s", "<= 60", conditions="scenes that were cleared")
        yield Figure("cell time of a scene, median", statistics.median(cleared), "s")
    yield Figure("all scenes", minutes, "min", "<= 40", conditions="wall clock")
