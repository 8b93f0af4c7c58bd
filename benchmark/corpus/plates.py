"""Families of plates and brackets."""
from cad import (block, circle_points, fused, grid_points, label, moved, prism, prism_along, rectangle, rod, slot,
                 turned_by)
from features import corner_points, engraved, through_holes
from part import along, at, both


def plate(p):
    """A flat plate: corner holes, and a window, slots, a row of holes or a pocket."""
    length, width, height = p.mm(45, 140, 5), p.mm(30, 90, 5), p.mm(4, 12, 1)
    corner = p.choice((0, 3, 6, 10))
    p.add(prism(rectangle(length, width), height, 0, corner))
    if p.chance(0.3):
        p.cut(moved(turned_by(block(30, 30, height), 45), length / 2, width / 2))

    if p.chance(0.3):
        p.cut(block(length * 0.3, width * 0.25, height, -length * 0.5 + length * 0.3, width / 2))

    radius = p.choice((2.25, 2.75, 3.5, 4.5))
    through_holes(p,
                  corner_points(length, width, 2.2 * radius + 1),
                  radius,
                  height,
                  detail="corner holes",
                  style=p.choice(("plain", "counterbore", "countersink")))
    kind = p.variant(("window", "slots", "row", "pocket", "ring"))
    if kind == "window":
        p.cut(prism(rectangle(length * 0.4, width * 0.35, p.mm(-8, 8)), height, 0, p.choice((0, 4))))
    elif kind == "slots":
        for y in (-width / 5, width / 5):
            p.cut(slot(p.mm(15, 0.5 * length), p.mm(4, 8), height, p.mm(-5, 5), y))
    elif kind == "row":
        p.cut(*[rod(1.5 + k, height, (length * (k - 1.5) / 6, 0, 0)) for k in range(4)])
    elif kind == "pocket":
        p.cut(prism(rectangle(length * 0.5, width * 0.5, -length * 0.08), height, height * 0.5, 5))
    else:
        p.cut(rod(width * 0.2, height, (length * 0.1, 0, 0)),
              *[rod(2, height, (*point, 0)) for point in circle_points(4, width * 0.3, 45, length * 0.1)])

    if p.chance(0.4):
        p.add(rod(width * 0.12, p.mm(5, 20), (-length * 0.28, width * 0.18, height)), detail="boss")

    if p.chance():
        p.chamfer(1, both(at("z", height), along(p.choice(("x", "y")))))


def angle_holes(p, length, first, second, height):
    """Holes in both legs of an angle whose bend lies along y: the legs start at x = 0 and z = 0."""
    radius = p.choice((2.25, 3.25, 4.5))
    for leg, axis in ((first, "z"), (second, "x")):
        pitch = length / p.choice((2, 3, 4))
        count = max(1, int(length / pitch) - p.whole(0, 1))
        middle = (leg + height) / 2 + p.mm(-2, 3)
        tools = [
            rod(radius, 4 * height, (middle, y, -height) if axis == "z" else (-height, y, middle), axis)
            for _, y in grid_points(1, count, 0, pitch, 0, length / 2)
        ]
        if p.chance(0.3):
            tools = [fused([tool, moved(tool, 0, 4)]) for tool in tools]
        p.cut(*tools, detail="holes")


def l_bracket(p):
    """An angle, with a rib, a rounded bend, cut corners."""
    first, second, length = p.mm(30, 80, 5), p.mm(25, 80, 5), p.mm(20, 80, 5)
    height = p.mm(3, 8, 0.5)
    bend = p.choice((0, height, 2 * height))
    outline = [(0, 0), (first, 0), (first, height), (height, height), (height, second), (0, second)]
    p.add(prism_along("y", outline, length, 0, [bend + height if bend else 0, 0, 0, bend, 0, 0]))
    if p.chance(0.6):
        size = 0.7 * min(first, second)
        inside = 0.8 * height + 0.35 * bend
        y = p.choice((length / 2 - 2, 0, length - 4))
        p.add(prism_along("y", [(inside, inside), (size, 0.8 * height), (0.8 * height, size)], 4, y))

    if p.chance():
        corner = p.mm(5, 12)
        p.cut(prism([(first, 0), (first - corner, 0), (first, corner)], height))

    if p.chance():
        p.fillet(p.mm(3, 8), both(along("x"), at("z", second)))

    angle_holes(p, length, first, second, height)
    if p.chance(0.4):
        p.add(rod(6, 8, (first * 0.6, length * 0.5, height)), detail="boss")
        p.cut(rod(3, 40, (first * 0.6, length * 0.5, -height)))


