"""Found, right and AR on the rendered work cell: plain, seen through a distorting lens, and at twice the size."""
from figures import Figure

PLAIN = {1: ("easy", ">= 90", ">= 95"), 2: ("medium", ">= 70", ">= 85"), 3: ("hard", ">= 40", ">= 75")}
VARIANTS = {"warp": "--warp=-0.28,0.08,0.001,-0.0005,0", "scale 2": "--scale=2"}
LARGEST_LOSS = 2.0  # points of `found` that a variant may lose against the plain images


def figures(bench):
    plain = bench.evaluate("workcell", "dev")
    for number, scene in plain.items():
        name, found, right = PLAIN.get(number, ("", None, None))
        label = f"scene {number} {name}".strip()
        conditions = f"{scene.instances} instances, {scene.estimates} estimates; default options, one thread"
        yield Figure(f"found, {label}", scene.found, "%", found, conditions=conditions)
        yield Figure(f"right, {label}", scene.right, "%", right, conditions=conditions)
        yield Figure(f"AR, {label}", scene.average_recall, "0..1", conditions=conditions)
    whole = foundOfSplit(plain)
    yield Figure("found, split", whole, "%")
    for variant, option in VARIANTS.items():
        scenes = bench.evaluate("workcell", "dev", option)
        yield Figure(f"found, split, {variant}", foundOfSplit(scenes), "%", f">= {whole - LARGEST_LOSS:.4f}",
                     conditions=f"{option}; at most {LARGEST_LOSS:g} points below the plain split")
        for number, scene in scenes.items():
            label = f"scene {number}, {variant}"
            yield Figure(f"found, {label}", scene.found, "%", conditions=option)
            yield Figure(f"right, {label}", scene.right, "%", conditions=option)
            yield Figure(f"AR, {label}", scene.average_recall, "0..1", conditions=option)


def foundOfSplit(scenes):
    """Percent of the objects of all scenes together."""
    instances = sum(scene.instances for scene in scenes.values())
    return sum(scene.found * scene.instances for scene in scenes.values()) / instances
