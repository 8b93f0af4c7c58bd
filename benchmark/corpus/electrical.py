"""Families of connectors, plugs and sockets."""
from cad import block, circle_points, cone, frustum, grid_points, prism, prism_along, rectangle, rod, slot, turned
from features import through_holes
from part import at


def connector(p):
    """A plug housing: rows of pin holes or a shroud with pins, latches, keys, strain relief."""
    columns, rows, pitch = p.whole(3, 9), p.choice((1, 2, 2, 3)), p.choice((3.5, 4.2, 5.0))
    width, depth = columns * pitch + 3, rows * pitch + 3
    height = p.mm(12, 25, 1)
    p.add(prism(rectangle(width, depth), height, 0, p.choice((0, 1.5))))
    points = grid_points(columns, rows, pitch, pitch)
    hole = 0.3 * pitch
    if p.chance(0.4):
        inner = prism(rectangle(width - 2.4, depth - 2.4), 0.6 * height, 0.4 * height + 0.1)
        p.cut(inner)
        p.add(*[block(hole, hole, 0.55 * height, x, y, 0.3 * height) for x, y in points], detail="pins")
    elif p.chance():
        p.cut(*[block(2 * hole, 2 * hole, 0.5 * height, x, y, 0.6 * height) for x, y in points], detail="pin holes")
    else:
        p.cut(*[rod(hole, 0.5 * height, (x, y, 0.6 * height)) for x, y in points], detail="pin holes")

    latch = p.variant(("arm", "ears", "ramp", "none"))
    if latch == "arm":
        y = depth / 2
        p.add(
            prism_along("x", [(y - 0.5, 2), (y + 3, 2), (y + 3, height - 1), (y + 1.6, height - 1), (y + 1.6, 5),
                              (y - 0.5, 5)], 0.4 * width, -0.2 * width))
    elif latch == "ramp":
        for x in p.choice(((0, ), (-0.28 * width, 0.28 * width))):
            p.add(
                prism_along("x", [(depth / 2 - 0.2, 0.3 * height), (depth / 2 + 2.5, 0.3 * height),
                                  (depth / 2 - 0.2, 0.75 * height)], 5, x - 2.5))
    elif latch == "ears":
        p.add(slot(width + 22, min(10, depth), 3))
        p.cut(*[rod(1.75, 9, (s * (width / 2 + 5.5), 0, -3)) for s in (-1, 1)], detail="ear holes")

    keys = p.whole(0, 2)
    for k in range(keys):
        p.add(block(1.5, 1.6, 0.7 * height,
                    width * (0.2 + 0.2 * k) * p.choice((-1, 1)), -depth / 2 - 0.7, 0.3 * height))

    tail = p.choice(("cable", "legs", "none", "step"))
    if tail == "cable":
        p.add(rod(0.35 * depth, 12, (p.choice((0, 0.2 * width)), 0, 0), "-z"))
    elif tail == "legs":
        p.add(*[block(0.8, 0.8, 5, x, y, -4.9) for x, y in points], detail="legs")
    elif tail == "step":
        p.add(block(width - 3, depth + 5, 5, 0, 2.5))


