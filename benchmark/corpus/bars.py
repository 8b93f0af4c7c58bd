"""Families of extruded and milled bars and blocks."""
import math

from cad import block, grid_points, label, prism, prism_along, rectangle, rod, slot, turned_by
from features import engraved, through_holes
from part import along, at


def wedge(p):
    """A ramp: cut flat in front, with a groove, a bore, a step or a cross hole."""
    length, width, rise = p.mm(40, 110, 5), p.mm(20, 60, 5), p.mm(15, 50, 5)
    nose = p.choice((0, p.mm(2, 8)))
    back = p.choice((0, p.mm(5, 20)))
    outline = [(0, 0), (length, 0), (length, rise), (length - back, rise), (0, nose)]
    if back == 0:
        outline.pop(3)

    if nose == 0:
        outline.pop()

    p.add(prism_along("y", outline, width, -width / 2))
    kind = p.variant(("groove", "steps", "slot", "corner", "plain"))
    if kind == "groove":
        groove = p.mm(0.2, 0.4, 0.01) * width
        p.cut(block(length, groove, rise, length * p.choice((0.5, 0.8)), p.choice((0, 0, width / 4)), 0.35 * rise))
    elif kind == "steps":
        for k in (1, 2, 3):
            p.cut(block(length, 2 * width, rise, 0.25 * k * length - length / 2, 0, (0.25 * k - 0.12) * rise))
    elif kind == "slot":
        p.cut(slot(0.5 * length, 0.25 * width, 3 * rise, 0.55 * length, 0, -rise))
    elif kind == "corner":
        p.cut(prism([(length + 1, -width), (0.5 * length, -width), (length + 1, 0.1 * width)], 2 * rise))

    if kind != "slot" and p.chance():
        p.cut(rod(0.12 * width + 1, 2 * width, (0.75 * length, -width, 0.3 * rise), "y"))

    if p.chance():
        p.cut(rod(3, 2 * rise, (0.4 * length, -0.2 * width, -1)), detail="hole")

    if p.chance(0.4):
        p.cut(block(0.2 * length, width, 0.4 * rise, 0.9 * length, 0.6 * width, 0.6 * rise))

    if p.chance(0.7):
        p.fillet(p.mm(1, 3), p.choice((along("z"), along("y"), lambda edge: True)))


def extrusion(p):
    """A length of a T, U, I, Z, C or slotted profile, ends square or mitred, with a few holes."""
    w, h, t, length = p.mm(20, 45, 1), p.mm(20, 50, 1), p.mm(2.5, 6), p.mm(40, 130, 5)
    a = w / 2
    s = t / 2
    lip = 0.3 * w
    outlines = {
        "T": [(-s, 0), (s, 0), (s, h - t), (a, h - t), (a, h), (-a, h), (-a, h - t), (-s, h - t)],
        "U": [(-a, 0), (a, 0), (a, h), (a - t, h), (a - t, t), (t - a, t), (t - a, h), (-a, h)],
        "I": [(-a, 0), (a, 0), (a, t), (s, t), (s, h - t), (a, h - t), (a, h), (-a, h), (-a, h - t), (-s, h - t),
              (-s, t), (-a, t)],
        "Z": [(-a, 0), (s, 0), (s, h - t), (a, h - t), (a, h), (-s, h), (-s, t), (-a, t)],
        "C": [(-a, 0), (a, 0), (a, h), (a - lip, h), (a - lip, h - t), (a - t, h - t), (a - t, t), (t - a, t),
              (t - a, h - t), (lip - a, h - t), (lip - a, h), (-a, h)],
        "L": [(-a, 0), (a, 0), (a, t), (t - a, t), (t - a, h), (-a, h)],
    }
    kind = p.variant(("T", "slotted", "Z", "C", "I", "L", "U"))
    if kind == "slotted":
        slotted_profile(p, w, length)
        h = w
    else:
        p.add(prism_along("y", outlines[kind], length, 0, p.choice((0, 0, 0.3 * t))))

    if p.chance(0.4):
        p.cut(turned_by(block(4 * w, 2 * h, 4 * h, 0, -h, -h), p.choice((20, 30, 45)), p.choice(("x", "z"))))

    if p.chance(0.6):
        drill = p.choice((2, 3))
        p.cut(*[rod(drill, 3 * h, (p.choice((0, 0, a / 2)), length * k, -h)) for k in (0.45, 0.75)], detail="holes")


