"""Found, right, AR and time on industrial CAD: thousands of triangles, holes, ribs, fillets; held out."""
from figures import Figure

TARGETS = {1: ("easy", ">= 65", ">= 95"), 2: ("medium", ">= 60", ">= 93"), 3: ("hard", ">= 45", ">= 90")}


def figures(bench):
    for number, scene in bench.evaluate("industrial", "dev").items():
        name, found, right = TARGETS.get(number, ("", None, None))
        label = f"scene {number} {name}".strip()
        conditions = f"{scene.instances} instances, {scene.estimates} estimates; default options, one thread"
        yield Figure(f"found, {label}", scene.found, "%", found, conditions=conditions)
        yield Figure(f"right, {label}", scene.right, "%", right, conditions=conditions)
        yield Figure(f"AR, {label}", scene.average_recall, "0..1", conditions=conditions)
        yield Figure(f"median time, {label}", scene.median_seconds, "s", conditions=conditions)
