"""Families that are turned on a lathe, and what is cut into them."""
from cad import ball, block, circle_points, cone, hexagon, label, prism, rectangle, ring, rod, slot, turned, turned_by
from features import bolt_circle, engraved, keyway, plain_thread, ringed_thread
from part import at, both, circular


def flange(p):
    """A disc with a hub, a bore, a bolt circle, a raised face; ribs or a flat at its rim."""
    radius, height = p.mm(25, 75, 2.5), p.mm(5, 14, 1)
    hub, rise = radius * p.mm(0.35, 0.55, 0.01), p.mm(0, 35, 5)
    bore = hub * p.mm(0.5, 0.8, 0.01)
    p.add(rod(radius, height))
    if rise:
        p.add(cone(hub * p.choice((1, 1.15)), hub, rise, (0, 0, height)))

    if p.chance():
        p.add(rod(hub * 1.1, 2, (0, 0, -2)))

    p.cut(rod(bore, 100, (0, 0, -10)))
    count = p.choice((3, 4, 5, 6, 8))
    bolt_circle(p,
                count, (radius + hub * 1.15) / 2,
                min(0.12 * radius, 0.22 * (radius - hub)),
                height,
                detail="bolt holes",
                style=p.choice(("plain", "plain", "counterbore")))
    shape = p.variant(("notch", "round", "flat", "round", "flats"))
    if shape in ("flat", "flats"):
        for side in (1, ) if shape == "flat" else (1, -1):
            p.cut(block(0.3 * radius, 3 * radius, 5 * height, side * 1.04 * radius, 0, -2 * height))
    elif shape == "notch":
        p.cut(slot(0.4 * radius, 0.15 * radius, 5 * height, radius, 0.1 * radius, -2 * height))

    if rise >= 15 and p.chance():
        for k in range(3):
            rib = block(0.75 * radius - bore - 1, 4, 0.8 * rise, (bore + 1 + 0.75 * radius) / 2, 0, height - 0.1)
            p.add(turned_by(rib, 120 * k + 20))

    if p.chance(0.4):
        p.fillet(p.mm(0.5, 2), both(circular(radius - 0.1, radius + 0.1), at("z", height)))


def shaft(p):
    """A stepped shaft with keyways, flats, grooves, a centre hole or a cross hole."""
    steps = p.whole(3, 5)
    radius = p.mm(5, 10)
    z = 0
    middle = p.whole(1, steps - 2)
    for k in range(steps):
        length = p.mm(12, 42, 1)
        size = radius * (1 + 0.5 * (1 - abs(k - middle) / steps) + p.mm(0, 0.3, 0.05))
        p.add(rod(size, length, (0, 0, z)))
        if k in (0, steps - 1):
            feature = p.choice(("key", "flat", "square", "groove", "hole"))
            if feature == "key":
                keyway(p, size, 0.5 * size, 0.3 * size, 0.75 * length, z + 0.12 * length)
            elif feature == "flat":
                p.cut(block(size, 3 * size, 0.7 * length, 1.2 * size, 0, z if k == 0 else z + 0.3 * length))
            elif feature == "square":
                end = prism(rectangle(3 * size, 3 * size), 0.6 * length, z if k == 0 else z + 0.4 * length)
                p.cut(end.cut(block(1.4 * size, 1.4 * size, 2 * length, 0, 0, z - 0.5 * length)))
            elif feature == "hole":
                p.cut(rod(0.3 * size, 4 * size, (-2 * size, 0, z + 0.5 * length), "x"), detail="cross hole")
        if k == middle and p.chance(0.6):
            keyway(p, size, 0.45 * size, 0.25 * size, 0.7 * length, z + 0.15 * length)
        z += length
        if p.chance(0.3):
            p.cut(rod(3 * size, 1.5, (0, 0, z - 4)).cut(rod(0.85 * size, 10, (0, 0, z - 8))))

    if p.chance():
        p.cut(rod(0.35 * radius, 8, (0, 0, z - 8)))

    p.chamfer(1, both(circular(), lambda edge: at("z", 0)(edge) or at("z", z)(edge)))