def slotted_profile(p, w, length):
    """A square bar with undercut grooves on its four sides."""
    p.add(prism_along("y", rectangle(w, w, 0, w / 2), length, 0, 1.5))
    neck, throat = 0.22 * w, 0.12 * w
    tee = [(-neck / 2, 0), (neck / 2, 0), (neck / 2, throat), (neck, throat), (0.5 * neck, 0.27 * w),
           (-0.5 * neck, 0.27 * w), (-neck, throat), (-neck / 2, throat)]
    groove = prism_along("y", tee, length)
    for side in range(4):
        p.cut(turned_by(groove, 90 * side, "y", (0, 0, w / 2)))

    p.cut(rod(0.1 * w, length, (0, 0, w / 2), "y"))


def heat_sink(p):
    """Fins or pins on a base plate."""
    length, width, base = p.mm(30, 90, 5), p.mm(30, 80, 5), p.mm(3, 8, 1)
    rise = p.mm(10, 35, 1)
    p.add(block(length, width, base))
    count = p.whole(5, 11)
    pitch = width / count
    fin = p.mm(0.25, 0.5, 0.01) * pitch
    kind = p.variant(("fins", "pins", "fan", "fins", "fins"))
    if kind == "pins":
        n = p.whole(4, 6)
        p.add(*[block(fin + 2, fin + 2, rise, x, y, base - 0.1) for x, y in grid_points(n, n, length / n, width / n)])
    else:
        cut = p.choice((0, 0, 0.3))
        for k in range(count):
            y = (k - (count - 1) / 2) * (width - fin) / (count - 1)
            top = rise * (1 - 0.5 * abs(y) / width * 2) if kind == "fan" else rise
            p.add(block(length * (1 - cut * (k % 2)), fin, top, 0, y, base - 0.1))
        if p.chance(0.4):
            p.cut(block(0.15 * length, width, rise + 1, 0.12 * length, 0, base))

    if p.chance(0.6):
        ear = p.mm(8, 14)
        p.add(prism(rectangle(length + 2 * ear, 0.5 * width), base, 0, 3))
        through_holes(p, [(s * (length + ear) / 2, 0) for s in (-1, 1)], 2, base, detail="holes")


def v_block(p):
    """A block with V grooves, side slots and a clamp's holes; a vice jaw with serrations."""
    length, width, height = p.mm(30, 80, 5), p.mm(40, 65, 5), p.mm(25, 50, 5)
    p.add(block(length, width, height))
    depth = p.mm(0.18, 0.28, 0.01) * min(width, height)
    p.cut(prism_along("x", [(-depth, height + 0.01), (depth, height + 0.01), (0, height - depth)], 2 * length, -length),
          block(2 * length, 2.5, 4, 0, 0, height - depth - 2))
    if p.chance():
        p.cut(prism_along("x", [(-0.5 * depth, -0.01), (0, 0.5 * depth), (0.5 * depth, -0.01)], 2 * length, -length))

    sides = p.choice(((-1, 1), (1, ), ()))
    p.cut(*[block(2 * length, 0.2 * width, 0.2 * height, 0, s * 0.5 * width, 0.35 * height) for s in sides])
    if p.chance(0.6):
        count = p.whole(3, 6)
        p.cut(*[
            prism_along("y", [(x - 1.5, height + 0.01), (x + 1.5, height + 0.01), (x, height - 2)], 3 * width, -width)
            for x in [(k - (count - 1) / 2) * 0.7 * length / count for k in range(count)]
        ],
              detail="serrations")

    through_holes(p, [(s * 0.36 * length, p.choice((0.4, -0.4)) * width) for s in (-1, 1)],
                  2,
                  height,
                  0,
                  detail="holes")
    if p.chance():
        p.cut(rod(0.14 * height, 0.4 * length, (-length, 0.15 * width, 0.3 * height), "x"),
              rod(0.14 * height, length, (-0.9 * length, 0.15 * width, 0.3 * height), "x"))


