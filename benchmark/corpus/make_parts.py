#!/usr/bin/python3
"""make_parts.py --out DIR : industrial CAD parts for learning and testing the recogniser's decision.

Every part is drawn at random from a family (families.py) and built by the OpenCASCADE kernel (section [corpus] of
scripts/packages.txt); the same seed makes the same meshes, whichever families are asked for. DIR receives

  obj_NNNNNN.ply             millimetres, closed, oriented outwards, its bounding box centred on the origin
  simplified/obj_NNNNNN.ply  the same part in the same place without one of its details
  mirrored/obj_NNNNNN.ply    the mirror image, by x -> -x, of a chiral part
  parts.json                 a list of {id, name, family, split, diameter_mm, triangles, ...}

The measures in parts.json: `faces` and `edges` of the solid; `facing_faces`, those that look towards the viewer in the
mean; `half_turn` and `mirror`, how far the part is from its half turns and from its mirror image (self_distances in
mesh.py). `details` are those that the family can leave out of this part; `simplified` and `mirrored` tell the files.
Parts of an earlier run in DIR are removed.
"""
import argparse
import json
import pathlib
import time
import typing

import numpy as np

import cad
import mesh
from families import FAMILIES, split_of
from part import Failure, Part

ATTEMPTS = 30
FACING_FACES = (2, 85)
SIMPLIFIED_EVERY = 4  # one part of so many is also written without a detail, if it has any
CHIRAL = 0.05  # a part whose mirror image stays farther away, over the diameter, is chiral
SMALLEST_CHANGE = 1e-4  # of the volume, that a detail makes


def parsed():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder of the parts")
    parser.add_argument("--count-per-family", type=int, default=5)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--families", help="names, comma between them; all without it")
    arguments = parser.parse_args()
    wanted = arguments.families.split(",") if arguments.families else list(FAMILIES)
    unknown = [name for name in wanted if name not in FAMILIES]
    if unknown:
        parser.error(f"--families: no family {', '.join(unknown)}; there are {', '.join(FAMILIES)}")

    if arguments.count_per_family < 1:
        parser.error("--count-per-family: must be 1 or more")

    arguments.families = wanted
    return arguments


class Drawn(typing.NamedTuple):
    """A usable part, its mesh, and the seed of the draw that made it."""
    seed: str
    part: Part
    vertices: np.ndarray
    triangles: np.ndarray
    centre: np.ndarray  # where the mesh's origin lies in the solid's coordinates
    facing_faces: float


def built(family, seed, member, without=()):
    """The finished part of one draw; throws Failure when it is no single valid solid."""
    part = Part(seed, without, member)
    try:
        FAMILIES[family](part)
        part.clean()
        shape = part.solid
        if not shape.isValid() or len(shape.Solids) != 1 or shape.Volume <= 0:
            raise Failure(f"{len(shape.Solids)} solids, valid: {shape.isValid()}")
    except cad.KernelError as error:
        raise Failure(str(error).strip()[:80]) from error

    part.solid = shape.Solids[0]
    return part


def exported(solid, seed):
    """The mesh of a solid as a CAD system exports it: tolerances by its size, different from part to part."""
    draw = Part(f"{seed}/mesh")
    deflection = min(max(solid.BoundBox.DiagonalLength * draw.random.uniform(0.0004, 0.0008), 0.04), 0.1)
    vertices, triangles, centre = mesh.tessellated(solid, deflection, draw.random.uniform(10, 15))
    mesh.check(vertices, triangles)
    return vertices, triangles, centre


def drawn(family, member, seed):
    """The first draw that makes a usable part."""
    for attempt in range(ATTEMPTS):
        name = f"{seed}/{attempt}"
        try:
            part = built(family, name, member)
            vertices, triangles, centre = exported(part.solid, name)
            facing = mesh.facing_faces(part.solid)
            if not FACING_FACES[0] <= facing <= FACING_FACES[1]:
                raise Failure(f"{facing} faces in view")
        except Failure as failure:
            print(f"  {family} {name}: {failure}", flush=True)
            continue
        return Drawn(name, part, vertices, triangles, centre, facing)

    raise SystemExit(f"{family}: none of {ATTEMPTS} draws makes a part; loosen the family's ranges")


