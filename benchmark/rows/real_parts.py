"""Found and right on camera images of steel, aluminium, printed and packed parts."""
from figures import Figure

FOUND = {"steel_block": ">= 50", "steel_keys": ">= 30", "aluminium_block": ">= 100", "teabox": None,
         "printed_cube_rejected": None}


def figures(bench):
    for name, target in FOUND.items():
        for scene in bench.evaluate(f"real_parts/{name}", "test").values():
            conditions = f"{scene.instances} instances, {scene.estimates} estimates; default options"
            yield Figure(f"found, {name}", scene.found, "%", target, conditions=conditions)
            if scene.estimates:
                yield Figure(f"right, {name}", scene.right, "%", ">= 97", conditions=conditions)
