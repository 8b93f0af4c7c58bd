"""Found and right on parts and families that took no part in the fit, scenes of the package's own renderer.

The test set is made by benchmark/corpus (make_parts.py, then make_scenes.py --split test); MONOCULAR_EYE_HAND_CORPUS
names the folder that holds its data sets test_000, test_001, ..., and those of make_pairs.py."""
import math

from figures import Figure, corpus_folders

TARGETS = {1: ("easy", ">= 88", ">= 97"), 2: ("medium", ">= 75", ">= 95"), 3: ("hard", ">= 62", ">= 95")}


def wilson(successes, trials):
    """95 % interval of a share, in per cent."""
    if not trials:
        return "no trial"
    z, p = 1.96, successes / trials
    middle = (p + z * z / (2 * trials)) / (1 + z * z / trials)
    half = z / (1 + z * z / trials) * math.sqrt(p * (1 - p) / trials + z * z / (4 * trials * trials))
    return f"{100 * (middle - half):.1f} to {100 * (middle + half):.1f} %"


def totals(bench, kind):
    """[found, instances, right, estimates] by scene, over all data sets of a kind."""
    counts = {}
    for folder in corpus_folders(kind):
        for number, scene in bench.evaluate_folder(folder, "dev").items():
            counts[number] = [sum(column) for column in zip(counts.get(number, [0, 0, 0, 0]), scene.counts())]
    return counts


def pooled(counts):
    return [sum(column) for column in zip(*counts.values())]


def figures(bench):
    for number, (found, instances, right, estimates) in sorted(totals(bench, "test").items()):
        name, found_target, right_target = TARGETS.get(number, ("", None, None))
        yield Figure(f"found, {name}", 100 * found / max(instances, 1), "%", found_target,
                     conditions=f"{found} of {instances}, {wilson(found, instances)}")
        yield Figure(f"right, {name}", 100 * right / max(estimates, 1), "%", right_target,
                     conditions=f"{right} of {estimates}, {wilson(right, estimates)}")

    # The same parts with all their details, and with CAD that leaves one out.
    full, simplified = pooled(totals(bench, "full")), pooled(totals(bench, "simplified"))
    yield Figure("found with simplified CAD over found with full CAD", 100 * simplified[0] / max(full[0], 1), "%",
                 ">= 60", conditions=f"{simplified[0]} and {full[0]} of {full[1]}")
    yield Figure("right with simplified CAD", 100 * simplified[2] / max(simplified[3], 1), "%", ">= 95",
                 conditions=f"{simplified[2]} of {simplified[3]}, {wilson(simplified[2], simplified[3])}")
