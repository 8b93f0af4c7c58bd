"""Families that pass rotation on."""
import math

from cad import block, circle_points, cone, fused, prism, rod, slot, spline_prism, turned, turned_by, twisted
from features import bolt_circle, bore_with_key
from part import at


def pulley(p):
    """A belt pulley: V grooves, a flat or a toothed rim; a web with holes or spokes, a hub."""
    radius, width = p.mm(20, 60, 2.5), p.mm(12, 30, 1)
    kind = p.variant(("V", "toothed", "flat", "V2"))
    if kind == "toothed":
        teeth = p.whole(16, 28)
        points = []
        for k in range(teeth):
            for share, r in ((0.1, 1), (0.45, 1), (0.55, 0.93), (1.0, 0.93)):
                angle = 2 * math.pi * (k + share) / teeth
                points.append((r * radius * math.cos(angle), r * radius * math.sin(angle)))
        p.add(prism(points, width), rod(1.05 * radius, 2, (0, 0, width)), rod(1.05 * radius, 2, (0, 0, -2)))
    elif kind == "flat":
        p.add(turned([(0, 0), (radius, 0), (1.03 * radius, width / 2), (radius, width), (0, width)]))
    else:
        count = 2 if kind == "V2" else 1
        points = [(0, 0), (radius, 0)]
        pitch = width / count
        depth = min(0.14 * radius, 0.8 * pitch)
        for k in range(count):
            points += [(radius, (k + 0.15) * pitch), (radius - depth, (k + 0.4) * pitch),
                       (radius - depth, (k + 0.6) * pitch), (radius, (k + 0.85) * pitch)]
        p.add(turned(points + [(radius, width), (0, width)]))

    hub = 0.38 * radius
    if radius > 25:
        dish = 0.3 * width
        for z in (-3, width - dish):
            p.cut(rod(0.76 * radius, dish + 3, (0, 0, z)).cut(rod(hub, width + 10, (0, 0, -5))))
        pattern = p.choice(("holes", "slots", "none"))
        count = p.choice((3, 4, 5, 6))
        if pattern == "holes":
            bolt_circle(p, count, (hub + 0.76 * radius) / 2, 0.13 * radius, width, detail="web holes")
        elif pattern == "slots":
            p.cut(*[
                turned_by(slot(0.33 * radius, 0.12 * radius, width, 0.57 * radius), 360 / count * k)
                for k in range(count)
            ])

    if p.chance():
        p.add(rod(hub, p.mm(5, 15), (0, 0, width - 1)))

    bore = hub * p.mm(0.4, 0.6, 0.05)
    p.cut(bore_with_key(bore, 0.6 * bore, 100, -20) if p.chance(0.6) else rod(bore, 100, (0, 0, -20)))


def gear_outline(teeth, module):
    """Points of a spur gear; involute flanks by three points."""
    pitch, tip, root = 0.5 * module * teeth, 0.5 * module * (teeth + 2), 0.5 * module * (teeth - 2.4)
    half = math.pi / 2 / teeth
    points = []
    for k in range(teeth):
        middle = 2 * math.pi * k / teeth
        for share, r in ((-1.5, root), (-1.0, pitch), (-0.45, tip), (0.45, tip), (1.0, pitch), (1.5, root)):
            points.append((r * math.cos(middle + share * half), r * math.sin(middle + share * half)))

    return points


