"""What a second thread brings: time of the work cell's images on one thread over that on two, and the answers."""
import csv

from figures import Figure


def figures(bench):
    one, two = (runs(bench, threads) for threads in (1, 2))
    for scene in sorted({scene for scene, _ in one["seconds"]}):
        times = [sum(seconds for key, seconds in run["seconds"].items() if key[0] == scene) for run in (one, two)]
        yield Figure(f"time on one thread over two, scene {scene}", times[0] / times[1], "times", ">= 1.8",
                     conditions=f"{times[0]:.1f} and {times[1]:.1f} s, five models; wants two cores with nothing else to do")
    differing = len(set(one["poses"]) ^ set(two["poses"]))
    yield Figure("poses of one run that the other has not, bit by bit", differing, "poses", "<= 0",
                 conditions=f"{len(one['poses'])} poses")


def runs(bench, threads):
    """Seconds by (scene, image), and the poses with their scores."""
    results = bench.results("workcell", "dev", "--set", f"threads={threads}")
    with open(results, newline="", encoding="utf-8") as file:
        poses = [tuple(value for key, value in row.items() if key != "time") for row in csv.DictReader(file)]
    with open(results.with_suffix(".times.csv"), newline="", encoding="utf-8") as file:
        seconds = {(row["scene_id"], row["im_id"]): float(row["time"]) for row in csv.DictReader(file)}
    return {"poses": poses, "seconds": seconds}
