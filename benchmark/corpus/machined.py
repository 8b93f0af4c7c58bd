"""Families of bearings, levers, handles and castings."""
import math

from cad import (ball, block, circle_points, cone, fused, moved, pipe, prism, prism_along, rectangle, ring, rod, slot,
                 turned, turned_by)
from features import bore_with_key, corner_points, hex_head, thread, through_holes
from part import along, at, both, circular, either
from pipework import direction


def pillow_block(p):
    """A bearing block: a foot with holes or slots, a round or square housing, a stepped bore, a cap split, a nipple."""
    radius, bore = p.mm(16, 32, 1), p.mm(7, 14, 0.5)
    width, foot = p.mm(14, 32, 1), p.mm(7, 12, 1)
    length = 2 * radius + p.mm(20, 50, 5)
    centre = radius + p.mm(3, 12, 1)
    p.add(prism(rectangle(length, width), foot, 0, p.choice((0, 4, 0.3 * width))))
    shape = p.variant(("round", "square", "tapered"))
    if shape == "square":
        p.add(block(2 * radius, width, centre + 0.8 * radius))
        p.fillet(4, both(along("y"), at("z", centre + 0.8 * radius)))
    else:
        base = 1.3 if shape == "tapered" else 1.0
        p.add(
            rod(radius, width, (0, -width / 2, centre), "y"),
            prism_along("y", [(-base * radius, 0), (base * radius, 0), (radius, centre), (-radius, centre)], width,
                        -width / 2))

    if p.chance():
        p.add(rod(0.75 * radius, width + 8, (0, -width / 2 - p.choice((4, 8, 0)), centre), "y"))

    p.cut(rod(bore, 3 * width, (0, -1.5 * width, centre), "y"))
    if p.chance(0.7):
        p.cut(rod(min(1.4 * bore, 0.65 * radius), 0.5 * width + 20, (0, 0.1 * width, centre), "y"))

    x = (length + 2 * radius) / 4 + 0.5
    if p.chance():
        p.cut(*[slot(0.2 * length, 6, 3 * foot, s * x, 0, -foot) for s in (-1, 1)], detail="holes")
    else:
        points = [(s * x, t) for s in (-1, 1) for t in p.choice(((0, ), (-0.3 * width, 0.3 * width)))]
        through_holes(p, points, 2.5, foot, 0, detail="holes", style=p.choice(("plain", "counterbore")))

    top = centre + (0.8 * radius if shape == "square" else radius)
    if p.chance(0.6):
        p.add(fused([hex_head(7, 4, top - 0.5, False),
                     rod(2, 6, (0, 0, top)),
                     ball(2.4, (0, 0, top + 6))]),
              detail="nipple")

    if p.chance(0.4):
        p.cut(
            block(2 * radius + 10, 3 * width, 1.2, 0, 0,
                  centre - 0.6).cut(block(2.2 * bore, 4 * width, 9, 0, 0, centre - 4)))

    if p.chance(0.4):
        p.cut(block(0.5 * length, 2 * width, 2, 0, 0, 0))


def clevis(p):
    """A fork with a shank: round or square, an eye through both prongs, a pin on some."""
    width, gap, depth = p.mm(16, 34, 1), p.mm(0.3, 0.5, 0.01), p.mm(14, 30, 1)
    reach = depth * p.mm(1.0, 1.6, 0.1)
    gap *= width
    eye = depth / 2
    prongs = fused([block(reach, width, depth, reach / 2, 0, -eye), rod(eye, width, (reach, -width / 2, 0), "y")])
    p.add(prongs, block(0.6 * depth, width, depth, -0.3 * depth, 0, -eye))
    p.cut(block(2 * reach, gap, 2 * depth, reach, 0, -depth))
    if p.chance():
        p.cut(rod(gap / 2, 2 * depth, (0, 0, -depth)))

    if p.chance():
        p.cut(block(2 * reach + depth, width, 2 * depth, reach * 1.2, -width * 0.95, -depth))

    shank = p.variant(("round", "thread", "flange", "square"))
    z = 0.6 * depth
    size = 0.36 * min(width, depth)
    length = p.mm(15, 45, 5)
    if shank == "square":
        p.add(block(length, 1.5 * size, 1.5 * size, -z - length / 2 + 0.1, 0, -0.75 * size))
    elif shank == "thread":
        p.add(moved(turned_by(thread(p, size, length), -90, "y"), -z + 0.1))
    elif shank == "round":
        p.add(rod(size, length, (-z + 0.1, 0, 0), "-x"))
        p.cut(rod(0.35 * size, 4 * width, (-z - 0.7 * length, -2 * width, 0), "y"), detail="cross hole")
    else:
        p.add(moved(turned_by(prism(rectangle(1.9 * depth, 1.7 * width), 5, 0, 4), -90, "y"), -z + 0.1))
        p.cut(*[rod(2, 20, (-z - 12, y, zz), "x") for zz, y in corner_points(1.9 * depth, 1.7 * width, 4)],
              detail="holes")

    p.cut(rod(0.5 * eye, 3 * width, (reach, -1.5 * width, 0), "y"))
    if p.chance(0.4):
        p.add(rod(0.5 * eye, 1.4 * width, (reach, -0.7 * width, 0), "y"),
              rod(0.75 * eye, 3, (reach, 0.6 * width, 0), "y"),
              detail="pin")

    if p.chance():
        p.fillet(p.mm(0.5, 1.5), either(circular(eye - 0.01, eye + 0.01)))


