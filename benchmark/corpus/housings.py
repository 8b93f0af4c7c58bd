"""Families of boxes, housings and moulded parts."""
from cad import block, circle_points, grid_points, label, prism, prism_along, rectangle, rod, turned_by
from features import corner_points, engraved, through_holes
from part import at


def open_box(p):
    """A tray with corner bosses, partitions, a cable slot, lugs."""
    length, width, height, wall = p.mm(40, 110, 5), p.mm(30, 80, 5), p.mm(12, 40, 1), p.mm(1.5, 3.5)
    corner = p.choice((0, 4, 8))
    p.add(prism(rectangle(length, width), height, 0, corner))
    if p.chance():
        p.fillet(p.mm(1, 3), at("z", 0))

    inner = prism(rectangle(length - 2 * wall, width - 2 * wall), height, wall, max(0, corner - wall))
    p.cut(inner)
    boss = p.mm(2.5, 4.5)
    points = corner_points(length, width, wall + boss * 0.8)[:p.choice((4, 4, 3))]
    p.add(*[
        rod(boss, height - p.mm(2, 6) - wall + 0.2,
            (x, y, wall - 0.1)).common(prism(rectangle(length, width), height, 0, corner)) for x, y in points
    ],
          detail="bosses")
    p.cut(*[rod(0.45 * boss, 2 * height, (x, y, wall + 2)) for x, y in points], detail="bosses")
    for k in range(p.whole(0, 2)):
        x = length * p.mm(-0.25, 0.25, 0.05)
        p.add(block(wall, width - wall, 0.6 * height, x, 0, wall - 0.1))

    openings = p.variant(("slot", "holes", "window", "none"))
    if openings == "slot":
        p.cut(block(4 * wall, 0.3 * width, height, length / 2, p.mm(-8, 8), 0.5 * height))
    elif openings == "holes":
        p.cut(*[
            rod(0.15 * height, 4 * wall, (x, -width / 2 - wall, 0.55 * height), "y")
            for x in (-0.2 * length, 0.05 * length)
        ])
    elif openings == "window":
        p.cut(prism(rectangle(0.4 * length, 0.3 * width, 0.1 * length, 0), 4 * wall, -wall, 2))

    if p.chance(0.4):
        p.add(*[prism(rectangle(14, 16, s * (length / 2 + 6)), wall + 1, 0, p.choice((0, 5))) for s in (-1, 1)])
        p.cut(*[rod(2.2, 20, (s * (length / 2 + 8), 0, -5)) for s in (-1, 1)], detail="lug holes")


def ribbed_housing(p):
    """A motor or gearbox housing: a drum or box with cooling ribs, end flange, feet, a terminal box."""
    radius, length = p.mm(16, 34, 1), p.mm(40, 90, 5)
    drum = p.variant((True, True, False))
    if drum:
        p.add(rod(radius, length, (0, 0, 0), "x"))
    else:
        p.add(prism_along("x", rectangle(1.8 * radius, 1.8 * radius), length, 0, 4))

    count = p.whole(5, 9)
    kind = p.variant(("rings", "fins", "rings")) if drum else "rings"
    if kind == "rings":
        for k in range(count):
            x = length * (0.12 + 0.76 * k / (count - 1)) - 1.2
            p.add(
                rod(1.2 *
                    radius, 2.4, (x, 0, 0), "x") if drum else prism_along("x", rectangle(2.2 * radius, 2.2 *
                                                                                         radius), 2.4, x, 4))
    else:
        number = p.choice((12, 16, 20))
        fin = block(0.8 * length, 2.2, 0.4 * radius, 0.5 * length, 0, 0.85 * radius)
        p.add(*[turned_by(fin, 360 * k / number, "x") for k in range(number)])

    if p.chance(0.7):
        disc = rod(1.5 * radius, 6,
                   (0, 0, 0), "x") if p.chance() else prism_along("x", rectangle(2.6 * radius, 2.6 * radius), 6, 0, 5)
        p.add(disc)
        p.cut(*[rod(2.2, 30, (-10, y, z), "x") for y, z in circle_points(4, 1.36 * radius, 45)], detail="bolt holes")

    p.add(rod(0.6 * radius, 4, (0, 0, 0), "-x"), rod(0.25 * radius, p.mm(14, 30), (0, 0, 0), "-x"))
    if p.chance(0.6):
        size = 0.5 * radius
        p.add(block(0.4 * length, radius, size + 0.4 * radius, p.choice((0.4, 0.65)) * length, 0, 0.8 * radius))

    if p.chance(0.7):
        for y in (-0.8 * radius, 0.8 * radius):
            p.add(block(0.6 * length, 0.35 * radius, 1.4 * radius, 0.5 * length, y, -1.5 * radius),
                  block(0.7 * length, 0.8 * radius, 5, 0.5 * length, 1.15 * y, -1.5 * radius))
            p.cut(*[rod(2.2, 12, (length * t, 1.3 * y, -1.5 * radius - 2)) for t in (0.22, 0.78)], detail="foot holes")

    if p.chance(0.4):
        p.cut(rod(0.4 * radius, 8, (length + 0.01, 0, 0), "-x"))