def rack(p):
    """A toothed bar: straight or slanted teeth on a length of it, holes, an end cut down, a T foot."""
    module, teeth = p.choice((2, 3, 4)), p.whole(8, 16)
    pitch = math.pi * module
    length, width, height = teeth * pitch, p.mm(10, 24, 1), p.mm(12, 22, 1)
    base = height - 2.25 * module
    outline = [(-length / 2, 0), (length / 2, 0)]
    for k in reversed(range(teeth)):
        x = (k - teeth / 2) * pitch
        outline += [(x + 0.93 * pitch, base), (x + 0.68 * pitch, height), (x + 0.32 * pitch, height),
                    (x + 0.07 * pitch, base)]

    outline.append((-length / 2, base))
    p.add(prism_along("y", outline, width, -width / 2))
    kind = p.variant(("end", "foot", "slant", "plain"))
    if kind == "end":
        p.cut(block(0.4 * length, 2 * width, height, length / 2, 0, 0.6 * base))
        p.cut(rod(0.2 * width, 4 * height, (0.4 * length, 0, -height)))
    elif kind == "foot":
        p.add(block(length, width + 12, 5, 0, 6))
    elif kind == "slant":
        p.cut(*[turned_by(block(length, 3 * width, 3 * height, s * length * 0.95, 0, -height), 20) for s in (-1, 1)])

    count = p.choice((2, 3))
    for k in range(count):
        x = (k - (count - 1) / 2) * 0.5 * length / count - 0.1 * length
        p.cut(rod(0.22 * base, 4 * width, (x, -2 * width, 0.5 * base), "y"), detail="holes")


def carriage(p):
    """A linear guide's carriage: a block over a dovetail or a rail groove, end caps, a hole pattern, a nipple."""
    length, width, height = p.mm(35, 80, 5), p.mm(30, 60, 5), p.mm(18, 35, 1)
    rail = 0.4 * width
    kind = p.variant(("dovetail", "rail", "round"))
    p.add(block(length, width, height))
    if p.chance():
        p.add(block(length, width + 18, 0.35 * height, 0, 0, 0.65 * height))
        width += 18

    half = rail / 2
    if kind == "round":
        centre = 0.3 * height
        p.cut(rod(half, 2 * length, (-length, 0, centre), "x"),
              block(2 * length, 1.5 * half, height, 0, 0, centre - height))
    else:
        waist = 0.7 * half if kind == "dovetail" else half
        depth = 0.5 * height
        groove = [(-waist, -1), (waist, -1), (waist, 0), (half, depth), (-half, depth), (-waist, 0)]
        p.cut(prism_along("x", groove, 2 * length, -length))
        if kind == "rail":
            p.cut(block(2 * length, 1.25 * rail, 0.15 * height, 0, 0, 0.2 * height))

    if p.chance(0.7):
        for s in (-1, 1):
            p.cut(block(1.5, 3 * width, 1.5, s * (length / 2 - 0.14 * length), 0, height - 1))

    nx = p.choice((2, 2, 3))
    through_holes(p,
                  grid_points(nx, 2, 0.55 * length / (nx - 1), 0.72 * width),
                  p.choice((1.75, 2.25)),
                  height,
                  0,
                  detail="holes",
                  style=p.choice(("plain", "counterbore")))
    if p.chance(0.7):
        p.add(rod(2.5, 6, (length / 2 - 0.1, p.choice((0, 0.3 * rail)), 0.75 * height), "x"), detail="nipple")

    if p.chance():
        p.chamfer(p.mm(1, 2.5), p.choice((along("x"), at("z", height))))

    if p.chance(0.6):
        engraved(p, label(p.text(3), 0.16 * width, 1), (0, 0, height))


def cuboid(p):
    """A plain block, as milled, cast or packed: sometimes with one hole, one step or one slot."""
    length, width, height = p.mm(40, 110, 1), p.mm(30, 80, 1), p.mm(20, 70, 1)
    p.add(block(length, width, height))
    kind = p.choice(("plain", "plain", "plain", "hole", "step", "slot"))
    if kind == "hole":
        through_holes(p, [(0.2 * length, 0.1 * width)], p.mm(3, 8, 0.5), height, 0)
    if kind == "step":
        p.cut(block(0.4 * length, 2 * width, height, 0.5 * length, 0, 0.6 * height))
    if kind == "slot":
        p.cut(block(2 * length, 0.25 * width, height, 0, 0.1 * width, 0.7 * height))
