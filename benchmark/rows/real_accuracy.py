"""Found, right and AR on camera images of a cabinet and of a printed cube."""
from figures import Figure

FOUND = {"cabinet": ">= 70", "cube": ">= 40"}


def figures(bench):
    for name, target in FOUND.items():
        for number, scene in bench.evaluate(f"real/{name}", "test").items():
            conditions = f"scene {number}, {scene.instances} instances, {scene.estimates} estimates; default options"
            yield Figure(f"found, {name}", scene.found, "%", target, conditions=conditions)
            yield Figure(f"right, {name}", scene.right, "%", conditions=conditions)
            yield Figure(f"AR, {name}", scene.average_recall, "0..1", conditions=conditions)
