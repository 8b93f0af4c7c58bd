#!/usr/bin/python3
"""make_pairs.py --parts DIR --scenes DIR --out DIR   the same scenes, searched for other parts.

Of every data set of make_scenes.py in --scenes, with its images as they are:

  OUT/absent_NNN      parts of the next group, which no image shows: whatever is reported is wrong
  OUT/mirrored_NNN    the mirror images of its chiral parts: whatever is reported is wrong
  OUT/simplified_NNN  its parts whose CAD leaves out one of their details, for those that have such a mesh
  OUT/full_NNN        the same parts with all their details, to compare with

Data sets without such a part are left out.
"""
import argparse
import json
import pathlib
import re
import shutil


def read(path):
    return json.loads(path.read_text(encoding="utf-8"))


def write(path, value):
    path.write_text(json.dumps(value), encoding="utf-8")


def ids(scenes):
    """Of the parts that a data set is searched for."""
    return {int(number) for number in read(scenes / "models" / "models_info.json")}


def shown(scenes):
    """Of all parts that its images may show."""
    foreign = re.findall(r"name: \w*?_?(\d{6})\b", (scenes / "distractors.yaml").read_text(encoding="utf-8"))
    return ids(scenes) | {int(number) for number in foreign}


def make_models(out, meshes, info):
    """`meshes`: file by part; `info`: entry of models_info.json by part."""
    (out / "models").mkdir()
    for number, mesh in meshes.items():
        shutil.copy(mesh, out / "models" / f"obj_{number:06d}.ply")
    write(out / "models" / "models_info.json", {str(number): info[number] for number in meshes})


def link_images(scenes, out, kept):
    """The images of a data set with the truth of the parts `kept` alone."""
    shutil.copy(scenes / "camera.json", out / "camera.json")
    for scene in sorted((scenes / "dev").iterdir()):
        target = out / "dev" / scene.name
        target.mkdir(parents=True)
        (target / "gray").symlink_to((scene / "gray").resolve())
        shutil.copy(scene / "scene_camera.json", target)
        truth, seen = read(scene / "scene_gt.json"), read(scene / "scene_gt_info.json")
        for image, poses in truth.items():
            places = [k for k, pose in enumerate(poses) if pose["obj_id"] in kept]
            truth[image] = [poses[k] for k in places]
            seen[image] = [seen[image][k] for k in places]
        write(target / "scene_gt.json", truth)
        write(target / "scene_gt_info.json", seen)


def make_set(out, scenes, meshes, info, kept):
    if not meshes or out.exists():
        return
    out.mkdir(parents=True)
    make_models(out, meshes, info)
    link_images(scenes, out, kept)
    print(out, len(meshes), "parts", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--parts", type=pathlib.Path, required=True, help="folder of make_parts.py")
    parser.add_argument("--scenes", type=pathlib.Path, required=True, help="folder of make_scenes.py")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    folders = sorted(path for path in arguments.scenes.iterdir() if (path / "models" / "models_info.json").exists())
    info = {int(number): entry for folder in folders
            for number, entry in read(folder / "models" / "models_info.json").items()}

    def meshes(numbers, kind="."):
        files = {number: arguments.parts / kind / f"obj_{number:06d}.ply" for number in sorted(numbers)}
        return {number: mesh for number, mesh in files.items() if mesh.exists()}

    for k, scenes in enumerate(folders):
        tail = scenes.name.rsplit("_", 1)[-1]
        absent = ids(folders[(k + 1) % len(folders)]) - shown(scenes)
        simplified = meshes(ids(scenes), "simplified")
        make_set(arguments.out / f"absent_{tail}", scenes, meshes(absent), info, set())
        make_set(arguments.out / f"mirrored_{tail}", scenes, meshes(ids(scenes), "mirrored"), info, set())
        make_set(arguments.out / f"simplified_{tail}", scenes, simplified, info, set(simplified))
        make_set(arguments.out / f"full_{tail}", scenes, meshes(simplified), info, set(simplified))


if __name__ == "__main__":
    main()
