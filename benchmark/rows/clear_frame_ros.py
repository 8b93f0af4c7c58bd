"""The same scenes cleared by the nodes that drive a real arm, and whether they end as without ROS."""
import contextlib
import json
import os
import statistics
import subprocess
import sys
import time

from clearing import outcome
from figures import CannotMeasure, Figure

SCENES = int(os.environ.get("CLEAR_FRAME_ROS_SCENES", "5"))
BUSY_LOOPS = 3 * (os.cpu_count() or 1)


def by_nodes(bench, kind, seed, arguments):
    """The report of one scene, or None when it could not be run."""
    setup = bench.programs.parents[1] / "setup.bash"
    if not setup.exists():
        raise CannotMeasure(f"{setup} is missing: the task needs the build with ROS")
    script = bench.root / "scripts" / "clear_frame.py"
    out = bench.out / "clear_frame_ros" / kind / str(seed)
    print(f"  clear_frame.py {kind}, seed {seed}", file=sys.stderr, flush=True)
    out.mkdir(parents=True, exist_ok=True)
    report = out / "report.json"
    report.unlink(missing_ok=True)
    with open(out / "log", "w", encoding="utf-8") as log:
        subprocess.run(["bash", "-c", f". '{setup}' && '{script}' --seed {seed} --out '{out}' {arguments}"], stdout=log,
                       stderr=subprocess.STDOUT, check=False)
    return json.loads(report.read_text(encoding="utf-8")) if report.exists() else None


def all_by_nodes(bench, kind, arguments=""):
    reports = [by_nodes(bench, kind, seed, arguments) for seed in range(SCENES)]
    ran = [report for report in reports if report]
    if not ran:
        raise CannotMeasure(f"no scene ran, see {bench.out / 'clear_frame_ros' / kind}")
    return ran


def without_ros(bench, seed):
    path = bench.out / "clear_frame_ros" / f"{seed}.json"
    subprocess.run([bench.program("clear_frame"), "--seed", str(seed), "--json", path], stdout=subprocess.DEVNULL, check=False)
    return json.loads(path.read_text(encoding="utf-8"))


def ending(report):
    """What became of the parts of a scene, and of the scene."""
    parts = {o["label"]: o["in_drop_zone"] for o in report["objects"]}
    return report["cleared"], report["collisions"], parts


@contextlib.contextmanager
def busy_machine():
    """Other programs that want all cores, three times over."""
    loops = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(BUSY_LOOPS)]
    try:
        yield
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()


def figures(bench):
    begin = time.time()
    ran = all_by_nodes(bench, "on_request")
    minutes = (time.time() - begin) / 60
    yield from outcome(ran, SCENES, "", ">= 100")

    begin = time.time()
    alone = {seed: without_ros(bench, seed) for seed in range(SCENES)}
    minutes_alone = (time.time() - begin) / 60
    same = sum(ending(report) == ending(alone[report["seed"]]) for report in ran)
    yield Figure("scenes that end as without ROS", 100 * same / SCENES, "%", ">= 100",
                 conditions="cleared or not, collisions, and which parts were carried out")
    yield Figure("all scenes", minutes, "min", peer="without ROS", peer_value=minutes_alone, conditions="wall clock")
    cell = [report["cell_seconds"] for report in ran if report["cleared"]]
    if cell:
        yield Figure("cell time of a scene, median", statistics.median(cell), "s")
        yield Figure("cell time of a scene, longest", max(cell), "s", "<= 60", conditions="scenes that were cleared")

    every_image = "continuous:=true images_in_motion:=true"
    yield from outcome(all_by_nodes(bench, "continuous", every_image), SCENES, ", every image recognised", ">= 100")
    with busy_machine():
        loaded = all_by_nodes(bench, "loaded")
    yield from outcome(loaded, SCENES, f", beside {BUSY_LOOPS} busy loops", ">= 100")