def brick(p):
    """A toy brick with studs: plain, sloped, cornered, stepped, with cross holes; the plain ones hollow below."""
    pitch = p.choice((8, 12, 16))
    kind = p.variant(("plain", "slope", "corner", "step", "holes"))
    nx, ny = p.whole(2, 5), p.whole(2 if kind == "corner" else 1, 3)
    height = pitch * (1.2 if kind in ("slope", "holes") else p.choice((0.4, 1.2)))
    length, width = nx * pitch - 0.2, ny * pitch - 0.2
    end = length / 2 - pitch  # where the slope or the corner begins
    p.add(block(length, width, height))
    studs = [(x, y, height) for x, y in grid_points(nx, ny, pitch, pitch)]
    if kind == "slope":
        p.cut(
            prism_along("y", [(end, height + 0.1), (end, height), (length / 2, 0.25 * pitch), (length, 0.25 * pitch),
                              (length, height + 0.1)], 2 * width, -width))
        studs = [(x, y, z) for x, y, z in studs if x < end]
    elif kind == "corner":
        p.cut(block(pitch, pitch, 9 * pitch, end + pitch / 2, width / 2 - pitch / 2, -pitch))
        studs = [(x, y, z) for x, y, z in studs if x < end or y < width / 2 - pitch]
    elif kind == "step":
        p.add(block(pitch, width, 0.8 * height, pitch / 2 - length / 2, 0, height))
        studs = [(x, y, 1.8 * height if x < pitch - length / 2 else z) for x, y, z in studs]
    elif kind == "holes":
        p.cut(*[
            rod(0.3 * pitch, 2 * width, ((k + 1) * pitch - length / 2, -width, 0.65 * height), "y")
            for k in range(nx - 1)
        ])

    p.add(*[rod(0.3 * pitch, 0.22 * pitch, (x, y, z - 0.01)) for x, y, z in studs], detail="studs")
    if kind in ("plain", "step"):
        hollow_below(p, nx, ny, pitch, length, width, height)


def hollow_below(p, nx, ny, pitch, length, width, height):
    wall = 0.18 * pitch
    p.cut(block(length - 2 * wall, width - 2 * wall, height - wall))
    tubes = grid_points(nx - 1, ny - 1, pitch, pitch)
    p.add(*[rod(0.35 * pitch, height - 0.5, (x, y, 0)).cut(rod(0.25 * pitch, height - 1, (x, y, 0))) for x, y in tubes])