def spacer(p):
    """A bush, a washer, a standoff: round, hexagonal or oval, with or without a collar."""
    kind = p.variant(("bush", "hexagon", "oval", "slit", "washer", "square"))
    radius = p.mm(12, 30, 1)
    height = p.mm(3, 6) if kind == "washer" else p.mm(15, 50, 1)
    bore = radius * p.mm(0.3, 0.65, 0.01)
    if kind == "hexagon":
        p.add(prism(hexagon(2 * radius), height))
    elif kind == "oval":
        p.add(slot(3.2 * radius, 2 * radius, height))
        p.cut(rod(0.7 * bore, height, (1.1 * radius, 0, 0)), detail="second hole")
    elif kind == "square":
        p.add(prism(rectangle(2 * radius, 2 * radius), height, 0, p.choice((0, 4))))
    else:
        p.add(rod(radius, height))

    if kind == "bush" or p.chance(0.3):
        p.add(rod(1.5 * radius, p.mm(3, 6)))

    if kind == "hexagon" and p.chance():
        p.add(plain_thread(0.6 * radius, 14, height))
        bore = 0.35 * radius

    p.cut(rod(bore, 3 * height, (0, 0, -height)))
    if kind == "slit":
        p.cut(block(2 * radius, 3, 3 * height, radius, 0, -height))

    if kind == "washer":
        p.cut(block(0.3 * radius, 0.3 * radius, height, radius), detail="notch")

    if p.chance():
        p.cut(rod(2, 4 * radius, (-p.choice((0, 2)) * radius, 0, 0.6 * height), "y" if kind == "oval" else "x"),
              detail="cross hole")

    p.chamfer(p.mm(0.5, 1.5), circular(bore - 1e-3, bore + 1e-3))


def bottle(p):
    """A revolved container: shoulders, a neck, rings, a foot."""
    radius, height = p.mm(15, 40, 1), p.mm(40, 150, 5)
    neck = radius * p.mm(0.3, 0.8, 0.05)
    shoulder = height * p.mm(0.5, 0.8, 0.05)
    top = height * 0.88
    waist = p.choice((1, 1, 0.85))
    outline = [(0, 2), (0.8 * radius, 2), (0.85 * radius, 0), (radius, 0), (radius, 0.3 * shoulder),
               (waist * radius, 0.4 * shoulder), (waist * radius, 0.7 * shoulder), (radius, 0.8 * shoulder),
               (radius, shoulder), (neck, top), (neck, height), (0, height)]
    if waist == 1:
        del outline[4:8]

    soft = p.mm(2, 5)
    p.add(turned(outline, [0, 0, 0, soft] + [soft] * (len(outline) - 7) + [soft, 1, 0]))
    p.cut(rod(0.75 * neck, 0.5 * (height - top) + p.choice((0, 15)), (0, 0, height - 0.5 * (height - top))))
    if p.chance(0.6):
        p.add(rod(neck + 1.5, 2.5, (0, 0, height - 5)))

    if p.chance():
        p.cut(ring(radius * 1.02, 1.5, (0, 0, 0.15 * shoulder)))

    if p.chance(0.3):
        p.cut(block(radius, 3 * radius, 0.3 * shoulder, 1.4 * radius, 0, 0.3 * shoulder), detail="label")

    if p.chance(0.4):
        p.add(rod(0.15 * radius, 0.25 * neck + radius, (0, 0, 0.9 * shoulder), "x"))