def lever(p):
    """An arm between two hubs, straight or bent, one hub higher; with a recess, a slit, a key or a third hub."""
    big, small = p.mm(9, 20, 1), p.mm(6, 12, 1)
    length, arm = p.mm(45, 120, 5), p.mm(5, 10, 1)
    height, other = p.mm(10, 26, 1), p.mm(8, 20, 1)
    shift = p.choice((0, 0, p.mm(3, 8)))
    bent = p.variant((0, 30, 0, 60, 0))
    across, up = direction(bent, 0.5 * length)
    elbow_at, tip = (0.5 * length, 0), (0.5 * length + across, up)
    p.add(rod(big, height), rod(small, other, (*tip, shift)))
    if bent:
        middle = (big + small) / 2
        p.add(bar_between((0, 0), elbow_at, 0.75 * big, 0.75 * middle, arm, shift),
              bar_between(elbow_at, tip, 0.75 * middle, 0.75 * small, arm, shift),
              rod(0.75 * middle, arm, (*elbow_at, shift)))
    else:
        p.add(bar_between((0, 0), tip, 0.75 * big, 0.75 * small, arm, shift))

    if p.chance():
        recess = block(0.6 * elbow_at[0], 0.8 * small, arm, elbow_at[0] * (0.6 if bent else 1.0), 0, shift + 0.7 * arm)
        p.cut(recess.cut(rod(big, 100)), detail="recess")

    p.cut(rod(0.5 * small, 100, (*tip, -30)))
    p.cut(bore_with_key(0.55 * big, 0.5 * big, 100, -30) if p.chance() else rod(0.55 * big, 100, (0, 0, -30)))
    kind = p.variant(("slit", "none", "third", "set screw", "none"))
    if kind == "slit":
        p.cut(block(2 * big, 0.2 * big, 100, -1.3 * big, 0, -30))
    elif kind == "third":
        x = -big - small
        p.add(prism(rectangle(-x - 0.7 * big, 1.2 * small, x / 2 - 0.35 * big), arm), rod(small, other, (x, 0, 0)))
        p.cut(rod(0.5 * small, 100, (x, 0, -30)))
    elif kind == "set screw":
        p.cut(rod(0.15 * big + 0.5, 2 * big, (0, 0, 0.75 * height + 0.1 * arm), "y"), detail="set screw")

    if p.chance():
        p.chamfer(0.8, both(circular(0.99 * big, 1.01 * big), at("z", height)))


def bar_between(start, end, start_half, end_half, height, z):
    """A flat bar from one point (x, y) to another, its half width changing on the way."""
    (x0, y0), (x1, y1) = start, end
    length = math.hypot(x1 - x0, y1 - y0)
    nx, ny = (y0 - y1) / length, (x1 - x0) / length
    return prism([(x0 + start_half * nx, y0 + start_half * ny), (x0 - start_half * nx, y0 - start_half * ny),
                  (x1 - end_half * nx, y1 - end_half * ny), (x1 + end_half * nx, y1 + end_half * ny)], height, z)


def crank(p):
    """A crank or a hand wheel: an arm or a rim with spokes, and a grip across it."""
    kind = p.variant(("crank", "wheel", "double", "wheel"))
    radius, height = p.mm(30, 60, 5), p.mm(14, 24, 1)
    hub = p.mm(9, 14, 1)
    p.add(rod(hub, height))
    if kind == "wheel":
        count = p.choice((3, 4, 5))
        rim = p.mm(4, 6)
        octagon = [(radius + x, 0.7 * height + z) for x, z in circle_points(8, rim, 22.5)]
        p.add(turned(octagon) if p.member % 4 == 1 else ring(radius, rim, (0, 0, 0.7 * height)))
        for k in range(count):
            p.add(turned_by(rod(3.5, radius, (0, 0, 0.65 * height), "x"), 360 / count * k))
    else:
        for side in (1, -1) if kind == "double" else (1, ):
            p.add(prism([(0, -0.7 * hub), (side * radius, -6), (side * radius, 6), (0, 0.7 * hub)][::side], 7, 2),
                  rod(8, 10, (side * radius, 0, 1)))

    length = p.mm(18, 45)
    z = 0.75 * height if kind == "wheel" else 10.9
    grip = p.variant(("taper", "ball", "barrel"))
    x = radius
    p.add(rod(3.5, 8, (x, 0, z)))
    if grip == "taper":
        p.add(cone(5, 8, length, (x, 0, z + 6)))
    elif grip == "ball":
        p.add(ball(9, (x, 0, z + 13)))
    else:
        p.add(
            moved(turned([(0, 0), (5, 0), (8, 0.4 * length), (8, 0.6 * length), (5, length), (0, length)], 3), x, 0,
                  z + 6))

    p.cut(prism(rectangle(hub, hub), 100, -20) if p.chance() else bore_with_key(0.5 * hub, 0.4 * hub, 100, -20))
    p.cut(rod(2, 40, (0, 0, 0.3 * height), "-y"), detail="set screw")