def u_bracket(p):
    """A bent channel with bores through both sides and holes in the floor."""
    width, length, height, wall = p.mm(25, 70, 5), p.mm(25, 90, 5), p.mm(20, 60, 5), p.mm(2.5, 6)
    half = width / 2
    other = height * p.choice((1, 1, 0.6))
    outline = [(-half, 0), (half, 0), (half, other), (half - wall, other), (half - wall, wall), (-half + wall, wall),
               (-half + wall, height), (-half, height)]
    bend = p.choice((0, wall))
    p.add(prism_along("y", outline, length, 0, [2 * bend, 2 * bend, 0, 0, bend, bend, 0, 0]))
    if p.chance(0.6):
        p.fillet(min(length, height) * 0.35, along("x"))

    bore = min(other, length) * p.mm(0.1, 0.22, 0.01)
    p.cut(rod(bore, 2 * width, (-width, length * p.choice((0.5, 0.4)), other - 1.6 * bore), "x"))
    through_holes(p, [(0, length * t) for t in p.choice(((0.5, ), (0.2, 0.8), (0.25, 0.7)))],
                  p.choice((2.25, 3.25)),
                  wall,
                  detail="floor holes")
    if p.chance(0.4):
        p.cut(slot(width * 0.45, 5, 2 * wall, 0, length / 2, -wall / 2, 90))

    if p.chance(0.4):
        flange = p.mm(8, 16)
        p.add(block(flange, length, wall, half + flange / 2 - 0.1, length / 2, other - wall))
        through_holes(p, [(half + flange / 2, length * t) for t in (0.25, 0.75)], 2, height + 1)


def z_bracket(p):
    """A step of two parallel feet joined by a web."""
    low, high, rise, wall, length = p.mm(20, 50, 5), p.mm(15, 50, 5), p.mm(15, 50, 5), p.mm(3, 7), p.mm(20, 60, 5)
    lean = p.choice((0, 0, p.mm(5, 20)))
    outline = [(0, 0), (low, 0), (low + lean, rise), (low + lean + high, rise), (low + lean + high, rise + wall),
               (low + lean - wall, rise + wall), (low - wall, wall), (0, wall)]
    bend = p.choice((0, wall))
    p.add(prism_along("y", outline, length, 0, [0, 2 * bend, bend, 0, 0, 2 * bend, bend, 0]))
    if p.chance():
        p.fillet(p.mm(3, 8), along("z"))

    radius = p.choice((2.25, 3.25))
    through_holes(p, [(low * 0.4, length * t) for t in p.choice(((0.5, ), (0.25, 0.75)))],
                  radius,
                  wall,
                  detail="foot holes",
                  style=p.choice(("plain", "countersink")))
    x = low + lean + high * 0.5
    if p.chance():
        p.cut(slot(min(high, length) * 0.7, 2 * radius, 2 * wall, x, length / 2, rise - wall / 2, p.choice((0, 90))))
    else:
        p.cut(rod(2 * radius, 2 * wall, (x, length / 2, rise - wall / 2)))

    if lean == 0 and p.chance():
        y = p.choice((0, length - 3))
        p.add(prism_along("y", [(0.3 * low, wall / 2), (low - wall / 2, wall / 2), (low - wall / 2, 0.8 * rise)], 3, y))


def t_bracket(p):
    """A foot with an upright web that carries an eye."""
    length, width, foot = p.mm(40, 100, 5), p.mm(25, 50, 5), p.mm(5, 10, 1)
    wall, rise = p.mm(5, 12, 1), p.mm(25, 60, 5)
    p.add(prism(rectangle(length, width), foot, 0, p.choice((0, 5))))
    y = p.choice((0, 0, width / 2 - wall / 2))
    eye = min(0.3 * length, 0.4 * rise)
    x = p.choice((0, 0, p.mm(-0.2, 0.2, 0.01) * length))
    web = [(-0.45 * length, foot / 2), (0.45 * length, foot / 2), (x + eye, foot + rise - eye),
           (x - eye, foot + rise - eye)]
    p.add(prism_along("y", web, wall, y - wall / 2), rod(eye, wall, (x, y - wall / 2, foot + rise - eye), "y"))
    if p.chance():
        p.add(rod(0.75 * eye, wall + 6, (x, y - wall / 2 - 6, foot + rise - eye), "y"))

    p.cut(rod(0.5 * eye, 4 * wall, (x, y - 2 * wall, foot + rise - eye), "y"))
    if p.chance() and y == 0:
        p.add(prism_along("x", [(0, foot / 2), (width * 0.45, foot / 2), (0, foot + 0.4 * rise)], 5, -2.5))

    holes = [(s * 0.4 * length, t * 0.32 * width) for s in (-1, 1) for t in p.choice(((-1, 1), (-1, )))]
    through_holes(p, holes, p.choice((2.25, 3)), foot, detail="foot holes", style=p.choice(("plain", "counterbore")))
    if p.chance(0.6):
        p.fillet(p.mm(1, 2), at("z", foot))


