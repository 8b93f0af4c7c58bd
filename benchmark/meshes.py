"""Parts of many triangles, as binary STL in millimetres: what CAD programs and scanners make of simple shapes."""
import math
import random
import struct

SIDE_MM = 6.0    # of a boss of a plate, as high as wide, and of the gap between two


def write_stl(path, triangles):
    """The number of triangles."""
    with open(path, "wb") as file:
        file.write(b"\0" * 80 + struct.pack("<I", len(triangles)))
        for a, b, c in triangles:
            file.write(struct.pack("<12fH", 0, 0, 0, *a, *b, *c, 0))
    return len(triangles)


def objects_file(folder, name, part):
    """objects.yaml in the folder, of one object: a mesh file, or triangles, which become NAME.stl there."""
    path = part
    if isinstance(part, list):
        path = folder / f"{name}.stl"
        write_stl(path, part)
    objects = folder / "objects.yaml"
    objects.write_text(f"objects: [{{name: part, mesh: {path.resolve()}, unit: mm}}]\n", encoding="utf-8")
    return objects


def grid(rows):
    """The triangles between rows of points, each row as long as the others."""
    triangles = []
    for near, far in zip(rows, rows[1:]):
        for a, b, c, d in zip(near, near[1:], far[1:], far):
            triangles += [(a, b, c), (a, c, d)]
    return triangles


def plate(bosses, divisions):
    """A plate with a grid of square bosses, so many along each side, each side of a boss divided so often."""
    cells = 2 * bosses + 1
    triangles = []

    def is_boss(x, y):
        return 0 <= x < cells and 0 <= y < cells and x % 2 == 1 and y % 2 == 1

    def wall(corner, along, up):
        """A cell's side or top; its normal is along x up."""
        step = SIDE_MM / divisions
        triangles.extend(grid([[tuple(corner[a] + step * (i * along[a] + k * up[a]) for a in range(3))
                                for i in range(divisions + 1)] for k in range(divisions + 1)]))

    end = cells * SIDE_MM
    for x in range(cells):
        for y in range(cells):
            left, near, top = x * SIDE_MM, y * SIDE_MM, SIDE_MM * is_boss(x, y)
            wall((left, near, top), (1, 0, 0), (0, 1, 0))
            wall((left, near, -SIDE_MM), (0, 1, 0), (1, 0, 0))
            if is_boss(x, y):
                wall((left, near, 0), (1, 0, 0), (0, 0, 1))
                wall((left + SIDE_MM, near, 0), (0, 1, 0), (0, 0, 1))
                wall((left + SIDE_MM, near + SIDE_MM, 0), (-1, 0, 0), (0, 0, 1))
                wall((left, near + SIDE_MM, 0), (0, -1, 0), (0, 0, 1))
    for i in range(cells):
        at = i * SIDE_MM
        wall((at, 0, -SIDE_MM), (1, 0, 0), (0, 0, 1))
        wall((end, at, -SIDE_MM), (0, 1, 0), (0, 0, 1))
        wall((end - at, end, -SIDE_MM), (-1, 0, 0), (0, 0, 1))
        wall((0, end - at, -SIDE_MM), (0, -1, 0), (0, 0, 1))
    return triangles


def turned(profile, around):
    """A body of revolution about z: `profile` (radius, z) from the axis at the bottom to the axis at the top."""
    angles = [2 * math.pi * i / around for i in range(around)] + [0.0]
    rows = [[(r * math.cos(a), r * math.sin(a), z) for a in angles] for r, z in profile]
    return [t for t in grid(rows) if len(set(t)) == 3]


def rounded(profile, radius, steps=6):
    """A profile whose corners, but for the ends, are arcs of one radius."""
    points = [profile[0]]
    for before, corner, after in zip(profile, profile[1:], profile[2:]):
        ways = []
        for end in (before, after):
            way = (end[0] - corner[0], end[1] - corner[1])
            ways.append([w / math.hypot(*way) for w in way])
        (ax, ay), (bx, by) = ways
        half = math.acos(max(-1.0, min(1.0, ax * bx + ay * by))) / 2
        to_middle = radius / math.sin(half) / math.hypot(ax + bx, ay + by)
        centre = (corner[0] + to_middle * (ax + bx), corner[1] + to_middle * (ay + by))
        first = math.atan2(corner[1] + radius / math.tan(half) * ay - centre[1], corner[0] + radius / math.tan(half) * ax - centre[0])
        turn = math.copysign(math.pi - 2 * half, bx * ay - by * ax)
        points += [(centre[0] + radius * math.cos(first + turn * k / steps), centre[1] + radius * math.sin(first + turn * k / steps))
                   for k in range(steps + 1)]
    return points + [profile[-1]]


