"""What the rows that clear frames share."""
from figures import Figure

OBJECTS_A_SCENE = 3


def outcome(ran, scenes, kind, target):
    """Figures of the reports `ran` of so many scenes; `kind`: how they were run, for the figures' names."""
    conditions = f"seeds 0 to {scenes - 1}, {OBJECTS_A_SCENE} objects each{kind}; a scene that could not be run counts as not cleared"
    objects = sum(o["in_drop_zone"] for report in ran for o in report["objects"])
    yield Figure(f"scenes with every object carried out{kind}", 100 * sum(r["cleared"] for r in ran) / scenes, "%", target,
                 conditions=conditions)
    yield Figure(f"objects carried out{kind}", 100 * objects / (OBJECTS_A_SCENE * scenes), "%", conditions=conditions)
    yield Figure(f"collisions with the true geometry{kind}", sum(r["collisions"] for r in ran), "", "<= 0",
                 conditions=conditions)
