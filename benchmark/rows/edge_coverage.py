"""Share of the visible model edges with contrast that segments and ellipses cover, beside EdgeDrawing and LSD."""
from figures import CannotMeasure, Figure
from plots import bar_plot

SETS = ("workcell", "cabinet", "cube")
PEERS = ("EdgeDrawing", "LSD")


def figures(bench):
    bench.data("real")
    measured = bench.speed("features", "--benchmark_filter=BM_EdgeCoverage")
    covered = {}
    for i, name in enumerate(SETS):
        run = measured.get(f"BM_EdgeCoverage/{i}/iterations:1")
        if not run:
            raise CannotMeasure(f"the data lack the set {name}")
        how = f"{run['samples']:.0f} samples of the true contour; within 1.5 px and 10 degrees"
        covered[name] = {"ours": run["ours_covered"], **{peer: run[f"{peer}_covered"] for peer in PEERS}}
        for peer in PEERS:
            yield Figure(f"covered, {name}, beside {peer}", run["ours_covered"], "",
                         f">= {run[peer + '_covered']:.4f}", peer, run[peer + "_covered"], how)
            yield Figure(f"covered by as few features, {name}, beside {peer}", run["ours_as_few_as_" + peer], "",
                         f">= {run[peer + '_covered']:.4f}", peer, run[peer + "_covered"],
                         f"{how}; of ours the ellipses and longest segments, in every image as many as the peer finds")
            yield Figure(f"segments + ellipses, {name}, beside {peer}", run["ours_features"], "", None, peer, run[peer + "_features"], "median per image")
    bench.plot("edge_coverage", bar_plot(covered, "Visible model edges covered by segments and ellipses", "share"))
