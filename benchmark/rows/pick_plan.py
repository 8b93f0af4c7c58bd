"""Plan of a whole pick in random scenes, and free paths beside OMPL and FCL used directly."""
from figures import Figure


def figures(bench):
    measured = bench.speed("planning")
    picks = measured["BM_PickPlan/iterations:1"]
    how = f"{picks['plans']:.0f} picks: frame, two bridges and a grenade at random, six motions each, timed"
    yield Figure("pick plan, median", picks["median_ms"], "ms", "<= 50", conditions=how)
    yield Figure("pick plan, p99", picks["p99_ms"], "ms", "<= 500", conditions=how)
    yield Figure("picks planned", 100 * picks["planned"] / picks["plans"], "%", ">= 99", conditions=how)
    yield Figure("motions with a penetration", picks["penetrations"], "", "<= 0",
                 conditions=f"{how}; re-checked at ten times the resolution")
    yield Figure("motion time, median", picks["motion_s"], "s", conditions=how)
    paths = measured["BM_PathsSideBySide/iterations:1"]
    how = f"{paths['runs']:.0f} paths in turns, CPU time, the same 17 boxes, into a bin between posts"
    peer = "OMPL RRTConnect on FCL"
    yield Figure("share of the peer's time", paths["ours_ms"] / paths["peer_ms"], "", "<= 2", peer,
                 conditions=f"{how}; both planned and shortened, medians")
    yield Figure("the same, the peer not shortening", paths["ours_ms"] / paths["peer_plan_ms"], "", "<= 2", peer,
                 conditions=f"{how}; ours planned and shortened, the peer's only planned, medians")
    yield Figure("free path, median", paths["ours_ms"], "ms", None, peer, paths["peer_ms"], how)
    yield Figure("its length, median", paths["ours_length"], "rad", None, peer,
                 paths["peer_length"], how)
    yield Figure("test of one posture, same boxes", measured["BM_ValidBoxes"]["cpu_time"] / 1000, "us", None,
                 "fcl::collide behind AABBs", measured["BM_PeerValid"]["cpu_time"] / 1000)
    yield Figure("test of one posture, demo scene", measured["BM_ValidDemo"]["cpu_time"] / 1000, "us")
