"""The triangle mesh of a solid: tessellation, checks, measures, PLY."""
import math

import numpy as np

import cad
from part import Failure

DIAMETER_MM = (25.0, 200.0)
TRIANGLES = (12, 15000)
WELD_MM = 1e-5
THINNEST_MM = 1e-5


def tessellated(solid, deflection_mm, angle_deg):
    """Vertices (n, 3) in millimetres, their bounding box centred on the origin; triangles (m, 3); where that centre lay
    in the solid's coordinates."""
    mesh = cad.MeshPart.meshFromShape(Shape=solid,
                                      LinearDeflection=deflection_mm,
                                      AngularDeflection=math.radians(angle_deg),
                                      Relative=False)
    points, triangles = mesh.Topology
    vertices = np.array([(p.x, p.y, p.z) for p in points])
    # A corner can differ between its faces in the last digits.
    _, first, same = np.unique(np.round(vertices / WELD_MM), axis=0, return_index=True, return_inverse=True)
    vertices = vertices[first]
    triangles = same.reshape(-1)[np.array(triangles)]
    centre = (vertices.min(0) + vertices.max(0)) / 2
    return (vertices - centre).astype(np.float32).astype(float), triangles, centre


def diameter(vertices):
    """The largest distance between two vertices. The far ends are extreme in some direction: only those are paired."""
    grid = np.array([(math.cos(a) * math.sin(b), math.sin(a) * math.sin(b), math.cos(b))
                     for a in np.linspace(0, 2 * math.pi, 60, endpoint=False) for b in np.linspace(0, math.pi, 30)])
    ends = vertices[np.unique(np.argmax(vertices @ grid.T, axis=0))]
    return float(np.sqrt(((ends[:, None] - ends[None])**2).sum(2).max()))


def volume(vertices, triangles):
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def thinnest(vertices, triangles):
    """The least height of a triangle over its longest side."""
    corners = vertices[triangles]
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(1)
    doubled_areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return float((doubled_areas / np.maximum(sides, 1e-12)).min())


def check(vertices, triangles):
    """Throws Failure unless the mesh is closed, consistently oriented outwards, and of a wanted size."""
    if not TRIANGLES[0] <= len(triangles) <= TRIANGLES[1]:
        raise Failure(f"{len(triangles)} triangles")

    if not DIAMETER_MM[0] <= diameter(vertices) <= DIAMETER_MM[1]:
        raise Failure(f"diameter {diameter(vertices):.0f} mm")

    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).astype(np.int64)
    if thinnest(vertices, triangles) < THINNEST_MM:
        raise Failure("a triangle without area")

    forth = np.sort(edges[:, 0] * len(vertices) + edges[:, 1])
    back = np.sort(edges[:, 1] * len(vertices) + edges[:, 0])
    if (forth != back).any() or (np.diff(forth) == 0).any():
        raise Failure("open, or an edge with more than two triangles")

    if volume(vertices, triangles) <= 0:
        raise Failure("inside out")


def write_ply(path, vertices, triangles):
    faces = np.empty(len(triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"] = 3
    faces["corners"] = triangles
    header = ("ply\nformat binary_little_endian 1.0\ncomment millimetres\n"
              f"element vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
              f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    path.write_bytes(header.encode() + vertices.astype("<f4").tobytes() + faces.tobytes())


# Measures


def facing_faces(solid):
    """How many faces of the solid look towards the viewer, in the mean over 14 directions; hiding is not looked at."""
    directions = [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)
                  if abs(x) + abs(y) + abs(z) in (1, 3)]
    views = np.array(directions) / np.linalg.norm(directions, axis=1)[:, None]
    total = 0
    for face in solid.Faces:
        u0, u1, v0, v1 = face.ParameterRange
        normals = [
            face.normalAt(u0 + a * (u1 - u0), v0 + b * (v1 - v0)) for a in (0.02, 0.27, 0.52, 0.77, 0.98)
            for b in (0.1, 0.5, 0.9)
        ]
        total += ((np.array([tuple(n) for n in normals]) @ views.T).max(0) > 0.1).sum()

    return round(total / len(views), 1)


def surface_samples(vertices, triangles, count):
    """Points spread over the surface by area: the same ones for the same mesh."""
    corners = vertices[triangles]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    draws = np.random.default_rng(1).random((count, 3))
    chosen = corners[np.minimum(np.searchsorted(np.cumsum(areas) / areas.sum(), draws[:, 0]), len(areas) - 1)]
    root = np.sqrt(draws[:, 1:2])
    along = draws[:, 2:3]
    return (1 - root) * chosen[:, 0] + root * (1 - along) * chosen[:, 1] + root * along * chosen[:, 2]


def self_distances(vertices, triangles):
    """How far the part is from its half turns about the principal axes (the least of three), and from its mirror image
    turned onto it (the least of four). The 99th percentile of the distance between surfaces over the diameter; about
    0.02 is the samples' own spacing. The axes mean nothing where two moments are equal: None then for the mirror image
    unless it fits."""
    points = surface_samples(vertices, triangles, 6000)
    points -= points.mean(0)
    moments, axes = np.linalg.eigh(points.T @ points / len(points))
    points = points @ axes
    size = diameter(vertices)
    signs = [np.array((x, y, z)) for x in (1, -1) for y in (1, -1) for z in (1, -1)]
    distance = {tuple(s): distance_between(points[:700] * s, points) / size for s in signs}
    turns = [distance[tuple(s)] for s in signs if s.prod() > 0 and tuple(s) != (1, 1, 1)]
    mirror = min(distance[tuple(s)] for s in signs if s.prod() < 0)
    ambiguous = min(np.diff(moments)) < 0.04 * moments.max()
    return round(min(turns), 4), None if ambiguous and mirror > 0.03 else round(mirror, 4)


def distance_between(some, points):
    squares = (some**2).sum(1)[:, None] + (points**2).sum(1)[None] - 2 * some @ points.T
    return float(np.quantile(np.sqrt(np.maximum(squares.min(1), 0)), 0.99))
