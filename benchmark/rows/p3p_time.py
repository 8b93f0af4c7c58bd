"""Poses from three points: time of one solve, all solutions, beside OpenCV's AP3P."""
from figures import Figure
from plots import LogAxis, bar_plot

PEER = "OpenCV AP3P"


def figures(bench):
    timed = bench.speed("p3p", "--benchmark_filter=BM_(P3P|Ap3p)/", "--benchmark_repetitions=9",
                        "--benchmark_min_time=0.1", "--benchmark_enable_random_interleaving=true")
    times = {}
    for name, target in (("general", "<= 0.02"), ("far30", None), ("symmetric", None)):
        ours, peer = (timed[f"{who}/{name}"]["cpu_time"] for who in ("BM_P3P", "BM_Ap3p"))
        times[name] = {"ours": ours, PEER: peer}
        how = "4000 problems, CPU time, medians of 9 interleaved runs"
        yield Figure(f"share of AP3P's time, {name}", ours / peer, "", target, PEER, conditions=how)
        yield Figure(f"one solve, {name}", ours, "ns", None, PEER, peer,
                     f"{how}; the peer's call with its conversions of rotations, as a caller pays it")
    bench.plot("p3p_time", bar_plot(times, "Poses from three points, all solutions", "time of one solve [ns]", LogAxis))
