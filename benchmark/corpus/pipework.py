"""Families of pipes, valves and blocks with ports."""
import math

from cad import ball, block, circle_points, cone, fused, label, moved, pipe, prism, rectangle, rod, slot, turned_by
from features import corner_points, engraved, hex_head, thread, through_holes
from part import along, at

UP = "up"  # the branch of a tee that leaves the plane of the others


def direction(angle, length=1.0):
    """The point (x, y) at a distance in the direction of an angle."""
    return length * math.cos(math.radians(angle)), length * math.sin(math.radians(angle))


def pipe_end(p, radius, bore):
    """A connection that stands on z = 0 and points along z, and what its bore takes away: (solid, length)."""
    kind = p.choice(("flange", "square", "hexagon", "thread", "collar", "oval"))
    if kind == "flange":
        disc = rod(2.1 * radius, 6)
        holes = [
            rod(0.2 * radius + 0.8, 8, (x, y, -1)) for x, y in circle_points(p.choice((3, 4, 6)), 1.6 * radius, 45)
        ]
        return disc.cut(holes), 6

    if kind == "square":
        plate = prism(rectangle(3.6 * radius, 3.6 * radius), 6, 0, 0.5 * radius)
        inset = corner_points(3.6 * radius, 3.6 * radius, 0.45 * radius + 1)
        return plate.cut([rod(0.18 * radius + 0.8, 8, (x, y, -1)) for x, y in inset]), 6

    if kind == "oval":
        ears = [rod(0.6 * radius, 6, (s * 1.8 * radius, 0, 0)) for s in (-1, 1)]
        plate = fused([rod(1.4 * radius, 6), prism(rectangle(3.6 * radius, 1.2 * radius), 6), *ears])
        return plate.cut([rod(0.25 * radius + 0.6, 8, (s * 1.8 * radius, 0, -1)) for s in (-1, 1)]), 6

    if kind == "hexagon":
        return hex_head(2.6 * radius, 0.9 * radius), 0.9 * radius

    if kind == "thread":
        return thread(p, 1.15 * radius, 12), 12

    return rod(1.3 * radius, 8), 8


def elbow(p):
    """A pipe bend with two connections; feet, a boss or a drain on some."""
    radius = p.mm(7, 16, 1)
    bore = 0.7 * radius
    bend = radius * p.mm(1.4, 2.5, 0.1)
    first, second = bend + p.mm(4, 20, 2), bend + p.mm(4, 20, 2)
    angle = p.variant((90, 60, 90, 45))
    path = [(-first, 0), (0, 0)]
    end = direction(angle, second)
    path.append(end)
    p.add(pipe(path, bend, radius))
    for place, turn in (((-first, 0), 180), (end, angle)):
        solid, length = pipe_end(p, radius, bore)
        solid = turned_by(turned_by(turned_by(solid, p.choice((0, 0, 45))), 90, "y"), turn, "z")
        p.add(moved(solid, *place))

    longer = [(-first - 30, 0), (0, 0), (2 * end[0], 2 * end[1])]
    p.cut(pipe(longer, bend, bore))
    if p.chance(0.4):
        p.add(rod(0.5 * radius, 2.2 * radius, (-0.9 * bend, 0, -0.05 * radius)).cut(rod(bore, 60, (-60, 0, 0), "x")),
              detail="boss")

    if p.chance(0.4):
        foot = block(2.4 * radius, 3 * radius, 4, 0.1 * radius - first + 1.4 * radius, 0, -1.6 * radius)
        post = block(0.8 * radius, 1.2 * radius, 1.5 * radius, -first + 1.4 * radius, 0, -1.55 * radius)
        p.add(foot, post.cut(rod(0.9 * radius, 60, (-60, 0, 0), "x")))


def tee(p):
    """A pipe tee, a cross or a Y with connections."""
    radius = p.mm(7, 15, 1)
    bore = 0.7 * radius
    half = radius + p.mm(14, 30, 2)
    branch_radius = radius * p.choice((1, 0.75))
    branches = p.variant(((90, ), (60, ), (90, -90), (90, UP), (90, )))
    p.add(rod(radius, 2 * half, (-half, 0, 0), "x"))
    if p.chance():
        p.add(ball(1.3 * radius))

    hollow = [rod(bore, 4 * half, (-2 * half, 0, 0), "x")]
    for angle in branches:
        axis = "z" if angle == UP else (*direction(angle), 0)
        reach = half if angle in (90, -90) else 1.2 * half
        p.add(rod(branch_radius, reach, (0, 0, 0), axis))
        hollow.append(rod(0.7 * branch_radius, 3 * half, (0, 0, 0), axis))

    same = p.chance()
    for place in ((half, 0, 0), (-half, 0, 0)):
        solid, _ = pipe_end(p, radius, bore)
        p.add(moved(turned_by(solid, 90 if place[0] > 0 else -90, "y"), *place))

    if same:
        solid, _ = pipe_end(p, branch_radius, bore)
        if branches[0] == 90:
            p.add(moved(turned_by(solid, -90, "x"), 0, half, 0))

    p.cut(*hollow)


