"""Line segments on polygons with known edges: offset, corner, recall and precision beside EdgeDrawing and LSD."""
from figures import Figure
from plots import bar_plot

TARGETS = {2: ("<= 0.035", "<= 0.09"), 8: ("<= 0.05", "<= 0.12")}
PEERS = {1: "EdgeDrawing", 2: "LSD"}


def figures(bench):
    measured = bench.speed("features", "--benchmark_filter=BM_SegmentAccuracy")
    corners = {}
    for noise, (offset, corner) in TARGETS.items():
        for exact in (0, 1):
            runs = [measured[f"BM_SegmentAccuracy/{d}/{noise}/{exact}/iterations:1"] for d in range(3)]
            ours = runs[0]
            label = f"noise {noise}" + (", filled by area" if exact else "")
            corners[label] = {name: run["corner"] for name, run in zip(("ours", *PEERS.values()), runs)}
            how = (f"60 images 640x480, {ours['edges']:.0f} edges of 25 px or more; "
                   f"median offset outwards {ours['outwards']:+.3f} px")
            targets = {"offset": offset, "corner": corner, "recall": ">= 0.999", "precision": ">= 0.998"}
            for d, peer in PEERS.items():
                for key, unit in (("offset", "px"), ("corner", "px"), ("recall", ""), ("precision", ""),
                                  ("angle_deg", "deg"), ("fragments", "")):
                    # One line per peer; the target stands at the first.
                    target = targets.get(key) if d == 1 and not exact else None
                    yield Figure(f"{key.removesuffix('_deg')}, {label}" + ("" if d == 1 else f", beside {peer}"), ours[key],
                                 unit, target, peer, runs[d][key], how)
    bench.plot("segments", bar_plot(corners, "Corners of polygons from line segments", "median error [px]"))