def terminal_block(p):
    """A row of screw terminals: slanted or stepped profile, screw wells, wire openings, end plate, rail foot."""
    count, pitch = p.whole(2, 7), p.choice((5.08, 7.5, 10.0))
    length, depth, height = count * pitch + 1, p.mm(10, 22, 1), p.mm(12, 26, 1)
    kind = p.variant(("slant", "step", "double", "tower"))
    d, h = depth, height
    outlines = {
        "slant": [(0, 0), (d, 0), (d, 0.5 * h), (0.6 * d, h), (0, h)],
        "step": [(0, 0), (d, 0), (d, 0.55 * h), (0.55 * d, 0.55 * h), (0.55 * d, h), (0, h)],
        "double": [(0, 0), (d, 0), (d, 0.6 * h), (0.7 * d, 0.6 * h), (0.7 * d, h), (0.3 * d, h), (0.3 * d, 0.6 * h),
                   (0, 0.6 * h)],
        "tower": [(0, 0), (d, 0), (0.9 * d, h), (0.1 * d, h)]
    }
    p.add(prism_along("x", outlines[kind], length, -length / 2))
    centres = [(k - (count - 1) / 2) * pitch for k in range(count)]
    top = {"slant": 0.3, "step": 0.27, "double": 0.5, "tower": 0.5}[kind] * d
    well = min(0.36 * pitch, 0.2 * d)
    p.cut(*[rod(well, 0.4 * h, (x, top, 0.65 * h)) for x in centres])
    p.add(*[
        rod(0.8 * well, 0.2 * h, (x, top, 0.6 * h)).cut(block(2 * well, 0.3 * well, h, x, top, 0.75 * h))
        for x in centres
    ],
          detail="screws")
    mouth = 0.3 * h if kind != "step" else 0.28 * h
    p.cut(*[block(0.6 * pitch, 0.5 * d, mouth, x, d - 0.15 * d, 0.1 * h) for x in centres], detail="wire openings")
    if kind == "double":
        p.cut(*[block(0.6 * pitch, 0.5 * d, mouth, x, 0.15 * d, 0.1 * h) for x in centres], detail="wire openings")

    if kind == "step":
        p.cut(*[rod(well, 0.3 * h, (x, 0.77 * d, 0.35 * h)) for x in centres])

    if p.chance():
        p.cut(*[block(0.8, 0.4 * d, h, x + pitch / 2, top, 0.85 * h) for x in centres[:-1]])

    if p.chance():
        p.add(*[rod(0.6, 4, (x, 0.4 * d, 0.05), "-z") for x in centres], detail="legs")
    elif p.chance():
        p.add(
            prism_along("x", [(0.2 * d, 0.1), (0.8 * d, 0.1), (0.8 * d, -6), (0.7 * d, -6), (0.7 * d, -2),
                              (0.3 * d, -2), (0.3 * d, -6), (0.15 * d, -6)], length, -length / 2))

    if p.chance(0.6):
        p.add(block(9, 0.8 * d, 4, length / 2 + 4.4, 0.45 * d))
        p.cut(rod(1.7, 12, (length / 2 + 5, 0.45 * d, -4)))

    if p.chance(0.4):
        p.add(block(1.5, d + 2, h + 2, -length / 2, d / 2, 0))


def plug(p):
    """A mains or signal plug: a rounded body with a collar and prongs, a cable sleeve with rings."""
    kind = p.variant(("round", "flat", "three", "jack", "angled"))
    radius, height = p.mm(13, 24, 1), p.mm(18, 34, 1)
    flat = kind in ("flat", "angled")
    if kind == "jack":
        jack_plug(p, 0.35 * radius)
        return

    if flat:
        p.add(frustum(2 * radius, 1.2 * radius, 1.2 * radius, 0.9 * radius, height, 0, 3))
    else:
        p.add(cone(radius, 0.65 * radius, height))

    p.fillet(p.mm(1.5, 4), at("z", height))
    p.add(prism(rectangle(2.2 * radius, 1.5 * radius), 4, -2, 5) if flat else rod(1.1 * radius, 4, (0, 0, -2)))
    spread = 0.55 * radius
    reach = p.mm(12, 19)
    if kind == "round":
        p.add(*[rod(2.2, reach, (s * spread, 0, 0), "-z") for s in (-1, 1)], detail="prongs")
        p.cut(*[block(4, 5, 9, 0, s * 1.1 * radius, -3) for s in (-1, 1)])
    elif kind == "flat":
        p.add(*[block(1.8, 6.3, reach, s * spread, 0, -reach) for s in (-1, 1)], detail="prongs")
        p.cut(*[rod(1.2, 40, (-20, 0, 3 - reach), "x")], detail="prong holes")
    else:
        p.add(block(4, 6.5, 1.2 * reach, 0, 0.4 * radius, -1.2 * reach),
              *[block(6.5, 4, reach, s * spread, -0.3 * radius, -reach) for s in (-1, 1)],
              detail="prongs")

    sleeve = 0.28 * radius + 1
    if kind == "angled":
        p.add(rod(sleeve, radius + 18, (0, 0, 0.6 * height), "x"))
        p.add(*[rod(1.35 * sleeve, 2, (radius + 3 + 5 * k, 0, 0.6 * height), "x") for k in range(3)],
              detail="sleeve rings")
    else:
        p.add(cone(sleeve + 1, sleeve, 20, (0, 0, height - 0.5)))
        p.add(*[rod(1.45 * sleeve, 2, (0, 0, height + 3 + 5 * k)) for k in range(3)], detail="sleeve rings")

    if p.chance():
        p.cut(*[
            block(1.2 * radius, 1.5, 2, 0,
                  s * (0.85 if not flat else 0.57) * radius, 5 + 4 * k) for k in range(2) for s in (-1, 1)
        ])


