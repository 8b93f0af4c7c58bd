"""Families of screws, nuts and what one turns them with."""
from cad import (ball, block, cone, fused, hexagon, label, mirrored, moved, pipe, prism, rectangle, ring, rod, slot,
                 swept, turned, turned_by)
from features import engraved, hex_head, thread
from part import at


def bolt(p):
    """A hex bolt, with a flange or a washer face, a shank and a thread."""
    radius, length = p.mm(4, 10), p.mm(25, 90, 5)
    head = 0.7 * 2 * radius
    p.add(hex_head(3.3 * radius, head))
    if p.chance():
        p.add(cone(2.3 * radius, 1.7 * radius, 0.5 * head))

    shank = length * p.choice((0, 0.3, 0.6))
    if shank:
        p.add(rod(1.05 * radius, shank + 0.1, (0, 0, -shank)))

    screw = thread(p, radius, length - shank)
    p.add(moved(mirrored(screw, "z"), 0, 0, -shank))
    if p.chance(0.3):
        p.cut(rod(1.2, 8 * radius, (-4 * radius, 0, 0.5 * head), "x"), detail="wire hole")


def screw(p):
    """A machine screw: cap, pan, countersunk or button head; a hexagon, slot, cross or star recess."""
    radius, length = p.mm(4, 9), p.mm(20, 70, 5)
    kind = p.variant(("cap", "pan", "countersunk", "cheese", "shoulder"))
    size, head = 1.8 * radius, 1.9 * radius
    if kind == "cap":
        p.add(rod(1.6 * radius, head))
        size = 1.6 * radius
        p.fillet(0.15 * radius, at("z", head))
    elif kind == "pan":
        head = 1.3 * radius
        dome = ball(2.2 * radius, (0, 0, head - 2.2 * radius))
        p.add(rod(size, head).common(dome) if head > 2.2 * radius else rod(size, 2 * head).common(dome))
        p.common(block(9 * radius, 9 * radius, 9 * radius))
    elif kind == "countersunk":
        head = 1.1 * radius
        p.add(cone(radius, 2.1 * radius, head), rod(2.1 * radius, 0.8, (0, 0, head)))
        head += 0.8
    elif kind == "cheese":
        p.add(rod(size, head))
    else:
        p.add(rod(2 * radius, head), rod(1.4 * radius, 8, (0, 0, -7.9)))

    screw_thread = moved(thread(p, radius, length + 0.2), 0, 0, -length)
    p.add(screw_thread)
    recess = p.variant(("hexagon", "slot", "cross", "square"))
    depth = 0.5 * head
    if recess == "hexagon":
        p.cut(prism(hexagon(1.6 * radius), depth + 1, head - depth))
    elif recess == "square":
        p.cut(prism(rectangle(1.3 * radius, 1.3 * radius), depth + 1, head - depth))
    else:
        bars = [block(6 * radius if recess == "slot" else 1.9 * radius, 0.4 * radius, depth + 1, 0, 0, head - depth)]
        if recess == "cross":
            bars.append(block(0.4 * radius, 1.9 * radius, depth + 1, 0, 0, head - depth))
        p.cut(fused(bars))


def nut(p):
    """A hexagon, square, flanged, slotted, cap or wing nut."""
    radius = p.mm(6, 14)
    height = 1.7 * radius
    kind = p.variant(("flanged", "square", "slotted", "wing", "cap", "hexagon"))
    bore_end = 3 * height
    if kind == "square":
        p.add(prism(rectangle(3.3 * radius, 3.3 * radius), height))
        p.common(cone(3.4 * radius, 1.9 * radius, height))
    elif kind == "wing":
        p.add(cone(1.7 * radius, 1.3 * radius, height))
        for s in (-1, 1):
            wing = slot(2.8 * radius, 1.6 * radius, 0.5 * radius, 0, 0, -0.25 * radius, 0)
            wing = turned_by(wing, 90, "x")
            wing = turned_by(wing, -s * 30, "y")
            wing = moved(wing, s * 2.3 * radius, 0, 1.1 * height)
            p.add(wing)
    else:
        p.add(hex_head(3.4 * radius, height))

    if kind == "flanged":
        p.add(cone(2.5 * radius, 2.1 * radius, 0.3 * height), rod(2.5 * radius, 1.5, (0, 0, -1.5)))
    elif kind == "slotted":
        p.add(rod(1.5 * radius, 0.6 * height, (0, 0, height - 0.1)))
    elif kind == "cap":
        p.add(ball(1.5 * radius, (0, 0, height)).common(block(9 * radius, 9 * radius, 9 * radius, 0, 0, height - 1)))
        bore_end = height + 0.5 * radius

    p.cut(
        turned([(0, -2), (1.2 * radius, -2), (1.2 * radius, 0.0), (radius, 0.2 * radius), (radius, bore_end),
                (0, bore_end)]))
    if kind == "slotted":
        for angle in (0, 60, 120):
            bar = block(8 * radius, 0.5 * radius, height, 0, 0, 1.15 * height)
            bar = turned_by(bar, angle, "z")
            p.cut(bar, detail="slots")

    if kind == "square" and p.chance():
        p.cut(rod(0.3 * radius, 5 * radius, (0, 0, height / 2), "x"), detail="set screw")


