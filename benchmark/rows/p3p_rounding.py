"""Rounding: pose error against distance for the paper's quartic, the same polished, and the package's solver."""
import csv
import subprocess

from figures import CannotMeasure, Figure
from plots import log_plot

SHOWN = ("30", "300")   # distances in longest sides of the triangle


def figures(bench):
    program, path = bench.out / "p3p_rounding", bench.out / "p3p_rounding.csv"
    if not program.exists():
        raise CannotMeasure(f"{program} is not built")
    if subprocess.run([program, path], check=False).returncode:
        raise CannotMeasure(f"{program} failed")
    with open(path, encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    curves = {}
    for line in lines:
        curves.setdefault(line["solver"], []).append((float(line["distance"]), float(line["median"])))
    bench.plot("p3p_rounding", log_plot(curves, "Three exact points: rounding of the pose",
                                        "distance / longest side", "median error (1: none found)"))
    for distance in SHOWN:
        at = {line["solver"]: line for line in lines if line["distance"] == distance}
        ours = at.pop("solveP3P")
        for name, seed in at.items():
            how = f"4000 exact problems, {distance} sides away; CSV and plot: p3p_rounding.csv, .svg"
            yield Figure(f"median error at {distance}, beside {name}", float(ours["median"]), "", None, name,
                         float(seed["median"]), how)
            yield Figure(f"error > 1e-3 at {distance}, beside {name}", float(ours["lost"]), "share", "<= 0", name,
                         float(seed["lost"]), how)