def gear(p):
    """A spur or helical gear with a hub, a keyed bore, web holes or spokes; sometimes a ring or a sector."""
    teeth, module, width = p.whole(12, 26), p.choice((2, 2.5, 3, 4)), p.mm(6, 20, 1)
    root = 0.5 * module * (teeth - 2.4)
    kind = p.variant(("spur", "helical", "double", "sector"))
    outline = gear_outline(teeth, module)
    p.add(twisted(outline, width, p.choice((-1, 1)) * p.mm(8, 15), 2) if kind == "helical" else prism(outline, width))
    hub = 0.4 * root
    if kind == "double":
        p.add(prism(gear_outline(max(9, teeth // 2), module), 2 * width))
        hub = 0.2 * root

    if root > 20 and kind != "double":
        dish = 0.25 * width
        p.cut(rod(0.82 * root, dish, (0, 0, width - dish)).cut(rod(hub, 2 * width)))
        if p.chance(0.6):
            bolt_circle(p, p.choice((3, 4, 5, 6)), (hub + 0.82 * root) / 2, 0.14 * root, width, detail="web holes")

    if p.chance():
        p.add(rod(hub, p.mm(4, 15), (0, 0, width - 1)))

    bore = 0.55 * hub
    p.cut(bore_with_key(bore, 0.5 * bore, 100, -20) if p.chance(0.6) else rod(bore, 100, (0, 0, -20)))
    if kind == "sector":
        p.cut(block(3 * root, 3 * root, 100, 1.5 * root + 0.77 * hub, 0, -20))


def splined_shaft(p):
    """A shaft with a length of splines, a flange or a shoulder and a bearing seat."""
    radius, teeth, length = p.mm(10, 20, 1), p.choice((6, 8, 10, 12, 16)), p.mm(20, 50, 5)
    tooth = 2 * math.pi * radius / teeth * 0.45
    p.add(rod(radius, length),
          *[turned_by(block(0.4 * radius, tooth, length, radius), 360 * k / teeth) for k in range(teeth)])
    p.add(rod(radius * 0.85, p.mm(8, 25, 1), (0, 0, 0), "-z"))
    z = length
    if p.chance(0.6):
        p.add(rod(2 * radius, 6, (0, 0, z)))
        bolt_circle(p, p.choice((3, 4, 6)), 1.6 * radius, 0.18 * radius, 6, z, 15, detail="bolt holes")
        z += 6

    p.add(rod(1.15 * radius, p.mm(10, 40, 5), (0, 0, z - 0.1)))
    if p.chance():
        p.cut(rod(0.5 * radius, 25, (0, 0, -30)), rod(0.5 * radius, 15, (0, 0, -14)))

    p.cut(block(radius, 3 * radius, 8, 1.3 * radius, 0, z + 2), detail="flat")


def cam(p):
    """A disc cam: an eccentric, a lobe or a snail; a hub and a keyed bore."""
    base, lift, height = p.mm(14, 30, 1), p.mm(6, 22, 1), p.mm(6, 18, 1)
    kind = p.variant(("lobe", "snail", "eccentric", "heart"))
    if kind == "eccentric":
        p.add(rod(base + 0.5 * lift, height, (0.5 * lift, 0, 0)))
    elif kind == "lobe":
        nose = 0.4 * base
        centre = base + lift - nose
        tangent = math.acos((base - nose) / centre)
        points = [(r * math.cos(s * tangent) + x, r * math.sin(s * tangent))
                  for s, r, x in ((1, base, 0), (-1, base, 0), (-1, nose, centre), (1, nose, centre))]
        p.add(rod(base, height), rod(nose, height, (centre, 0, 0)), prism(points, height))
    else:
        sign = p.choice((-1, 1))
        points = []
        for k in range(36):
            share = k / 35 if kind == "snail" else 1 - abs(k / 18 - 1)
            angle = sign * 2 * math.pi * k / 36
            points.append(((base + lift * share) * math.cos(angle), (base + lift * share) * math.sin(angle)))
        p.add(spline_prism(points, height, kind == "snail"))

    if p.chance(0.7):
        p.add(rod(0.6 * base, p.mm(4, 14), (0, 0, height - 0.5)))

    bore = 0.35 * base
    p.cut(bore_with_key(bore, 0.5 * bore, 80, -20) if p.chance(0.7) else rod(bore, 80, (0, 0, -20)))
    if p.chance(0.4):
        p.cut(rod(0.12 * base + 1, 4 * height, (0.75 * base + 0.4 * lift, 0, -height)), detail="hole")


def coupling(p):
    """A jaw coupling half, a clamping collar or a cross slider."""
    radius, height = p.mm(15, 32, 1), p.mm(10, 22, 1)
    kind = p.variant(("jaws", "clamp", "slider", "dogs"))
    p.add(rod(radius, height))
    bore = 0.4 * radius
    if kind in ("jaws", "dogs"):
        count = p.choice((2, 3, 4))
        whole = rod(radius, 0.7 * height, (0, 0, height - 0.1)).cut(rod(0.5 * radius, 99))
        share = 360 / count
        angle = share * (0.5 if kind == "jaws" else 0.35)
        fan = [point for k in range(5) for point in circle_points(1, 2 * radius, angle * k / 4)]
        p.add(*[whole.common(turned_by(prism([(0, 0), *fan], 99), share * k)) for k in range(count)])
        p.add(rod(0.8 * radius, p.mm(5, 20), (0, 0, 0), "-z"))
    elif kind == "slider":
        p.add(block(1.9 * radius, 0.5 * radius, 5, 0, 0, height - 0.1).common(rod(radius, 99)))
        p.cut(block(3 * radius, 0.5 * radius, 5))

    p.cut(bore_with_key(bore, 0.5 * bore, 120, -40))
    if kind == "clamp":
        p.cut(block(2 * radius, 2, 99, radius, 0, -9))
        for z in p.choice(((0.5, ), (0.25, 0.75))):
            p.cut(
                fused([
                    rod(2, 4 * radius, (0.7 * radius, -2 * radius, z * height), "y"),
                    rod(3.3, 2 * radius, (0.7 * radius, -0.4 * radius, z * height), "-y")
                ]))
    else:
        p.cut(rod(2.2, 40, (0, 0, 0.5 * height), p.choice(("y", "x"))), detail="set screw")

    if p.chance(0.4):
        p.chamfer(1, at("z", 0))


def impeller(p):
    """A fan or pump wheel: straight, swept or pitched blades on a disc or a hub, an inlet ring on some."""
    radius, height, count = p.mm(22, 50, 1), p.mm(10, 25, 1), p.whole(5, 9)
    kind = p.variant(("swept", "pitched", "radial", "swept"))
    hub = 0.28 * radius
    p.add(cone(hub, p.choice((1, 0.6)) * hub, height + 3))
    if kind != "pitched":
        p.add(rod(radius, 3))

    sense = p.choice((-1, 1))
    for k in range(count):
        if kind == "radial":
            blade = block(0.85 * radius, 2, height, 0.55 * radius, 0, 2.9)
        elif kind == "swept":
            bow = [(0.6 * hub, 0), (0.55 * radius, sense * 0.1 * radius), (0.97 * radius, sense * 0.45 * radius)]
            back = [(x - sense * y * 0.02, y + 2.2) for x, y in reversed(bow)]
            blade = prism(bow + back, height, 2.9, [0, radius, 0, 0, radius, 0])
        else:
            blade = turned_by(block(0.8 * radius, 2.5, 1.3 * height, 0.6 * radius, 0, -0.15 * height), sense * 40, "x",
                              (0, 0, 0.5 * height))
        p.add(turned_by(blade, 360 * k / count))

    p.common(rod(radius, 200, (0, 0, -50)))
    if kind == "radial" or (kind == "swept" and p.chance()):
        p.add(rod(radius, 2.5, (0, 0, height + 0.5)).cut(rod(0.6 * radius, 99)))

    p.cut(bore_with_key(0.5 * hub, 0.4 * hub, 300, -100) if p.chance() else rod(0.5 * hub, 300, (0, 0, -100)))