def stud(p):
    """A stud on a plate, a rod with two threads, an eye bolt or a hook bolt."""
    radius = p.mm(4, 9)
    kind = p.variant(("double", "plate", "eye", "bent", "ball"))
    length = p.mm(25, 60, 5)
    if kind == "double":
        p.add(rod(1.0 * radius, length))
        p.add(thread(p, 0.9 * radius, p.mm(15, 30), length - 0.1))
        p.add(moved(thread(p, 0.9 * radius, 20), 0, 0, -19.9), detail="thread")
        p.cut(*[block(radius, 4 * radius, 10, s * 1.25 * radius, 0, length / 2) for s in (-1, 1)])
        return

    p.add(thread(p, radius, length, 0))
    if kind == "plate":
        size = 6 * radius
        p.add(prism(rectangle(size, size * p.choice((1, 0.6))), 4, -4, p.choice((0, 4))))
        p.cut(*[rod(0.4 * radius, 10, (s * 0.36 * size, 0, -6)) for s in (-1, 1)], detail="holes")
        p.add(cone(2 * radius, radius, radius, (0, 0, -0.1)))
    elif kind == "eye":
        p.add(ring(2.2 * radius, 0.9 * radius, (0, 0, -2.6 * radius), "y"), rod(1.6 * radius, 0.5 * radius))
    elif kind == "bent":
        drop = p.mm(15, 30)
        reach = 5 * radius
        bar = pipe([(0, 0), (0, -drop), (reach, -drop), (reach, -drop + p.choice((8, 15)) + 2 * radius)], 2.2 * radius,
                   radius)
        bar = turned_by(bar, 90, "x")
        p.add(bar)
    else:
        p.add(hex_head(3 * radius, radius, -radius + 0.1, False), rod(0.8 * radius, 2.5 * radius, (0, 0, 0), "-z"),
              ball(1.5 * radius, (0, 0, -3.3 * radius)))


def wrench(p):
    """A flat wrench: open or ring ends, or a hexagon key."""
    size, length = p.mm(8, 20, 1), p.mm(70, 130, 5)
    if p.member % 4 == 3:
        hexagon_key(p, 0.5 * size + 2, length)
        return

    height = p.mm(4, 8)
    p.add(block(length, 0.9 * size, 0.7 * height, 0, 0, 0.15 * height))
    for side, kind in ((-1, p.choice(("open", "ring"))), (1, p.choice(("open", "ring", "ring12")))):
        jaw = size * (1 if side < 0 else p.choice((0.8, 1.2)))
        x = side * length / 2
        tilt = p.choice((0, 15))
        p.add(rod(jaw if kind == "open" else 0.85 * jaw, height, (x, 0, 0)))
        if kind == "open":
            tool = block(2.2 * jaw, jaw, 3 * height, side * 0.8 * jaw, 0, -height)
            tool = turned_by(tool, tilt, "z")
            p.cut(moved(tool, x))
        else:
            star = prism(hexagon(jaw, 15), 3 * height, -height)
            if kind == "ring12":
                star = star.fuse(prism(hexagon(jaw, 45), 3 * height, -height))
            p.cut(moved(star, x))

    p.fillet(1, lambda edge: edge.Curve.TypeId == "Part::GeomLine" and edge.Length > 0.5 * length)
    if p.chance(0.6):
        p.cut(slot(0.5 * length, 0.5 * size, height, 0, 0, 0.6 * height), detail="recess")
    else:
        engraved(p, label(p.text(3), 0.5 * size, 1), (0, 0, 0.85 * height), detail="recess")

    if p.chance(0.3):
        p.cut(rod(2, 3 * height, (0.33 * length, 0, -height)))


def hexagon_key(p, across, length):
    path = [(0, 0), (length, 0), (length, p.mm(0.25, 0.4, 0.01) * length)]
    p.add(swept(path, 2 * across, hexagon(across)))
    if p.chance():
        p.add(block(0.4 * length, 2.5 * across, 2.0 * across, 0.2 * length - 5, 0, -across))
