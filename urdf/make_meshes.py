#!/usr/bin/python3
"""Writes meshes/*.stl, the visual shapes of puma560.urdf: each link in its own frame, metres.

Every link is a few convex prisms with bevelled rims. The collision boxes and cylinders in the URDF have the same
dimensions; test/arm checks that they enclose these meshes closely."""
import pathlib
import struct

import numpy as np

A2, A3, D3, D4, D6 = 0.4318, 0.0203, 0.15005, 0.4318, 0.05625  # Puma560Options
BEVEL = 0.003
AXES = {"x": ([0, 1, 0], [0, 0, 1], [1, 0, 0]), "y": ([0, 0, 1], [1, 0, 0], [0, 1, 0]),
        "z": ([1, 0, 0], [0, 1, 0], [0, 0, 1])}  # profile's x and y, direction of the prism


def convex_hull(points):
    """Counter-clockwise hull (monotone chain)."""
    points = sorted(map(tuple, points))

    def chain(ordered):
        hull = []
        for p in ordered:
            while len(hull) > 1 and np.cross(np.subtract(hull[-1], hull[-2]), np.subtract(p, hull[-2])) <= 1e-12:
                hull.pop()
            hull.append(p)
        return hull[:-1]

    return np.array(chain(points) + chain(points[::-1]))


def circles(*centre_radius, sides=32):
    """Profile: convex hull of circles (x, y, radius), as polygons inside them."""
    angles = 2 * np.pi * np.arange(sides) / sides
    return convex_hull([(x + r * np.cos(a), y + r * np.sin(a)) for x, y, r in centre_radius for a in angles])


def rectangle(x0, x1, y0, y1):
    return np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], float)


def inset(profile, amount):
    """The convex profile with every side moved inwards."""
    before, after = np.roll(profile, 1, axis=0), np.roll(profile, -1, axis=0)

    def inwards(side):
        side = side / np.linalg.norm(side, axis=1, keepdims=True)
        return np.stack([-side[:, 1], side[:, 0]], axis=1)

    n1, n2 = inwards(profile - before), inwards(after - profile)
    return profile + amount * (n1 + n2) / (1 + np.sum(n1 * n2, axis=1, keepdims=True))


def prism(profile, low, high, axis="z", bevel=BEVEL):
    """Triangles (n, 3, 3) of the profile pushed from low to high along the axis, both rims bevelled."""
    small = inset(profile, bevel)
    rings = [(small, low), (profile, low + bevel), (profile, high - bevel), (small, high)]
    frame = np.array(AXES[axis], float)
    rings = [np.column_stack([ring, np.full(len(ring), height)]) @ frame for ring, height in rings]
    triangles = []
    for lower, upper in zip(rings, rings[1:]):
        for i in range(len(profile)):
            j = (i + 1) % len(profile)
            triangles += [(lower[i], lower[j], upper[j]), (lower[i], upper[j], upper[i])]
    for i in range(1, len(profile) - 1):
        triangles += [(rings[0][0], rings[0][i + 1], rings[0][i]), (rings[3][0], rings[3][i], rings[3][i + 1])]
    return np.array(triangles)


def drum(radius, low, high, axis="z", x=0, y=0, sides=32):
    return prism(circles((x, y, radius), sides=sides), low, high, axis)


def links():
    """{file: list of solids}"""
    fork = convex_hull([*circles((D4, 0, 0.040)), (0.386, 0.040), (0.386, -0.040)])  # in z, x
    return {
        "base_link": [drum(0.17, 0, 0.02), drum(0.09, 0.017, 0.503), drum(0.11, 0.50, 0.537),
                      prism(rectangle(-0.15, -0.05, -0.07, 0.07), 0.017, 0.16)],
        "link1": [drum(0.09, -0.133, 0), drum(0.10, -0.193, 0.11, "y"), drum(0.075, 0.107, 0.135, "y")],
        "link2": [prism(circles((-0.12, 0, 0.075), (0, 0, 0.105), (A2, 0, 0.062)), 0.195, 0.277)],
        "link3": [prism(circles((0, -0.03, 0.064), (A3, 0.30, 0.045)), 0.107, 0.192),
                  prism(circles((D3, A3, 0.0415)), 0.28, 0.352, "y")],
        "link4": [drum(0.0405, 0.354, 0.389), prism(fork, 0.033, 0.043, "y", 0.002),
                  prism(fork, -0.043, -0.033, "y", 0.002)],
        "link5": [drum(0.034, -0.029, 0.029, sides=28), drum(0.026, 0, 0.040, "y", sides=28)],
        "link6": [drum(0.0315, 0.042, D6, sides=28)],
        "gripper_base": [drum(0.035, 0, 0.012, sides=28), prism(rectangle(-0.03, 0.03, -0.045, 0.045), 0.010, 0.085),
                         prism(rectangle(-0.017, 0.017, -0.062, 0.062), 0.083, 0.105),
                         prism(rectangle(-0.068, -0.027, -0.010, 0.010), 0.030, 0.050)],
        "camera_link": [prism(rectangle(-0.0145, 0.0145, -0.0145, 0.0145), -0.045, -0.012, "x", 0.002),
                        drum(0.0135, -0.014, -0.002, "x", sides=28)],
    }


def write_stl(path, solids):
    triangles = np.concatenate(solids).astype("<f4")
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    with open(path, "wb") as file:
        file.write(b"monocular_eye_hand, metres".ljust(80, b" ") + struct.pack("<I", len(triangles)))
        for normal, corners in zip(normals, triangles):
            file.write(struct.pack("<12fH", *normal, *corners.ravel(), 0))


def main():
    folder = pathlib.Path(__file__).resolve().parent / "meshes"
    folder.mkdir(exist_ok=True)
    for name, solids in links().items():
        write_stl(folder / f"{name}.stl", solids)


if __name__ == "__main__":
    main()
