"""Objects reported in images that do not show them.

Of camera images, and of rendered ones searched for absent parts and for mirror images of chiral ones (make_pairs.py of
benchmark/corpus; MONOCULAR_EYE_HAND_CORPUS names their folder)."""
import csv
import json

from figures import CannotMeasure, Figure, corpus_folders

# real_parts/negatives: objects that each image shows; all others are absent.
SHOWN = {**dict.fromkeys((0, 1, 2), {1}), **dict.fromkeys((3, 4, 5), {2}), **dict.fromkeys((6, 7, 8), {3}),
         **dict.fromkeys((9, 10), {6, 7})}


def figures(bench):
    with open(bench.results("real_parts/negatives", "test"), newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    false = [row for row in rows if int(row["obj_id"]) not in SHOWN[int(row["im_id"])]]
    yield Figure("false accepts", len(false), "objects", "<= 0",
                 conditions=f"images searched for 11 objects each, {len(rows)} reported; default options")

    try:
        for kind in ("absent", "mirrored"):
            yield of_corpus(bench, kind)
    except CannotMeasure as missing:
        print(missing)


def of_corpus(bench, kind):
    """Everything that is reported in these data sets is wrong."""
    accepted = searches = 0
    for folder in corpus_folders(kind):
        accepted += sum(scene.estimates for scene in bench.evaluate_folder(folder, "dev").values())
        images = sum(len(json.loads(path.read_text(encoding="utf-8")))
                     for path in folder.glob("dev/*/scene_camera.json"))
        searches += images * len(json.loads((folder / "models" / "models_info.json").read_text(encoding="utf-8")))
    return Figure(f"false accepts, {kind} parts", 1000 * accepted / max(searches, 1), "per 1000", "<= 1",
                  conditions=f"{accepted} in {searches} searches")