def simplified(family, drawn_part):
    """(detail, vertices, triangles) of the part without one of its details, each in its turn; None if none can go."""
    part = drawn_part.part
    first = part.member % len(part.details)
    for detail in part.details[first:] + part.details[:first]:
        try:
            plain = built(family, drawn_part.seed, part.member, (detail, ))
            if abs(plain.solid.Volume - part.solid.Volume) < SMALLEST_CHANGE * part.solid.Volume:
                continue
            vertices, triangles, own_centre = exported(plain.solid, drawn_part.seed)
        except Failure:
            continue
        return detail, vertices + (own_centre - drawn_part.centre), triangles

    return None


class Corpus:
    """The folder that is written and what is known of it."""
    def __init__(self, folder):
        if any(folder.glob("obj_*.ply")) and not (folder / "parts.json").exists():
            raise SystemExit(f"--out {folder}: holds meshes that are not of this program; name another folder")

        self.folder = folder
        self.parts = []
        self.mirrored_families = set()
        for name in ("", "simplified", "mirrored"):
            (folder / name).mkdir(parents=True, exist_ok=True)
            for old in (folder / name).glob("obj_*.ply"):
                old.unlink()

    def add(self, number, family, k, seed):
        result = drawn(family, k - 1, seed)
        part, vertices, triangles = result.part, result.vertices, result.triangles
        half_turn, mirror = mesh.self_distances(vertices, triangles)
        file = f"obj_{number:06d}.ply"
        mesh.write_ply(self.folder / file, vertices, triangles)
        entry = {
            "id": number,
            "name": f"{family}_{k}",
            "family": family,
            "split": split_of(family),
            "diameter_mm": round(mesh.diameter(vertices), 3),
            "triangles": len(triangles),
            "faces": len(part.solid.Faces),
            "edges": len(part.solid.Edges),
            "facing_faces": result.facing_faces,
            "half_turn": half_turn,
            "mirror": mirror,
            "details": part.details
        }
        if part.details and number % SIMPLIFIED_EVERY == 0:
            self.add_simplified(entry, file, simplified(family, result))

        if mirror and mirror > CHIRAL and family not in self.mirrored_families:
            self.mirrored_families.add(family)
            mesh.write_ply(self.folder / "mirrored" / file, vertices * (-1, 1, 1), np.flip(triangles, 1))
            entry["mirrored"] = f"mirrored/{file}"

        self.parts.append(entry)

    def add_simplified(self, entry, file, result):
        if not result:
            return

        detail, vertices, triangles = result
        mesh.write_ply(self.folder / "simplified" / file, vertices, triangles)
        entry["simplified"] = {"file": f"simplified/{file}", "without": detail, "triangles": len(triangles)}

    def write_list(self):
        (self.folder / "parts.json").write_text(json.dumps(self.parts, indent=1) + "\n")


def main():
    arguments = parsed()
    corpus = Corpus(arguments.out)
    for family in arguments.families:
        start = time.monotonic()
        for k in range(1, arguments.count_per_family + 1):
            number = list(FAMILIES).index(family) * arguments.count_per_family + k
            corpus.add(number, family, k, f"{arguments.seed}/{family}/{k}")
        print(f"{family}: {arguments.count_per_family} parts in {time.monotonic() - start:.1f} s", flush=True)
        corpus.write_list()

    count = {key: sum(key in part for part in corpus.parts) for key in ("simplified", "mirrored")}
    print(f"{len(corpus.parts)} parts of {len(arguments.families)} families, "
          f"{count['simplified']} also without a detail, {count['mirrored']} also mirrored")


if __name__ == "__main__":
    main()
