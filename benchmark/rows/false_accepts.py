"""Objects reported in camera images that do not show them."""
import csv

from figures import Figure

# real_parts/negatives: objects that each image shows; all others are absent.
SHOWN = {**dict.fromkeys((0, 1, 2), {1}), **dict.fromkeys((3, 4, 5), {2}), **dict.fromkeys((6, 7, 8), {3}),
         **dict.fromkeys((9, 10), {6, 7})}


def figures(bench):
    with open(bench.results("real_parts/negatives", "test"), newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    false = [row for row in rows if int(row["obj_id"]) not in SHOWN[int(row["im_id"])]]
    yield Figure("false accepts", len(false), "objects", "<= 0",
                 conditions=f"images searched for 11 objects each, {len(rows)} reported; default options")
