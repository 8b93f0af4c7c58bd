"""Poses from three points: error, completeness and soundness on sets of problems, beside OpenCV's AP3P."""
from figures import Figure
from plots import LogAxis, bar_plot

PEER = "OpenCV AP3P"
# set: (counter, what the counter's share is called, target)
EXACT = ("over1e6", "error > 1e-6", "<= 0")
SETS = {
    "general": [EXACT], "far10": [EXACT], "far30": [EXACT], "far100": [EXACT], "far300": [EXACT],
    "box_corner": [EXACT],
    "symmetric": [("over1e1", "error > 0.1 (lost)", "<= 0"), EXACT],
    "symmetric+1e-9": [("over1e1", "error > 0.1 (lost)", None)],
    "symmetric+1e-6": [("over1e1", "error > 0.1 (lost)", None)],
    "collinear1e-2": [EXACT],
    "collinear1e-4": [("over1e6", "error > 1e-6", "<= 1e-4"), ("over1e3", "error > 1e-3", "<= 0")],
    "danger1e-2": [EXACT], "danger1e-4": [("over1e6", "error > 1e-6", None)],
    "danger1e-6": [("over1e6", "error > 1e-6", None)],
}


def figures(bench):
    measured = bench.speed("p3p", "--benchmark_filter=Accuracy")
    scores = {name.split("/")[1]: result for name, result in measured.items()}
    for name, wanted in SETS.items():
        score = scores[name]
        how = f"{score['problems']:.0f} problems; best pose of each"
        for counter, text, target in wanted:
            yield Figure(f"{name}: {text}", score[f"ours_{counter}"] / score["problems"], "share", target, PEER,
                         score[f"peer_{counter}"] / score["problems"], how)
    for name in ("general", "far300"):
        yield Figure(f"{name}: median error", scores[name]["ours_median"], "", None, PEER, scores[name]["peer_median"])
        yield Figure(f"{name}: error, 99.9 %", scores[name]["ours_p999"], "", None, PEER, scores[name]["peer_p999"])
    yield from over_all_sets(scores)
    shares = {name: {who: score[f"{key}_over1e6"] / score["problems"] for who, key in (("ours", "ours"), (PEER, "peer"))}
              for name, score in scores.items() if name in SETS and not name.startswith("symmetric")}
    bench.plot("p3p_accuracy", bar_plot(shares, "Poses from three points: error above 1e-6",
                                        "share of the problems", LogAxis))


def over_all_sets(scores):
    """Completeness and soundness, noisy sets included."""
    total = sum(score["problems"] for score in scores.values())
    how = f"{total:.0f} problems of all sets"
    for counter, text in (("duplicate", "problems with a pose twice"),
                          ("bogus", "problems with a pose that is none")):
        ours, peer = (sum(score[f"{who}_{counter}"] for score in scores.values()) for who in ("ours", "peer"))
        yield Figure(text, ours, "", "<= 0", PEER, peer, how)
    for counter, target in (("fewer", "<= 0"), ("more", None)):
        ours, peer = (sum(score[f"{who}_{counter}"] for score in scores.values()) for who in ("ours", "peer"))
        yield Figure(f"problems with {counter} poses than the reference", ours, "", target, PEER, peer,
                     "the first 20000 of each set; the reference: Grunert's quartic in 113 bits, problems with "
                     "roots within 1e-6 left out")
