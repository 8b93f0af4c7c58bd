"""Features that many families share: holes, threads, engraving."""
import cad
from cad import block, circle_points, cone, hexagon, moved, prism, rod, turned, vector


def corner_points(length, width, inset):
    return [(s * (length / 2 - inset), t * (width / 2 - inset)) for s in (-1, 1) for t in (-1, 1)]


def through_holes(p, points, radius, height, z=0, detail=None, style="plain"):
    """Holes along z at points (x, y) through z to z + height; their heads sink in from above."""
    for x, y in points:
        tools = [rod(radius, height + 2, (x, y, z - 1))]
        if style == "counterbore":
            depth = 0.4 * height
            tools.append(rod(1.8 * radius, depth + 1, (x, y, z + height - depth)))
        elif style == "countersink":
            depth = min(radius, 0.6 * height)
            tools.append(cone(radius, radius + depth, depth, (x, y, z + height - depth)))
        p.cut(cad.fused(tools), detail=detail)


def bolt_circle(p, count, circle, radius, height, z=0, phase=0, detail=None, style="plain"):
    through_holes(p, circle_points(count, circle, phase), radius, height, z, detail, style)


def engraved(p, text, place, detail="label"):
    """Cuts a text that lies flat into the face below it."""
    p.cut(moved(text, *place), detail=detail)


def ringed_thread(radius, length, pitch, z=0):
    """A thread as rings: a rod along z with grooves of a V, its ends bevelled."""
    depth = 0.55 * pitch
    profile = [(0, 0), (radius - depth, 0)]
    turns = max(2, int(length / pitch))
    step = length / turns
    for k in range(turns):
        profile += [(radius, (k + 0.35) * step), (radius, (k + 0.65) * step), (radius - depth, (k + 1) * step)]

    profile.append((0, length))
    return moved(turned(profile), 0, 0, z)


def plain_thread(radius, length, z=0, bevel=1):
    """A thread as a cylinder with a bevelled end."""
    return moved(turned([(0, 0), (radius, 0), (radius, length - bevel), (radius - bevel, length), (0, length)]), 0, 0,
                 z)


def thread(p, radius, length, z=0):
    """Either kind of thread."""
    rings = p.chance()
    return ringed_thread(radius, length, max(1.25, 0.3 * radius), z) if rings else plain_thread(radius, length, z)


def hex_head(across, height, z=0, bevelled=True):
    """A hexagon prism, its upper corners cut by a cone."""
    head = prism(hexagon(across), height, z)
    if not bevelled:
        return head

    corner = across / 3**0.5 * 2
    top = across / 2 * 0.96
    slope = 0.5 * (corner / 2 - top)
    hull = turned([(0, z), (corner, z), (corner, z + height - slope - 0.5 * (corner - corner / 2)), (top, z + height),
                   (0, z + height)])
    return head.common(hull)


def keyway(p, radius, width, depth, length, z, detail="keyway"):
    """A round-ended groove along z in a shaft of a radius, on the side of x."""
    tool = cad.slot(length, width, 2 * depth)
    tool.rotate(vector((0, 0, 0)), vector("y"), -90)
    tool.translate(vector((radius + depth, 0, z + length / 2)))
    p.cut(tool, detail=detail)


def bore_with_key(radius, width, height, z=0):
    """The hollow of a hub: a bore and its key's groove on the side of y."""
    return cad.fused([
        rod(radius, height, (0, 0, z)),
        block(width, radius + 0.45 * width, height, 0, (radius + 0.45 * width) / 2, z)
    ])
