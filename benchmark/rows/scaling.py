"""How the time grows with the number of models, with the image, and with the CAD; what is found along with it.

Models: the first images of test sets of benchmark/corpus (MONOCULAR_EYE_HAND_CORPUS, which also holds `parts`), searched for
their own five models and for others that they do not show. Images and CAD: scenes of the package's own parts."""
import json
import os
import pathlib
import statistics

import meshes
from figures import CannotMeasure, Figure, corpus_folders, share
from plots import log_plot

MODELS = {5: None, 20: 1.7, 100: 4.0}   # and most times the time of the first
SETS = 4                                # test sets that are searched with more models
SIZES = {"640x480": None, "1280x960": None, "4000x3000": 3.0}  # and most times the time of the first
IMAGES = 4                              # of a level and size, twice as many of the CAD scenes
OTHER_CAD = 2.5                         # most times bridge's time


def figures(bench):
    curves = {}
    for part in (models, sizes, cad):
        yield from part(bench, curves)
    bench.plot("scaling", log_plot(curves, "Time of an image over the first of its kind", "models; pixels over 640x480",
                                   "times"))


def models(bench, curves):
    """Time and objects found with 20 and 100 models over those with the five that the images show."""
    folders = corpus_folders("test")[:SETS]
    parts = pathlib.Path(os.environ["MONOCULAR_EYE_HAND_CORPUS"]) / "parts"
    if not (parts / "parts.json").exists():
        raise CannotMeasure(f"{parts} has no parts.json: benchmark/corpus/make_parts.py --out {parts}")
    runs = {}
    for count in MODELS:
        scenes = [scene for folder in folders
                  for scene in bench.evaluate_folder(folder, "dev", "--models", with_others(bench, folder, parts, count)).values()]
        runs[count] = (sum(scene.median_seconds for scene in scenes), *map(sum, zip(*(scene.counts() for scene in scenes))))
    seconds, found = runs[5][:2]
    curves["models over 5"] = [(count / 5, run[0] / seconds) for count, run in runs.items()]
    for count, most in MODELS.items():
        time, now_found, instances, right, estimates = runs[count]
        conditions = f"{len(folders)} test sets of five models; right {right} of {estimates}; one thread"
        yield Figure(f"found with {count} models", share(now_found, instances), "%",
                     most and f">= {share(found, instances) - 1:.1f}", conditions=conditions)
        if most:
            yield Figure(f"time with {count} models over five", time / seconds, "times", f"<= {most}", conditions=conditions)


def with_others(bench, folder, parts, count):
    """A folder of the data set's own models and of others, `count` in all."""
    target = bench.out / f"models_{folder.name}_{count}"
    target.mkdir(exist_ok=True)
    infos = json.loads((folder / "models" / "models_info.json").read_text(encoding="utf-8"))
    sources = {key: folder / "models" / f"obj_{int(key):06d}.ply" for key in infos}
    shown = {info["name"] for info in infos.values()}
    for part in json.loads((parts / "parts.json").read_text(encoding="utf-8")):
        name = f"{part['name']}_{part['id']:06d}"
        if len(infos) >= count or name in shown or part["split"] == "test":
            continue
        key = str(1000 + part["id"])
        infos[key] = {"name": name, "diameter": part["diameter_mm"]}
        sources[key] = parts / f"obj_{part['id']:06d}.ply"
    if len(infos) < count:
        raise CannotMeasure(f"{parts} holds too few parts for {count} models")
    (target / "models_info.json").write_text(json.dumps(infos), encoding="utf-8")
    for key, source in sources.items():
        link = target / f"obj_{int(key):06d}.ply"
        link.unlink(missing_ok=True)
        link.symlink_to(source.resolve())
    return target


def sizes(bench, curves):
    """The same scenes in more pixels."""
    times, recall = {}, {}
    for size in SIZES:
        folder = bench.out / f"scaling_{size}"
        for scene, level in enumerate(("easy", "medium", "hard"), 1):
            bench.render(folder, bench.root / "config" / "objects.yaml", level, IMAGES, "--sizes", f"{size}:1", scene=scene)
        scenes = bench.evaluate_folder(folder, "dev").values()
        times[size] = statistics.mean(scene.median_seconds for scene in scenes)
        recall[size] = statistics.mean(scene.average_recall for scene in scenes)
    first = next(iter(SIZES))
    curves["pixels"] = [(pixels(size) / pixels(first), times[size] / times[first]) for size in SIZES]
    for size, most in SIZES.items():
        yield Figure(f"AR at {size}", recall[size], "0..1", most and f">= {recall[first]:.2f}",
                     conditions=f"{IMAGES} images a level of the cell's five parts, errors over the width; one thread")
        yield Figure(f"time at {size} over {first}", times[size] / times[first], "times", most and f"<= {most}",
                     conditions=f"{times[size]:.2f} s, the mean of the levels' medians")


def pixels(size):
    width, height = map(int, size.split("x"))
    return width * height


def cad(bench, curves):
    """One model at a time in the same images."""
    folder = bench.out / "scaling_cad"
    bench.run("render_scene", "--objects", bench.root / "config" / "objects.yaml", "--out", folder, "--level", "medium",
              "--count", 2 * IMAGES)
    bridge = bench.root / "models" / "bridge.ply"
    block = bench.data("real_parts") / "aluminium_block" / "models" / "obj_000001.ply"
    parts = {"bridge": bridge, "aluminium block": block, "housing": meshes.plate(10, 4), "bolt": meshes.bolt(),
             "scan": meshes.scan()}
    seconds, conditions = {}, {}
    for name, part in parts.items():
        objects = meshes.objects_file(folder, name, part)
        report = json.loads(bench.run("recognize", "--objects", objects, "--camera", folder / "camera.yaml",
                                      "--set", "threads=1", "--json", "-", *sorted(folder.glob("*.png"))))
        seconds[name] = statistics.median(image["seconds"] for image in report["images"])
        conditions[name] = f"{seconds[name]:.3f} s, median of {len(report['images'])} images; one model, one thread"
    for name in parts:
        if name != "bridge":
            yield Figure(f"time for {name} over bridge", seconds[name] / seconds["bridge"], "times", f"<= {OTHER_CAD}",
                         conditions=conditions[name])
