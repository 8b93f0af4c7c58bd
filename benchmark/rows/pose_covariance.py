"""Does the covariance of a pose hold its error, and is it no wider than it has to be?"""
import csv
import statistics
import subprocess

from figures import CannotMeasure, Figure
from plots import linear_plot

POSES = 1000                            # rendered per part
LEVELS = {50: 5.0, 90: 4.0, 99: 1.5}    # per cent of the errors, and by how much they may differ
# Squared Mahalanobis distances of the 50, 90 and 99 % ellipsoids: chi-square of so many degrees of freedom.
LIMITS = {3: (2.366, 6.251, 11.345), 5: (4.351, 9.236, 15.086), 6: (5.348, 10.645, 16.812)}
HALF = 0.6745                           # a normal variable lies within so many sigmas half of the time


def figures(bench):
    program, path = bench.out / "pose_covariance", bench.out / "pose_covariance.csv"
    if not program.exists():
        raise CannotMeasure(f"{program} is not built")
    if subprocess.run([program, bench.root / "config" / "objects.yaml", str(POSES), path], check=False).returncode:
        raise CannotMeasure(f"{program} failed")
    parts = {}
    with open(path, encoding="utf-8") as file:
        for line in csv.DictReader(file):
            parts.setdefault(line["part"], []).append(line)
    curves = {"honest": [(level, level) for level in LEVELS]}
    for part, lines in parts.items():
        curves[part] = list(zip(LEVELS, within(lines)))
    bench.plot("pose_covariance", linear_plot(curves, "Pose errors within the reported ellipsoids",
                                              "ellipsoid [%]", "errors inside [%]"))
    yield from of_part("all parts", [line for lines in parts.values() for line in lines], POSES * len(parts), True)
    for part, lines in parts.items():
        yield from of_part(part, lines, POSES, False)


def within(lines):
    """Per cent of the errors within the ellipsoid of each level."""
    return [100 * sum(float(line["square"]) <= LIMITS[int(line["freedoms"])][k] for line in lines) / len(lines)
            for k in range(len(LEVELS))]


def numbers(text):
    return [float(x) for x in text.split()]


def of_part(name, lines, rendered, targets):
    how = f"{len(lines)} found of {rendered} rendered (one part, plain table, random light and view)"
    for (level, slack), share in zip(LEVELS.items(), within(lines)):
        yield Figure(f"{name}: errors within the {level} % ellipsoid", share, "%", conditions=how)
        yield Figure(f"{name}: departure from {level} %", abs(share - level), "points",
                     f"<= {slack:g}" if targets else None, conditions=how)
    errors = [numbers(line["errors"]) for line in lines]
    sigmas = [numbers(line["sigmas"]) for line in lines]
    ratios = [HALF / statistics.median(abs(e[k]) / s[k] for e, s in zip(errors, sigmas)) for k in range(3)]
    turns = [HALF / statistics.median(abs(x) / y for e, s in zip(errors, sigmas) for x, y in zip(e[3:], s[3:]))]
    yield Figure(f"{name}: reported over actual sigma, widest of x, y, z and the turns", max(ratios + turns), "",
                 "<= 1.3" if targets else None, conditions=f"{how}; medians; narrowest {min(ratios + turns):.2f}")
    yield Figure(f"{name}: error of the centre, median",
                 1e3 * statistics.median(sum(x * x for x in e[:3]) ** 0.5 for e in errors), "mm", conditions=how)
    yield Figure(f"{name}: error of the turns, median",
                 57.29578 * statistics.median(sum(x * x for x in e[3:]) ** 0.5 for e in errors), "deg", conditions=how)