def handle(p):
    """A pull handle: a bow of round or flat section on two feet; a T or an L grip."""
    span, rise, radius = p.mm(60, 130, 5), p.mm(25, 45, 5), p.mm(4, 8)
    kind = p.variant(("bow", "flat", "T", "bar"))
    half = span / 2
    if kind == "bow":
        bar = pipe([(-half, 0), (-half, rise), (half, rise), (half, 0)], p.choice((2.5, 1.6)) * radius, radius)
        p.add(turned_by(bar, 90, "x"))
        p.add(*[rod(1.8 * radius, 4, (s * half, 0, -2)) for s in (-1, 1)])
    elif kind == "flat":
        outline = [(-half, 0), (-half, rise), (half, rise), (half, 0), (half - 8, 0), (half - 14, rise - 8),
                   (14 - half, rise - 8), (8 - half, 0)]
        p.add(prism_along("y", outline, 2.5 * radius, -1.25 * radius, [0, 10, 10, 0, 0, 8, 8, 0]))
        p.add(*[block(22, 3 * radius, 4, s * (half + 4), 0, -0.1) for s in (-1, 1)])
        p.cut(*[rod(2, 20, (s * (half + 9), 0, -5)) for s in (-1, 1)], detail="holes")
        p.fillet(1.5, lambda edge: edge.BoundBox.ZMin > 5)
        return
    elif kind == "bar":
        p.add(rod(radius, span + 30, (-half - 15, 0, rise), "x"),
              *[rod(0.8 * radius, rise, (s * half, 0, 0)) for s in (-1, 1)])
    else:
        p.add(rod(0.8 * radius, rise), rod(radius, 0.5 * span, (-0.25 * span + p.choice((0, 8)), 0, rise), "x"),
              rod(2.2 * radius, 5, (0, 0, -2)))
        p.cut(rod(0.4 * radius, 15, (0, 0, -5)))
        p.cut(block(radius, 9 * radius, 8, 2.2 * radius, 0, -3))
        return

    p.cut(*[rod(0.45 * radius, 14, (s * half, 0, -4)) for s in (-1, 1)], detail="holes")
    if p.chance(0.6):
        x = p.choice((half, -half))
        p.add(slot(6 * radius, 3 * radius, 4, x + 1.5 * radius, 0, -2))
        p.cut(rod(0.5 * radius, 20, (x + 3 * radius, 0, -9)))


def casting(p):
    """A cast bracket with every edge rounded: a base, a tower or a drum, ribs and pads."""
    length, width, base = p.mm(50, 110, 5), p.mm(35, 65, 5), p.mm(6, 12, 1)
    soft = p.mm(1, 3)
    p.add(prism(rectangle(length, width), base, 0, p.choice((5, 10))))
    x = p.choice((0, -1, 1)) * 0.2 * length
    drum = 0.3 * width
    rise = p.mm(20, 45, 5)
    lying = p.variant((True, False))
    if lying:
        p.add(rod(drum, 0.8 * width, (x, -0.4 * width, base + rise - drum + 4), "y"),
              block(1.4 * drum, 0.6 * width, rise - drum + 4, x, 0, base - 0.1))
    else:
        p.add(cone(drum, 0.8 * drum, rise, (x, 0, base - 0.1)))

    if p.chance(0.7):
        far = 0.42 * length * (-1 if x > 0 else 1)
        p.add(prism_along("y", [(x, base - 1), (far, base - 1), (x, base + 0.75 * rise)][::1 if far > x else -1], 6,
                          -3))

    if p.chance(0.6):
        p.add(rod(6, base + p.mm(3, 12), (-x - 0.28 * length * (1 if x == 0 else 0.3), 0.28 * width, 0)))

    if p.chance(0.6):
        p.add(prism(rectangle(16, 16, 0.38 * length, -0.3 * width), base + 4, 0, 4))

    p.fillet(soft)
    p.cut(
        rod(0.5 * drum, 3 *
            width, (x, -width, base + rise - drum + 4), "y") if lying else rod(0.5 * drum, 3 * rise, (x, 0, -1)))
    through_holes(p, corner_points(length, width, 7)[:p.choice((3, 4))], 2.75, base, 0, detail="holes")
