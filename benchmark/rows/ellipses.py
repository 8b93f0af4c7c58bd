"""Ellipses, whole and hidden in part: F1, precision, recall, centre error and time beside EdgeDrawing."""
from figures import Figure
from plots import linear_plot


def figures(bench):
    measured = bench.speed("features", "--benchmark_filter=BM_Ellipse(Accuracy|Time)")
    ours, peer = (measured[f"BM_EllipseAccuracy/{d}/iterations:1"] for d in (0, 1))
    how = f"300 images 640x480, {ours['ellipses']:.0f} ellipses, noise 2 and 8; a match overlaps by 0.8"
    targets = {"f1": ">= 0.92", "precision": ">= 0.97", "recall_40": ">= 0.7", "recall_50": ">= 0.5",
               "centre": "<= 0.1"}
    keys = ["f1", "precision", "recall", *(f"recall_{k}" for k in range(0, 60, 10)),
            *(f"precision_{k}" for k in range(0, 60, 10)), "centre", "centre_p90", "axes"]
    for key in keys:
        name = key.replace("_", " at % hidden: ") if key[-1] == "0" and "p90" not in key else key.replace("_", " ")
        unit = "px" if key.startswith(("centre", "axes")) else ""
        yield Figure(name, ours[key], unit, targets.get(key), "EdgeDrawing", peer[key], how)
    time = measured["BM_EllipseTime/iterations:1"]
    how = "CPU time per image, in turns; ours finds the lines as well"
    yield Figure("share of the peer's time, lines + ellipses", time["ours_ms"] / time["peer_both_ms"], "", "<= 1",
                 "EdgeDrawing", 1, how)
    yield Figure("time, peer's ellipses alone", time["ours_ms"], "ms", None, "EdgeDrawing", time["peer_ms"], how)
    curves = {f"{of}, {name}": [(k, run[f"{of}_{k}"]) for k in range(0, 60, 10)]
              for of in ("recall", "precision") for name, run in (("ours", ours), ("EdgeDrawing", peer))}
    bench.plot("ellipses", linear_plot(curves, "Ellipses hidden in part", "hidden share of the ellipse [%]", "share"))