def cable_clip(p):
    """A clip: an open ring or two on a foot, a saddle, a P clip, a snap hook."""
    radius, wall, width = p.mm(6, 14, 1), p.mm(2, 4), p.mm(10, 25, 1)
    kind = p.variant(("ring", "double", "saddle", "P", "hook"))
    outer = radius + wall
    if kind == "saddle":
        p.add(rod(outer, width, (0, 0, 0), "y"), block(2 * outer + 30, width, wall, 0, width / 2, 0))
        p.cut(block(6 * outer, 3 * width, 2 * outer, 0, 0, -2 * outer), rod(radius, 3 * width, (0, -width, 0), "y"))
        through_holes(p, [(s * (outer + 8), width / 2) for s in p.choice(((-1, 1), (1, )))],
                      2,
                      wall,
                      0,
                      detail="holes",
                      style=p.choice(("plain", "countersink")))
    elif kind == "P":
        p.add(rod(outer, width, (0, 0, 0), "y"), block(outer + 18, width, 2 * wall, (outer + 18) / 2, width / 2,
                                                       -outer))
        p.cut(rod(radius, 3 * width, (0, -width, 0), "y"))
        p.cut(rod(2.2, 60, (outer + 9, width / 2, -40)), detail="holes")
        if p.chance():
            p.cut(block(0.6 * outer, 3 * width, 1.5, 0.8 * outer, 0, -outer + wall))
    elif kind == "hook":
        outline = [(0, 0), (3 * radius, 0), (3 * radius, 2.2 * radius), (2.2 * radius, 3 * radius),
                   (2.2 * radius, 2.4 * radius), (3 * radius - wall, 2 * radius), (3 * radius - wall, wall),
                   (wall, wall), (wall, 2.5 * radius), (0, 2.5 * radius)]
        p.add(prism_along("y", outline, width, 0))
        p.cut(rod(2, 30, (1.5 * radius, width / 2, -5)), detail="holes")
    else:
        centres = (-outer + 0.5 * wall, outer - 0.5 * wall) if kind == "double" else (0, )
        span = 2 * outer * len(centres)
        p.add(*[rod(outer, width, (x, 0, outer), "y") for x in centres],
              block(span + p.choice((0, 20)), width, wall + 1, p.choice((0, 8)), width / 2, 0))
        p.cut(*[rod(radius, 3 * width, (x, -width, outer + 0.3 * wall), "y") for x in centres],
              *[block(1.1 * radius, 3 * width, 2 * outer, x, 0, 1.3 * outer) for x in centres])
        p.cut(rod(2, 30, (p.choice((0, 8)) if kind == "ring" else 0, width / 2, -5)), detail="holes")

    if p.chance(0.4):
        p.add(rod(3, 7,
                  (outer if kind == "hook" else 0, width / 2, -6.5 if kind not in ("P", "saddle") else outer - 0.5)),
              detail="peg")


def battery_holder(p):
    """A cradle of one to three half-round bays with contacts' slots and end walls."""
    count, radius, length = p.whole(1, 3), p.mm(7, 12, 1), p.mm(40, 75, 5)
    wall = p.mm(1.5, 3)
    pitch = 2 * radius + wall
    width = count * pitch + wall
    height = radius * p.mm(0.9, 1.4, 0.1)
    p.add(prism(rectangle(length, width), height, 0, p.choice((0, 0, 3))))
    rows = [(k - (count - 1) / 2) * pitch for k in range(count)]
    p.cut(*[rod(radius, length - 4 * wall, (-length / 2 + 2 * wall, y, radius + wall), "x") for y in rows],
          *[block(length - 4 * wall, 2 * radius, height, 0, y, radius + wall) for y in rows])
    p.cut(*[block(wall, 0.5 * radius, height, s * (length / 2 - wall), y, wall + 2) for y in rows for s in (-1, 1)],
          detail="contact slots")
    if p.chance(0.6):
        p.cut(block(0.35 * length, 3 * width, height, p.choice((0, 0.1 * length)), 0, 0.55 * height))

    if p.chance(0.6):
        p.add(*[
            prism(rectangle(12, 12, s * (length / 2 + 5),
                            s * p.choice((0, 0.25)) * width), wall + 1, 0, 4) for s in p.choice(((-1, 1), (1, )))
        ])
        p.cut(*[rod(1.75, 20, (s * (length / 2 + 6), 0, -5)) for s in (-1, 1)], detail="ear holes")

    p.cut(*[rod(1.5, 30, (0.2 * length * s, y, -9)) for y in rows[:1] for s in (-1, 1)])
    if p.chance():
        engraved(p, label(p.text(2), 0.8 * radius, 2), (-0.15 * length, rows[-1], wall))
