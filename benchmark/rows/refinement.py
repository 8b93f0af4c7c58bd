"""Refinement of a pose on 4, 8 and 20 points: time and optimum beside Ceres with analytic Jacobians."""
from figures import Figure
from plots import bar_plot

PEER = "Ceres, analytic, DENSE_NORMAL_CHOLESKY"
# Four points may have several minima: where each of the two ends there is told, but no target.
TARGETS = {4: None, 8: "<= 0.7", 20: "<= 0.9"}


def figures(bench):
    timed = bench.speed("refine", "--benchmark_filter=BM_(Refine|Ceres)", "--benchmark_repetitions=9",
                        "--benchmark_min_time=0.1", "--benchmark_enable_random_interleaving=true")
    ends = bench.speed("refine", "--benchmark_filter=BM_Optimum")
    times = {}
    for points, target in TARGETS.items():
        ours, peer = (timed[f"{who}/{points}"]["cpu_time"] / 1000 for who in ("BM_Refine", "BM_Ceres"))
        times[f"{points} points"] = {"ours": ours, "Ceres": peer}
        end = ends[f"BM_Optimum/{points}/iterations:1"]
        how = f"400 problems, 3 degrees and 3 % off, 0.5 px; {end['iterations']:.1f} iterations on average"
        yield Figure(f"share of Ceres' time, {points} points", ours / peer, "", target, PEER,
                     conditions=f"{how}; CPU time, medians of 9 interleaved runs")
        yield Figure(f"refinement, {points} points", ours, "us", None, PEER, peer, f"{how}; covariance included")
        yield Figure(f"rms above the peer's, {points} points", end["excess"], "px", target and "<= 1e-6", PEER,
                     end["peer_excess"], f"largest of 400; the peer's: its largest above ours; "
                                         f"median rms {end['median_rms']:.6f} px")
        yield Figure(f"not converged, {points} points", end["unconverged"], "", target and "<= 0", conditions=how)
    bench.plot("refinement", bar_plot(times, "Refinement of a pose", "time [us]"))