def knob(p):
    """A hand knob: lobed, fluted, star or with a pointer; a hub below, a hole or a screw."""
    radius, height = p.mm(16, 35, 1), p.mm(10, 22, 1)
    kind = p.variant(("lobes", "flutes", "star", "pointer", "wing"))
    if kind == "lobes":
        count = p.whole(3, 8)
        circles = [rod(0.35 * radius * 5 / (count + 1.5), height, (x, y, 0)) for x, y in circle_points(count, radius)]
        p.add(rod(radius, height), *circles)
    elif kind == "flutes":
        count = p.whole(5, 9)
        p.add(rod(radius, height))
        p.cut(*[rod(0.3 * radius * 6 / count, height, (x, y, 0)) for x, y in circle_points(count, 1.12 * radius)])
    elif kind == "star":
        count = p.choice((3, 4, 5))
        arms = [
            turned_by(slot(1.4 * radius, 0.6 * radius, height, 0.55 * radius), 360 / count * k) for k in range(count)
        ]
        p.add(*arms)
    elif kind == "wing":
        p.add(rod(0.5 * radius, 1.2 * height),
              *[turned_by(slot(1.3 * radius, 6, height, 0.65 * radius, 0, 0.4 * height), angle) for angle in (0, 180)])
    else:
        p.add(cone(radius, 0.9 * radius, height), slot(2.3 * radius, 0.4 * radius, 1.4 * height, 0.25 * radius))

    p.fillet(p.mm(1, 2.5), lambda edge: edge.BoundBox.ZMin > 0.95 * height)
    p.add(cone(0.38 * radius, 0.45 * radius, p.mm(5, 12), (0, 0, 0), "-z"))
    if p.chance():
        p.add(ringed_thread(0.2 * radius, 20, 1.5, -28), detail="screw")
        p.add(rod(0.18 * radius, 28, (0, 0, -28)), detail="screw")
    else:
        p.cut(rod(0.2 * radius, 40, (0, 0, -20)))

    if p.chance(0.4):
        p.cut(rod(0.3 * radius, 4, (0, 0, 1.0 * height - 2)))


def thumb_nut(p):
    """A knurled wheel: fine straight teeth, a collar, a threaded bore or stud."""
    radius, height = p.mm(12, 28, 1), p.mm(5, 14, 1)
    teeth = p.whole(20, 36)
    points = []
    for k in range(teeth):
        points += circle_points(1, radius, 360 * k / teeth) + circle_points(1, 0.93 * radius, 360 * (k + 0.5) / teeth)

    p.add(prism(points, height))
    slope = 0.12 * radius
    p.common(
        turned([(0, 0), (radius - slope, 0), (radius, slope), (radius, height - slope), (radius - slope, height),
                (0, height)]))
    p.add(rod(0.6 * radius, p.mm(4, 12), (0, 0, height - 0.5)))
    if p.chance():
        p.add(rod(0.45 * radius, 6, (0, 0, -5.9)), plain_thread(0.35 * radius, p.mm(15, 40, 5), height))
    else:
        p.cut(rod(0.3 * radius, 80, (0, 0, -20)))
        p.cut(rod(0.1 * radius + 0.5, 2 * radius, (0, 0, height + 2.5), "x"), detail="set screw")

    if p.chance():
        p.cut(block(2 * radius, 0.15 * radius, 30, 0, 0, height + 3))


def cap(p):
    """A lid: rounded top, a lip, grips at its skirt, a spout, a hole."""
    radius, height, wall = p.mm(18, 45, 1), p.mm(12, 40, 1), p.mm(2, 4)
    soft = p.mm(2, 6)
    square = p.chance(0.35)
    if square:
        p.add(prism(rectangle(2 * radius, 2 * radius * p.choice((1, 0.7))), height, 0, 0.35 * radius))
    else:
        p.add(cone(radius, radius * p.choice((1, 0.92)), height))

    p.fillet(soft, at("z", height))
    if p.chance():
        p.add(block(2 * radius + 6, 0.5 * radius, 3) if square or p.chance(0.3) else rod(radius + 3, 3))

    p.cut(block(1.6 * radius, 1.0 * radius, height - wall) if square else rod(0.86 * radius, height - wall))
    top = p.variant(("hole", "spout", "dome", "slot", "plain"))
    if top == "hole":
        p.cut(rod(0.25 * radius, 2 * height, (0.3 * radius, 0, 0)))
    elif top == "spout":
        p.add(cone(0.3 * radius, 0.2 * radius, 14, (0.2 * radius, 0, height - 0.1)))
        p.cut(rod(0.12 * radius, 2 * height, (0.2 * radius, 0, 0)))
    elif top == "dome":
        dome = ball(0.7 * radius, (0, 0, height - 0.4 * radius))
        p.add(dome.common(block(4 * radius, 4 * radius, 50, 0, 0, height - 0.5)))
    elif top == "slot":
        p.cut(slot(1.1 * radius, 4, 2 * height))

    if not square:
        count = p.choice((0, 12, 24))
        p.add(*[rod(1.2, 0.6 * height, (x, y, 0)) for x, y in circle_points(count, 0.98 * radius)] if count else [])

    if p.chance(0.4):
        engraved(p, label(p.text(2), 0.35 * radius, 1), (-0.35 * radius, 0, height))
