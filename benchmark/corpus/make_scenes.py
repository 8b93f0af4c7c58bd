#!/usr/bin/python3
"""make_scenes.py --parts DIR --out DIR --programs DIR [...]   scenes of the parts that make_parts.py made, and what the
recogniser finds in them.

The parts are dealt out in groups of five of different families. Every group becomes a data set in the BOP format,
OUT/SPLIT_NNN: five parts that are searched for, of which an image shows some, between foreign parts of the same split
and clutter; scene 1 easy, 2 medium, 3 hard. `evaluate --dump` leaves dump.csv there: every candidate with its evidence
and its error, which fit_decision reads. What is there already is not made again.
"""
import argparse
import json
import pathlib
import random
import subprocess

GROUP = 5
FOREIGN = 6
LEVELS = ("easy", "medium", "hard")


def groups(parts, seed):
    """Groups of five parts, neighbours of different families."""
    draw = random.Random(seed)
    families = {}
    for part in parts:
        families.setdefault(part["family"], []).append(part)
    piles = [draw.sample(members, len(members)) for _, members in sorted(families.items())]
    draw.shuffle(piles)

    order = []
    while any(piles):
        order += [pile.pop() for pile in piles if pile]
    return [order[first:first + GROUP] for first in range(0, len(order), GROUP)]


def write_objects(path, parts, folder):
    lines = [f"  - {{name: {part['name']}_{part['id']:06d}, mesh: {(folder / 'obj_{:06d}.ply'.format(part['id'])).resolve()}, unit: mm}}"
             for part in parts]
    path.write_text("objects:\n" + "\n".join(lines) + "\n", encoding="utf-8")


def render(arguments, folder, number):
    for scene, level in enumerate(LEVELS, 1):
        if (folder / "dev" / f"{scene:06d}" / "scene_gt.json").exists():
            continue
        seed = 100000 * arguments.seed + 1000 * number + scene
        subprocess.run([arguments.programs / "render_scene", "--set", "random", "--objects", folder / "objects.yaml",
                        "--distractors", folder / "distractors.yaml", "--bop", folder, "--split", "dev", "--scene", str(scene),
                        "--level", level, "--count", str(arguments.count), "--seed", str(seed), "--sizes", arguments.sizes,
                        "--appearance", arguments.appearance], check=True, stdout=subprocess.DEVNULL)


def judge(arguments, folder):
    """Dumps the candidates of a data set; a dump that is not finished has another name."""
    if (folder / "dump.csv").exists():
        return
    part = folder / "dump.part"
    with open(folder / "evaluate.log", "w", encoding="utf-8") as log:
        subprocess.run([arguments.programs / "evaluate", "--dataset", folder, "--split", "dev", "--out", folder / "results.csv",
                        "--dump", part], check=True, stdout=log, stderr=log)
    part.rename(folder / "dump.csv")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--parts", type=pathlib.Path, required=True, help="folder of make_parts.py")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--programs", type=pathlib.Path, required=True, help="folder of render_scene and evaluate")
    parser.add_argument("--split", default="train", choices=("train", "test"))
    parser.add_argument("--count", type=int, default=8, help="images per group and level")
    parser.add_argument("--first", type=int, default=0, help="group to begin with")
    parser.add_argument("--groups", type=int, default=1000, help="most groups made")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--sizes", default="640x480:8,1280x720:2,1920x1080:1")
    parser.add_argument("--appearance", default="mixed", choices=("plain", "mixed"))
    arguments = parser.parse_args()
    parts = [part for part in json.loads((arguments.parts / "parts.json").read_text(encoding="utf-8"))
             if part["split"] == arguments.split]
    numbered = list(enumerate(groups(parts, arguments.seed)))
    for number, members in numbered[arguments.first:arguments.first + arguments.groups]:
        folder = arguments.out / f"{arguments.split}_{number:03d}"
        folder.mkdir(parents=True, exist_ok=True)
        others = [part for part in parts if part not in members]
        write_objects(folder / "objects.yaml", members, arguments.parts)
        write_objects(folder / "distractors.yaml", random.Random(number).sample(others, min(FOREIGN, len(others))),
                      arguments.parts)
        print(folder, flush=True)
        render(arguments, folder, number)
        judge(arguments, folder)


if __name__ == "__main__":
    main()
