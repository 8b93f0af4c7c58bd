"""Closed-form inverse of the PUMA: time of all postures against KDL's LMA, and the worst residual."""
from figures import Figure


def figures(bench):
    # Interleaved, so that whatever else the machine does falls on both alike.
    timed = bench.speed("arm", "--benchmark_filter=Inverse|Kdl", "--benchmark_repetitions=7",
                        "--benchmark_min_time=0.2", "--benchmark_enable_random_interleaving=true")
    ours, kdl = timed["BM_PumaInverse"], timed["BM_KdlLma"]
    how = "random poses inside the limits, CPU time, medians of 7 interleaved runs"
    yield Figure("share of KDL's time", ours["cpu_time"] / kdl["cpu_time"], "", "<= 0.0125", "KDL ChainIkSolverPos_LMA",
                 conditions=f"{how}; KDL finds one posture and no limits: eps 1e-8, seed mid-range, "
                            f"converged {kdl['converged']:.3f}")
    yield Figure("all postures and turns", ours["cpu_time"] / 1000, "us", None, "KDL ChainIkSolverPos_LMA",
                 kdl["cpu_time"] / 1000, f"{how}; {ours['solutions']:.2f} solutions on average")
    exact = bench.speed("arm", "--benchmark_filter=Residual")["BM_PumaResidual/iterations:1"]
    how = f"{exact['poses']:.0f} poses, half of them near or on the singularities"
    yield Figure("worst residual, position", exact["metres"], "m", "<= 1e-12", conditions=how)
    yield Figure("worst residual, rotation", exact["radians"], "rad", "<= 1e-12", conditions=how)
    yield Figure("poses without a solution", exact["missed"], "", "<= 0", conditions=how)