def jack_plug(p, radius):
    p.add(
        turned([(0, -30), (0.3 * radius, -30), (0.75 * radius, -27), (0.55 * radius, -25), (0.75 * radius, -22),
                (0.75 * radius, 0), (2 * radius, 0), (2 * radius, 18), (1.6 * radius, 20), (1.2 * radius, 36), (0, 36)],
               [0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0]))
    count = p.choice((6, 8))
    p.cut(*[rod(0.3 * radius, 16, (x, y, 2)) for x, y in circle_points(count, 2.1 * radius)], detail="grip")
    p.cut(block(3 * radius, 1.0 * radius, 9, 2.6 * radius, 0, 5))


def socket(p):
    """A panel socket: a face plate with a recess, contacts, a switch or a latch; screw holes; a body behind."""
    size, thick = p.mm(40, 80, 5), p.mm(5, 10, 1)
    width = size * p.choice((1, 1, 0.65))
    p.add(prism(rectangle(size, width), thick, 0, p.choice((3, 8))))
    p.fillet(p.mm(1, 3), at("z", thick))
    x = p.choice((0, -0.17 * size))
    radius = 0.3 * width
    shape = p.variant(("round", "square", "shroud"))
    if shape == "shroud":
        p.add(rod(radius, 12, (x, 0, thick - 0.1)).cut(rod(0.82 * radius, 30, (x, 0, 0))))
        p.cut(rod(0.82 * radius, 9, (x, 0, 0.6 * thick)))
    else:
        p.add(
            rod(radius, 2 *
                thick, (x, 0, -2 * thick + 0.1)) if shape == "round" else prism(rectangle(2 * radius, 1.8 *
                                                                                          radius, x), 2 *
                                                                                thick, -2 * thick + 0.1, 3))
        p.cut(
            rod(0.9 * radius, 3 *
                thick, (x, 0, -thick)) if shape == "round" else prism(rectangle(1.75 * radius, 1.5 * radius, x), 3 *
                                                                      thick, -thick, 2))

    contacts = p.choice(("round", "flat", "three", "five"))
    floor = -2 * thick if shape != "shroud" else -1
    if contacts == "round":
        p.cut(*[rod(0.14 * radius + 0.5, 20, (x + s * 0.45 * radius, 0, floor)) for s in (-1, 1)], detail="contacts")
    elif contacts == "flat":
        p.cut(*[block(2, 0.6 * radius, 20, x + s * 0.4 * radius, 0, floor) for s in (-1, 1)], detail="contacts")
    elif contacts == "three":
        p.cut(block(3, 0.4 * radius, 20, x, 0.35 * radius, floor),
              *[block(0.35 * radius, 3, 20, x + s * 0.4 * radius, -0.25 * radius, floor) for s in (-1, 1)],
              detail="contacts")
    else:
        p.cut(*[rod(0.1 * radius + 0.4, 20, (a, b, floor)) for a, b in circle_points(5, 0.5 * radius, 90, x)],
              detail="contacts")

    if x:
        p.cut(prism(rectangle(0.2 * size, 0.4 * width, 0.3 * size), thick, 0.7 * thick, 1))
        p.add(prism_along("x", [(-0.17 * width, 0.5 * thick), (0.17 * width, 0.5 * thick), (0.17 * width, thick + 2.5),
                                (-0.17 * width, thick - 1)], 0.17 * size, 0.215 * size),
              detail="switch")

    points = [(s * (size / 2 - 5), t * (width / 2 - 5))
              for s, t in p.choice((((-1, -1), (1, 1)), ((-1, 1), (1, 1), (1, -1), (-1, -1)), ((-1, -1), (1, -1))))]
    through_holes(p, points, 1.75, thick, 0, detail="screw holes", style=p.choice(("plain", "countersink")))
