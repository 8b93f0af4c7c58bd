"""Expected calibration error of the probabilities over all judged candidates, ten bins of equal mass.

Nearly all judged candidates are far from right and told so: the figure over those that are not hopeless is the harder one."""
import csv

from figures import Figure, is_right

RENDERED = (("workcell", "dev"), ("industrial", "dev"))
REAL = (("real/cabinet", "test"), ("real/cube", "test"), ("real_parts/steel_block", "test"),
        ("real_parts/steel_keys", "test"), ("real_parts/teabox", "test"))
BINS = 10
HOPELESS = 0.01


def candidates(bench, sets):
    """(probability, right) of every judged candidate."""
    pairs = []
    for dataset, split in sets:
        with open(bench.dump(dataset, split), newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                pairs.append((float(row["probability"]), is_right(row)))
    return sorted(pairs)


def calibration_error(pairs):
    error = 0
    for k in range(BINS):
        part = pairs[len(pairs) * k // BINS:len(pairs) * (k + 1) // BINS]
        error += abs(sum(p for p, _ in part) - sum(right for _, right in part))
    return error / len(pairs)


def figures(bench):
    for name, sets, target in (("rendered, parts not in the fit", RENDERED, "<= 0.04"),
                               ("camera images", REAL, "<= 0.08")):
        pairs = candidates(bench, sets)
        yield Figure(f"calibration error, {name}", calibration_error(pairs), "0..1", target,
                     conditions=f"{len(pairs)} candidates, {sum(right for _, right in pairs)} right")
        hopeful = [pair for pair in pairs if pair[0] >= HOPELESS]
        if not hopeful:
            continue
        mean = sum(p for p, _ in hopeful) / len(hopeful)
        yield Figure(f"the same, of probability {HOPELESS} and more", calibration_error(hopeful), "0..1",
                     conditions=f"{len(hopeful)} candidates, {sum(right for _, right in hopeful)} right, {mean:.3f} expected")