def gusset(p):
    """A corner bracket: two flanges braced by one or two triangles, a hollow one in the middle."""
    size, width, wall = p.mm(30, 80, 5), p.mm(20, 50, 5), p.mm(3, 7)
    other = size * p.choice((1, 1, 0.7))
    p.add(block(size, width, wall, size / 2, 0), block(wall, width, other, wall / 2, 0))
    brace = [(wall / 2, wall / 2), (size, wall / 2), (size, 1.6 * wall), (1.6 * wall, other), (wall / 2, other)]
    sides = p.variant(((-1, 1), (0, ), (1, ), (-1, 1)))
    for side in sides:
        p.add(prism_along("y", brace, wall, side * (width - wall) / 2 - wall / 2))

    if p.chance(0.4):
        p.cut(rod(0.13 * size, 2 * width, (0.3 * size, -width, 0.3 * other), "y"))

    if 0 not in sides:
        p.cut(slot(0.4 * size, min(7, 0.3 * width), 2 * wall, 0.55 * size, 0, -wall / 2), detail="slot")
        p.cut(rod(min(3.5, 0.15 * width), 2 * wall, (-wall / 2, 0, 0.55 * other), "x"))
    else:
        through_holes(p, [(0.6 * size, s * 0.32 * width) for s in (-1, 1)], 2.25, wall, detail="slot")
        p.cut(*[rod(2.25, 2 * wall, (-wall / 2, s * 0.32 * width, 0.6 * other), "x") for s in (-1, 1)])

    if p.chance():
        p.add(block(3, 0.3 * width, 5, size - 1.5, 0, -4.9), detail="key")


def hinge(p):
    """One leaf of a hinge with its knuckles and the pin's bore."""
    length, leaf, wall = p.mm(40, 100, 5), p.mm(20, 50, 5), p.mm(3, 6)
    radius = wall + p.mm(1, 3)
    count = p.choice((2, 3))
    p.add(prism(rectangle(leaf, length, leaf / 2), wall, 0, p.choice(([0, 6, 6, 0], 0, [0, 12, 12, 0]))))
    parts = 2 * count - 1
    first = p.choice((0, 1))
    pitch = length / parts
    p.cut(*[
        block(2 * radius + 2, pitch + 0.4, 4 * wall, 0.5, -length / 2 + (k + 0.5) * pitch, -wall) for k in range(parts)
        if k % 2 != first
    ])
    knuckles = [
        rod(radius, pitch - 0.2, (0, -length / 2 + k * pitch + 0.1, radius), "y") for k in range(parts)
        if k % 2 == first
    ]
    p.add(*knuckles)
    p.cut(rod(0.5 * radius, 2 * length, (0, -length, radius), "y"))
    holes = [(0.55 * leaf + s, t * length)
             for s, t in p.choice((((0, -0.3), (0, 0.3)), ((3, -0.35), (-2, 0), (3, 0.35)), ((4, -0.3), (-3, 0.3))))]
    through_holes(p, holes, p.choice((2, 2.5)), wall, detail="holes", style=p.choice(("plain", "countersink")))
    if p.chance(0.3):
        p.cut(block(leaf * 0.3, length * 0.25, 2 * wall, leaf, length * 0.25))


def motor_mount(p):
    """An angle with a motor's pilot bore, four screw slots, and slots in the foot."""
    frame, wall = p.choice((35, 42, 57)), p.mm(3, 6)
    width = frame + p.mm(4, 12, 1)
    depth = p.mm(0.5, 1.0, 0.05) * frame
    rise = frame + p.mm(6, 20, 1)
    p.add(block(width, wall, rise, 0, wall / 2), block(width, depth, wall, 0, depth / 2))
    centre = rise - width / 2
    p.cut(rod(0.27 * frame, 3 * wall, (0, -wall, centre), "y"))
    style = p.choice(("round", "slots"))
    for x, z in circle_points(4, 0.52 * frame, 45):
        tool = rod(1.75, 3 * wall, (x, -wall, centre + z), "y")
        p.cut(fused([tool, moved(tool, 0, 0, 4),
                     moved(block(3.5, 3 * wall, 4), x, wall / 2, centre + z)]) if style == "slots" else tool,
              detail="screw holes")

    ribs = p.variant(((-1, 1), (1, ), (), (-1, 1)))
    for side in ribs:
        p.add(
            prism_along("x", [(wall / 2, wall / 2), (depth, wall / 2), (depth, wall + 1), (wall + 1, 0.85 * rise),
                              (wall / 2, 0.85 * rise)], wall * 0.8,
                        side * (width - 0.8 * wall) / 2 - 0.4 * wall))

    for x in (-0.27 * width, 0.27 * width):
        p.cut(slot(0.55 * depth, p.choice((4.5, 5.5)), 3 * wall, x, 0.6 * depth, -wall, p.choice((90, 90, 0))))

    corner = p.variant(("round", "cut", "square", "cut"))
    if corner == "round":
        p.fillet(6, both(along("y"), at("z", rise)))
    elif corner == "cut":
        p.chamfer(0.2 * width, both(along("y"), at("z", rise)))

    if p.chance():
        p.cut(block(0.3 * width, 0.3 * depth, 3 * wall, p.choice((0, 0.35 * width)), depth, -wall))

    if p.chance(0.4):
        engraved(p, turned_by(label(p.text(2), 7, 1), 90, "x"), (-0.3 * width, 0, 0.12 * rise + 1))