def rounded_box(size, radius, steps=6):
    """A box whose edges are all filleted."""
    half = [side / 2 for side in size]

    def ticks(end):
        low = [-end + radius * k / steps for k in range(steps + 1)]
        return low + [-x for x in reversed(low)]

    def rounded(point):
        inner = [min(max(x, radius - end), end - radius) for x, end in zip(point, half)]
        away = [x - y for x, y in zip(point, inner)]
        length = math.hypot(*away)
        return tuple(y + radius * d / length for y, d in zip(inner, away))

    triangles = []
    for axis in range(3):
        across, up = (axis + 1) % 3, (axis + 2) % 3
        for sign in (-1, 1):
            rows = []
            for u in ticks(half[across]):
                row = []
                for v in ticks(half[up]):
                    point = [0.0, 0.0, 0.0]
                    point[axis], point[across], point[up] = sign * half[axis], u, v
                    row.append(rounded(point))
                rows.append(row)
            triangles += [(a, b, c) if sign > 0 else (a, c, b) for a, b, c in grid(rows)]
    return [t for t in triangles if len(set(t)) == 3]


def screw(diameter=8.0, pitch=1.25, length=45.0, head=7.5, around=48):
    """A cheese-head screw whose thread is rings of crest and root."""
    outer, inner = diameter / 2, diameter / 2 - 0.54 * pitch
    profile = [(0.0, 0.0)]
    for k in range(int(length / pitch)):
        profile += [(r, pitch * (k + at)) for r, at in ((inner, 0.0), (outer, 0.4), (outer, 0.6), (inner, 0.96))]
    profile += [(outer, length), (0.9 * diameter, length), (0.9 * diameter, length + head), (0.0, length + head)]
    return turned(profile, around)


def bolt(diameter=12.0, pitch=1.75, length=60.0, head=7.5, across_flats=18.0, around=48):
    """A hexagon bolt whose thread is modelled: a ridge that climbs one pitch a turn."""
    outer, inner = diameter / 2, diameter / 2 - 0.6134 * pitch
    angles = [2 * math.pi * i / around for i in range(around + 1)]
    rows = []
    for k in range(int(4 * length / pitch) + 1):
        z = k * pitch / 4
        row = []
        for i, angle in enumerate(angles):
            phase = (z / pitch - (i % around) / around) % 1.0
            ridge = max(0.0, 1 - abs(4 * phase - 2))  # nothing for half of the pitch
            fade = min(1.0, (length - z) / (2 * pitch), z / pitch)  # the thread runs out at both ends
            radius = inner + (outer - inner) * ridge * max(0.0, fade)
            row.append((radius * math.cos(angles[i % around]), radius * math.sin(angles[i % around]), z))
        rows.append(row)
    tip = [[(0.0, 0.0, 0.0)] * (around + 1)]

    def hexagon(z):
        corner = across_flats / math.sqrt(3)
        row = []
        for i in range(around + 1):
            at = (i % around) * 6 / around
            side, part = int(at), at - int(at)
            a, b = (math.pi / 3 * side, math.pi / 3 * (side + 1))
            row.append((corner * ((1 - part) * math.cos(a) + part * math.cos(b)),
                        corner * ((1 - part) * math.sin(a) + part * math.sin(b)), z))
        return row

    top = [[(0.0, 0.0, length + head)] * (around + 1)]
    triangles = grid(tip + rows + [hexagon(rows[-1][0][2]), hexagon(length + head)] + top)
    return [t for t in triangles if len(set(t)) == 3]


def scan(noise_mm=0.15, around=128, rows=64, seed=1):
    """A bottle as a scanner sees it: a smooth body with a rough surface."""
    draw = random.Random(seed)
    profile = [(0.0, 0.0)]
    for k in range(rows):
        z = 150.0 * k / (rows - 1)
        radius = 32 if z < 90 else 32 - 20 * (1 - math.cos(math.pi * min(1, (z - 90) / 40))) / 2
        profile.append((radius, z))
    profile.append((0.0, 150.0))
    moved = {}

    def rough(point):
        if point not in moved:
            moved[point] = tuple(x + draw.gauss(0, noise_mm) for x in point)
        return moved[point]

    return [tuple(rough(p) for p in triangle) for triangle in turned(profile, around)]
