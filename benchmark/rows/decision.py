"""Found and right on parts and families that took no part in the fit, scenes of the package's own renderer.

The test set is made by benchmark/corpus (make_parts.py, then make_scenes.py --split test); MONOCULAR_EYE_HAND_CORPUS
names the folder that holds its data sets test_000, test_001, ..."""
import math
import os
import pathlib

from figures import CannotMeasure, Figure

TARGETS = {1: ("easy", ">= 88", ">= 97"), 2: ("medium", ">= 75", ">= 95"), 3: ("hard", ">= 62", ">= 95")}


def wilson(successes, trials):
    """95 % interval of a share, in per cent."""
    if not trials:
        return "no trial"
    z, p = 1.96, successes / trials
    middle = (p + z * z / (2 * trials)) / (1 + z * z / trials)
    half = z / (1 + z * z / trials) * math.sqrt(p * (1 - p) / trials + z * z / (4 * trials * trials))
    return f"{100 * (middle - half):.1f} to {100 * (middle + half):.1f} %"


def figures(bench):
    root = os.environ.get("MONOCULAR_EYE_HAND_CORPUS")
    if not root:
        raise CannotMeasure("set MONOCULAR_EYE_HAND_CORPUS to the folder of the test scenes, see benchmark/README.md")
    folders = sorted(pathlib.Path(root).glob("test_*"))
    if not folders:
        raise CannotMeasure(f"{root} holds no folder test_*")
    totals = {}
    for folder in folders:
        for number, scene in bench.evaluate_folder(folder, "dev").items():
            total = totals.setdefault(number, [0, 0, 0, 0])
            total[0] += round(scene.found * scene.instances / 100)
            total[1] += scene.instances
            total[2] += round(scene.right * scene.estimates / 100)
            total[3] += scene.estimates
    for number, (found, instances, right, estimates) in sorted(totals.items()):
        name, found_target, right_target = TARGETS.get(number, ("", None, None))
        yield Figure(f"found, {name}", 100 * found / max(instances, 1), "%", found_target,
                     conditions=f"{found} of {instances}, {wilson(found, instances)}; {len(folders)} groups of parts")
        yield Figure(f"right, {name}", 100 * right / max(estimates, 1), "%", right_target,
                     conditions=f"{right} of {estimates}, {wilson(right, estimates)}")
