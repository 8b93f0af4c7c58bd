"""Solids of the OpenCASCADE kernel, by FreeCAD's python module: what the families of parts are made of.

Lengths in millimetres, angles in degrees. A point is (x, y, z); an axis is "x", "-x", ... or a vector.
"""
import importlib
import math
import sys

# Debian keeps the modules outside of the path of python.
sys.path.append("/usr/lib/freecad-python3/lib")
FreeCAD = importlib.import_module("FreeCAD")
Part = importlib.import_module("Part")
MeshPart = importlib.import_module("MeshPart")

AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1), "-x": (-1, 0, 0), "-y": (0, -1, 0), "-z": (0, 0, -1)}
KernelError = (Part.OCCError, RuntimeError, ValueError)


def vector(v):
    return FreeCAD.Vector(*(AXES[v] if isinstance(v, str) else v))


def block(sx, sy, sz, x=0, y=0, z=0):
    """A box centred on (x, y) that stands on the height z."""
    return Part.makeBox(sx, sy, sz, vector((x - sx / 2, y - sy / 2, z)))


def rod(radius, length, at=(0, 0, 0), axis="z"):
    """A cylinder that starts at a point."""
    return Part.makeCylinder(radius, length, vector(at), vector(axis))


def cone(radius, end_radius, length, at=(0, 0, 0), axis="z"):
    if abs(radius - end_radius) < 1e-6:
        return rod(radius, length, at, axis)

    return Part.makeCone(radius, end_radius, length, vector(at), vector(axis))


def ball(radius, at=(0, 0, 0)):
    return Part.makeSphere(radius, vector(at))


def ring(radius, section_radius, at=(0, 0, 0), axis="z"):
    """A torus."""
    return Part.makeTorus(radius, section_radius, vector(at), vector(axis))


def circle_points(count, radius, phase=0, x=0, y=0):
    """Points (x, y) spread evenly on a circle."""
    angles = [math.radians(phase + 360 * k / count) for k in range(count)]
    return [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles]


def grid_points(nx, ny, dx, dy, x=0, y=0):
    """Points (x, y) of a grid centred on (x, y)."""
    return [(x + dx * (i - (nx - 1) / 2), y + dy * (j - (ny - 1) / 2)) for i in range(nx) for j in range(ny)]


def rectangle(sx, sy, x=0, y=0):
    return [(x - sx / 2, y - sy / 2), (x + sx / 2, y - sy / 2), (x + sx / 2, y + sy / 2), (x - sx / 2, y + sy / 2)]


def hexagon(across_flats, phase=0):
    return circle_points(6, across_flats / math.sqrt(3), phase)


def wire(points, radius=0, closed=True):
    """A polyline in the plane z = 0 with its corners rounded by one radius, or by one of a list for each corner."""
    corners = [vector((x, y, 0)) for x, y in points]
    radii = radius if isinstance(radius, (list, tuple)) else [radius] * len(corners)
    pieces = []
    for k, corner in enumerate(corners):
        if radii[k] <= 0 or (not closed and k in (0, len(corners) - 1)):
            pieces.append((corner, None, corner))
        else:
            pieces.append(rounded_corner(corners[k - 1], corner, corners[(k + 1) % len(corners)], radii[k]))

    edges = []
    for k, (start, middle, end) in enumerate(pieces):
        if middle:
            edges.append(Part.Arc(start, middle, end).toShape())
        follower = pieces[(k + 1) % len(pieces)][0]
        if (closed or k + 1 < len(pieces)) and end.distanceToPoint(follower) > 1e-6:
            edges.append(Part.makeLine(end, follower))

    return Part.Wire(edges)


def rounded_corner(before, corner, after, radius):
    """(start, middle, end) of the arc that rounds a corner; its radius gives way to short sides."""
    to_before = before - corner
    to_after = after - corner
    half = to_before.getAngle(to_after) / 2
    if half > math.pi / 2 - 1e-3:
        return corner, None, corner

    length = min(radius / math.tan(half), 0.49 * to_before.Length, 0.49 * to_after.Length)
    radius = length * math.tan(half)
    to_before.normalize()
    to_after.normalize()
    bisector = to_before + to_after
    bisector.normalize()
    middle = corner + bisector * (radius / math.sin(half) - radius)
    return corner + to_before * length, middle, corner + to_after * length


def prism(points, height, z=0, radius=0):
    """A polygon of the xy plane, corners rounded, as a solid from z to z + height."""
    solid = Part.Face(wire(points, radius)).extrude(vector((0, 0, height)))
    return moved(solid, 0, 0, z)


def prism_along(axis, points, length, at=0, radius=0):
    """A prism along x (points are (y, z)) or along y (points are (x, z)), from `at` to `at` + length."""
    solid = Part.Face(wire(points, radius)).extrude(vector((0, 0, length)))
    if axis == "x":
        matrix = FreeCAD.Matrix(0, 0, 1, at, 1, 0, 0, 0, 0, 1, 0, 0)
    else:
        matrix = FreeCAD.Matrix(1, 0, 0, 0, 0, 0, -1, at + length, 0, 1, 0, 0)

    solid.Placement = FreeCAD.Placement(matrix)
    return solid


