"""Pose from a circle's image and one point: error without noise by tilt, both solutions, their order."""
from figures import Figure
from plots import log_plot

TILTS = ("0", "0.01", "0.1", "1", "5", "20", "60", "85")   # ends of the ranges, degrees


def figures(bench):
    measured = bench.speed("circle")
    ranges = list(zip(TILTS, TILTS[1:]))
    results = {low: measured[f"BM_CircleError/{low}/iterations:1"] for low, _ in ranges}
    for low, high in ranges:
        result = results[low]
        yield Figure(f"worst error, tilt {low}-{high}", result["worst"], "relative, rad",
                     "<= 1e-9" if float(low) >= 5 else None,
                     conditions=f"{result['problems']:.0f} circles 5-40 radii away, exact up to the rounding of the "
                                f"ellipse's parameters; median {result['median']:.1e}")
    count = sum(result["problems"] for result in results.values())
    yield Figure("without both solutions", sum(result["missing"] for result in results.values()), "", "<= 0",
                 conditions=f"{count:.0f} circles")
    seen = [results[low] for low, _ in ranges if float(low) >= 5]
    yield Figure("the wrong solution first, tilt >= 5", sum(result["wrong_first"] for result in seen), "", "<= 0",
                 conditions=f"{sum(result['problems'] for result in seen):.0f} circles, a point 1-3 radii off the axis")
    yield Figure("both poses", measured["BM_CirclePointPoses"]["cpu_time"] / 1000, "us")
    middles = {low: (max(float(low), 1e-3) * float(high)) ** 0.5 for low, high in ranges}
    curves = {name: [(middles[low], results[low][key]) for low, _ in ranges]
              for name, key in (("worst of 20000", "worst"), ("median", "median"))}
    bench.plot("circle_pose", log_plot(curves, "Circle and point without noise: rounding of the pose",
                                       "tilt [degrees]", "error"))
