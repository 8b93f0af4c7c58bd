"""Time from a camera image to segments and ellipses beside EdgeDrawing's lines + ellipses, and its growth."""
from figures import CannotMeasure, Figure
from plots import log_plot

STAGES = ("edge_points", "linking", "arcs", "ellipses", "segments", "joining")
SETS, SIZES = ("workcell", "cabinet", "cube"), ("640 x 480", "1280 x 720", "1920 x 1080")


def figures(bench):
    bench.data("real")
    measured = bench.speed("features", "--benchmark_filter=BM_FrontEnd")
    how = "{images:.0f} images, one core, CPU time, median of 5 turns per image; median over the images"
    growth = {}
    for i, name in enumerate(SETS):
        per_pixel = []
        for k, size in enumerate(SIZES):
            run = measured.get(f"BM_FrontEnd/{i}/{k}/iterations:1")
            if not run:
                raise CannotMeasure(f"the data lack the set {name}")
            label, conditions = f"{name} {size}", how.format(**run)
            yield Figure(f"share of the peer's time, {label}", run["ratio"], "", "<= 1", "EdgeDrawing", 1, conditions)
            yield Figure(f"front end, {label}", run["ours_ms"], "ms", None, "EdgeDrawing", run["peer_ms"], conditions)
            yield Figure(f"beside LSD's lines, {label}", run["ours_ms"], "ms", None, "LSD", run["lsd_ms"], conditions)
            yield Figure(f"slowest over median image, {label}", run["ours_worst_ms"] / run["ours_ms"], "", "<= 5",
                         "EdgeDrawing", run["peer_worst_ms"] / run["peer_ms"], conditions)
            per_pixel.append(1e6 * run["ours_ms"] / run["pixels"])
            for detector, key in (("ours", "ours_ms"), ("EdgeDrawing", "peer_ms")):
                growth.setdefault(f"{detector}, {name}", []).append((run["pixels"], run[key]))
            for stage in STAGES:
                yield Figure(f"{stage.replace('_', ' ')}, {label}", run[f"{stage}_ms"], "ms", conditions=conditions)
        yield Figure(f"time per pixel, largest size over smallest, {name}", per_pixel[-1] / per_pixel[0], "", "<= 1.1",
                     conditions="images enlarged by cubic interpolation")
    bench.plot("front_end", log_plot(growth, "Lines and ellipses of an image", "pixels", "median time [ms]"))