def valve_body(p):
    """A valve: a bulged body, two connections, a bonnet with bolts, a stem or a hand wheel's square."""
    radius = p.mm(8, 15, 1)
    half = p.mm(2.2, 3.2, 0.1) * radius
    p.add(rod(radius, 2 * half, (-half, 0, 0), "x"))
    body = p.variant(("ball", "box", "barrel"))
    if body == "ball":
        p.add(ball(1.7 * radius))
    elif body == "barrel":
        p.add(rod(1.5 * radius, 2.8 * radius, (0, 0, -1.4 * radius)))
    else:
        p.add(prism(rectangle(2.8 * radius, 2.6 * radius), 2.8 * radius, -1.4 * radius, 3))

    for place in ((half, 0, 0), (-half, 0, 0)):
        solid, _ = pipe_end(p, radius, 0.7 * radius)
        p.add(moved(turned_by(solid, 90 if place[0] > 0 else -90, "y"), *place))

    lean = p.choice((0, 0, 0, 30))
    top = 2.4 * radius
    neck = [rod(1.0 * radius, top)]
    plate = rod(1.7 * radius, 5) if p.chance() else prism(rectangle(3 * radius, 2.4 * radius), 5, 0, 3)
    neck.append(moved(plate, 0, 0, top - 0.1))
    neck.append(cone(1.1 * radius, 0.7 * radius, 1.1 * radius, (0, 0, top + 4.8)))
    bonnet = fused([turned_by(piece, lean, "y") for piece in neck])
    p.add(bonnet)
    bolts = [
        turned_by(moved(hex_head(0.5 * radius, 0.3 * radius + 1, 0, False), x, y, top + 4.8), lean, "y")
        for x, y in corner_points(2.3 * radius, 1.9 * radius, 0)
    ]
    p.add(*bolts, detail="bolts")
    stem = p.variant(("lever", "square", "rod", "square"))
    z = top + 4.8 + 1.1 * radius
    if stem == "square":
        p.add(turned_by(block(0.7 * radius, 0.7 * radius, radius, 0, 0, z - 0.1), lean, "y"))
    elif stem == "rod":
        p.add(turned_by(rod(0.3 * radius, 1.6 * radius, (0, 0, z - 0.1)), lean, "y"))
    else:
        handle = slot(4 * radius, 0.8 * radius, 3, 1.5 * radius, 0, z - 0.1)
        p.add(turned_by(turned_by(handle, p.choice((0, 90, 30))), lean, "y"))

    p.cut(rod(0.7 * radius, 4 * half, (-2 * half, 0, 0), "x"))
    if p.chance(0.4):
        p.cut(rod(0.3 * radius, 20, (0, 0, -1.1 * radius), "-z"))


def manifold(p):
    """A block with many ports on several sides."""
    length, width, height = p.mm(45, 110, 5), p.mm(25, 50, 5), p.mm(20, 45, 5)
    p.add(block(length, width, height))
    if p.chance():
        p.cut(block(0.35 * length, width, 0.4 * height, 0.4 * length * p.choice((-1, 1)), 0, 0.6 * height))

    if p.chance(0.6):
        p.chamfer(p.mm(1, 3), p.choice((along("z"), along("x"), at("z", 0))))

    count = p.whole(2, 5)
    port = p.mm(3, 6)
    port = min(port, 0.3 * length / count, 0.3 * width)
    for k in range(count):
        x = (k - (count - 1) / 2) * 0.8 * length / count
        size = port * p.choice((1, 1, 0.6))
        p.cut(
            fused([
                rod(size, 0.6 * height, (x, 0, height - 0.5 * height)),
                rod(1.5 * size, 2, (x, 0, 0.6 * height)),
                rod(1.5 * size, 2 + height, (x, 0, height - 2))
            ]))

    for k in range(p.whole(1, 3)):
        x = length * (p.mm(0.15, 0.3, 0.05) + 0.3 * k - 0.45)
        p.cut(rod(p.choice((2, 3, 4)), 0.35 * width, (x, -width / 2 - 1, 0.35 * height), "y"))

    if p.chance(0.6):
        p.cut(rod(p.mm(2, 4), length, (-length, p.mm(-5, 5), 0.35 * height), "x"))

    if p.chance():
        x = -0.2 * length
        p.cut(rod(0.25 * height, 5, (x, width / 2 - 5, 0.45 * height), "y"),
              rod(3, 15, (x, width / 2 - 15, 0.45 * height), "y"))

    through_holes(p,
                  corner_points(length, width, 4)[:p.choice((2, 4))],
                  1.75,
                  3 * height,
                  -height,
                  detail="mounting holes")
    if p.chance(0.6):
        fitting = fused([hex_head(10, 5, 0, False), rod(3.5, 12)])
        p.add(moved(turned_by(fitting, 90, "y"), length / 2 - 0.1, 0, 0.3 * height), detail="fitting")

    if p.chance(0.6):
        engraved(p, turned_by(label(p.text(3), min(8, 0.3 * height), 1), 90, "x"),
                 (0.15 * length, -width / 2, 0.7 * height))
