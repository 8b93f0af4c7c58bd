"""Do the reported uncertainties of lines and ellipses hold the errors that they should, and no wider?"""
from figures import Figure
from plots import linear_plot

LEVELS = {50: 5.0, 90: 4.0, 99: 1.5}  # per cent of the errors, and by how much they may differ


def figures(bench):
    measured = bench.speed("features", "--benchmark_filter=Covariance")
    curves = {"honest": [(level, level) for level in LEVELS]}
    for what in ("Line", "Ellipse"):
        run = measured[f"BM_{what}Covariance/iterations:1"]
        how = f"{run['draws']:.0f} rendered draws, contrast 25 up, noise 1 to 8, blur 0.5 to 1.2 px; {run['missed']:.0f} not found"
        curves[f"{what.lower()}s"] = [(level, run[f"within_{level}"]) for level in LEVELS]
        for level, slack in LEVELS.items():
            within = run[f"within_{level}"]
            yield Figure(f"{what.lower()}s: errors within the {level} % ellipsoid", within, "%", conditions=how)
            yield Figure(f"{what.lower()}s: departure from {level} %", abs(within - level), "points", f"<= {slack:g}",
                         conditions=how)
        yield Figure(f"{what.lower()}s: reported over actual sigma, widest parameter", run["sharpness"], "", "<= 1.3",
                     conditions=f"{how}; medians; narrowest parameter {run['sharpness_least']:.2f}")
    bench.plot("feature_covariance", linear_plot(curves, "Errors within the reported ellipsoids",
                                                 "ellipsoid [%]", "errors inside [%]"))