def slot(length, width, height, x=0, y=0, z=0, angle=0):
    """A bar with round ends, `length` from end to end, lying in the direction of the angle."""
    if length <= width + 1e-6:
        return rod(width / 2, height, (x, y, z))

    bar = prism(rectangle(length, width), height, z, width / 2 - 1e-4)
    return moved(turned_by(bar, angle), x, y, 0)


def turned(profile, radius=0, angle=360):
    """The solid of revolution about z of a polygon of points (r, z), corners rounded by a radius or one of a list."""
    face = Part.Face(wire(profile, radius))
    face.rotate(vector((0, 0, 0)), vector("x"), 90)
    return face.revolve(vector((0, 0, 0)), vector("z"), angle)


def pipe(points, bend_radius, section_radius):
    """A round bar along a polyline of points (x, y) in the plane z = 0 with rounded bends."""
    path = wire(points, bend_radius, closed=False)
    start = vector((*points[0], 0))
    direction = vector((*points[1], 0)) - start
    circle = Part.Wire(Part.makeCircle(section_radius, start, direction))
    return path.makePipeShell([circle], True, False)


def swept(points, bend_radius, section):
    """A bar of a polygon's section along a polyline of points (x, y) that starts along x from the origin."""
    profile = wire(section)
    profile.rotate(vector((0, 0, 0)), vector("y"), 90)
    return wire(points, bend_radius, closed=False).makePipeShell([profile], True, False)


def spline_prism(points, height, jump=False):
    """A prism over a smooth closed curve through points; `jump`: a straight step leads from the last to the first."""
    curve = Part.BSplineCurve()
    curve.interpolate([vector((x, y, 0)) for x, y in points], PeriodicFlag=not jump)
    edges = [curve.toShape()]
    if jump:
        edges.append(Part.makeLine(vector((*points[-1], 0)), vector((*points[0], 0))))

    return Part.Face(Part.Wire(edges)).extrude(vector((0, 0, height)))


def twisted(points, height, angle, layers=4):
    """A polygon extruded along z while it turns by an angle."""
    sections = []
    for k in range(layers + 1):
        section = wire(points)
        section.rotate(vector((0, 0, 0)), vector("z"), angle * k / layers)
        section.translate(vector((0, 0, height * k / layers)))
        sections.append(section)

    return Part.makeLoft(sections, True, False)


def frustum(sx, sy, top_sx, top_sy, height, z=0, radius=0, top_x=0, top_y=0):
    """A block that narrows from one rectangle to another above it."""
    low = wire(rectangle(sx, sy), radius)
    high = wire(rectangle(top_sx, top_sy, top_x, top_y), radius)
    low.translate(vector((0, 0, z)))
    high.translate(vector((0, 0, z + height)))
    return Part.makeLoft([low, high], True, True)


def moved(solid, x=0, y=0, z=0):
    copy = solid.copy()
    copy.translate(vector((x, y, z)))
    return copy


def turned_by(solid, angle, axis="z", at=(0, 0, 0)):
    copy = solid.copy()
    copy.rotate(vector(at), vector(axis), angle)
    return copy


def mirrored(solid, normal="x", at=(0, 0, 0)):
    return solid.mirror(vector(at), vector(normal))


def fused(solids):
    first, *others = solids
    return first.multiFuse(others) if others else first


# The strokes of a digit: (x, y) of both ends on a cell of width 1 and height 2.
STROKES = {
    "a": ((0, 2), (1, 2)),
    "b": ((1, 1), (1, 2)),
    "c": ((1, 0), (1, 1)),
    "d": ((0, 0), (1, 0)),
    "e": ((0, 0), (0, 1)),
    "f": ((0, 1), (0, 2)),
    "g": ((0, 1), (1, 1))
}
DIGITS = {
    "0": "abcdef",
    "1": "bc",
    "2": "abged",
    "3": "abgcd",
    "4": "fgbc",
    "5": "afgcd",
    "6": "afgedc",
    "7": "abc",
    "8": "abcdefg",
    "9": "abfgcd",
    "A": "efabcg",
    "C": "afed",
    "E": "afged",
    "F": "afge",
    "H": "fegbc",
    "L": "fed",
    "P": "efabg",
    "U": "fedcb"
}


def label(text, height, depth):
    """Block letters of a seven-stroke alphabet, centred on the origin, from z = -depth/2 to depth/2."""
    unit = height / 2
    stroke = 0.22 * height
    bars = []
    for place, letter in enumerate(text):
        left = 1.7 * unit * (place - (len(text) - 1) / 2) - unit / 2
        for name in DIGITS[letter]:
            (x0, y0), (x1, y1) = STROKES[name]
            bars.append(
                block(
                    abs(x1 - x0) * unit + stroke,
                    abs(y1 - y0) * unit + stroke, depth, left + (x0 + x1) / 2 * unit, (y0 + y1) / 2 * unit - unit,
                    -depth / 2))

    return fused(bars)
