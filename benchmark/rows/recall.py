"""Parts with a right pose among the judged candidates: what the search leaves to the decision."""
import csv
import json

from figures import Figure, is_right, share

LEAST_VISIBLE = 0.5  # of a part, for it to count
LEVELS = {1: "easy", 2: "medium", 3: "hard"}
TARGETS = {("workcell", 1): ">= 99", ("workcell", 2): ">= 96", ("workcell", 3): ">= 93"}


def figures(bench):
    for dataset in ("workcell", "industrial"):
        parts = seen_parts(bench.data(dataset) / "dev")
        with open(bench.dump(dataset, "dev"), newline="", encoding="utf-8") as file:
            right = {key(row) for row in csv.DictReader(file) if is_right(row)}
        for number in sorted({scene for scene, _, _ in parts}):
            all_parts = {part for part in parts if part[0] == number}
            found = len(all_parts & right)
            yield Figure(f"recall among the judged, {dataset}, scene {number} {LEVELS.get(number, '')}".strip(),
                         share(found, len(all_parts)), "%", TARGETS.get((dataset, number)),
                         conditions=f"{found} of {len(all_parts)} parts seen by half and more")


def key(row):
    return int(row["scene_id"]), int(row["im_id"]), int(row["gt_id"])


def seen_parts(split):
    """(scene, image, index) of the parts that the images show well enough."""
    parts = set()
    for path in split.glob("*/scene_gt_info.json"):
        images = json.loads(path.read_text(encoding="utf-8"))
        parts |= {(int(path.parent.name), int(image), index) for image, entries in images.items()
                  for index, entry in enumerate(entries) if entry["visib_fract"] >= LEAST_VISIBLE}
    return parts
