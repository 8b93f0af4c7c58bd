#include "monocular_eye_hand/evaluation/breakdown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

// Sums of one group.
struct Tally {
  GroupScore score;
  double recall = 0;
  std::vector<double> times;

  void add(const TruthOutcome& truth) {
    if (truth.wanted()) {
      ++score.found.whole;
      score.found.part += truth.found();
    }
    if (truth.counted()) {
      ++score.counted;
      recall += truth.recall();
    }
  }

  void add(const RowOutcome& row) {
    ++score.right.whole;
    score.right.part += row.right();
  }

  void addImage(const std::pair<int, int>& key, const ImageTimes& known) {
    ++score.images;
    const auto time = known.find(key);
    if (time != known.end()) times.push_back(time->second);
  }

  GroupScore finish(const std::string& name) {
    score.name = name;
    score.ar = score.counted > 0 ? recall / score.counted : std::nan("");
    score.median_time = median(times);
    return score;
  }
};

// The bin whose edges [edges[k], edges[k + 1]) hold the value, or -1.
int binOf(double value, const std::vector<double>& edges) {
  const auto above = std::upper_bound(edges.begin(), edges.end(), value);
  if (above == edges.begin() || above == edges.end()) return -1;
  return int(above - edges.begin()) - 1;
}

std::string rangeLabel(double low, double high) { return fmt::format("{:.4g}\u2013{:.4g}", low, high); }

std::vector<RecallBin> emptyBins(const std::vector<double>& edges) {
  std::vector<RecallBin> bins;
  for (size_t k = 0; k + 1 < edges.size(); ++k) bins.push_back({rangeLabel(edges[k], edges[k + 1]), {}});
  return bins;
}

void count(const TruthOutcome& truth, int bin, std::vector<RecallBin>* bins) {
  if (bin < 0) return;
  Share& found = (*bins)[size_t(bin)].found;
  ++found.whole;
  found.part += truth.found();
}

// Without the empty bins at both ends.
std::vector<RecallBin> trimmed(const std::vector<RecallBin>& bins) {
  const auto filled = [](const RecallBin& bin) { return bin.found.whole > 0; };
  const auto first = std::find_if(bins.begin(), bins.end(), filled);
  const auto last = std::find_if(bins.rbegin(), bins.rend(), filled).base();
  return first < last ? std::vector<RecallBin>(first, last) : std::vector<RecallBin>();
}

// 1, 2 or 5 times a power of ten.
double roundStep(double at_least) {
  const double power = std::pow(10.0, std::floor(std::log10(at_least)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * power >= at_least * (1 - 1e-9)) return step * power;
  return 10 * power;
}

}  // namespace

std::vector<GroupScore> scoresByScene(const BopSplit& split, const RunOutcomes& run,
                                      const ImageTimes& times) {
  std::map<int, Tally> tallies;
  for (const BopImage& image : split.images) tallies[image.scene].addImage({image.scene, image.id}, times);
  for (const TruthOutcome& truth : run.truths) tallies[truth.scene].add(truth);
  for (const RowOutcome& row : run.rows) tallies[row.scene].add(row);

  std::vector<GroupScore> scores;
  for (auto& [scene, tally] : tallies) scores.push_back(tally.finish(fmt::format("scene {}", scene)));
  return scores;
}

std::vector<GroupScore> scoresByPart(const BopSplit& split, const BopModels& models, const RunOutcomes& run,
                                     const ImageTimes& times) {
  std::map<int, Tally> tallies;
  for (const auto& model : models) tallies[model.first];
  for (const BopImage& image : split.images) {
    std::set<int> shown;
    for (const GroundTruth& truth : image.truth) shown.insert(truth.object);
    for (const int object : shown) tallies[object].addImage({image.scene, image.id}, times);
  }
  for (const TruthOutcome& truth : run.truths) tallies[truth.object].add(truth);
  for (const RowOutcome& row : run.rows) tallies[row.object].add(row);

  std::vector<GroupScore> scores;
  for (auto& [object, tally] : tallies) {
    const auto model = models.find(object);
    scores.push_back(
        tally.finish(model == models.end() ? fmt::format("object {}", object) : model->second.name));
  }
  return scores;
}

GroupScore scoreOfAll(const BopSplit& split, const RunOutcomes& run, const ImageTimes& times) {
  Tally tally;
  for (const BopImage& image : split.images) tally.addImage({image.scene, image.id}, times);
  for (const TruthOutcome& truth : run.truths) tally.add(truth);
  for (const RowOutcome& row : run.rows) tally.add(row);
  return tally.finish("all");
}

std::vector<RecallBin> recallByVisibility(const RunOutcomes& run) {
  const std::vector<double> edges{0, 10, 30, 50, 70, 90, 100};  // [%]
  std::vector<RecallBin> bins = emptyBins(edges);
  for (const TruthOutcome& truth : run.truths)
    count(truth, binOf(std::clamp(100 * truth.visible, 0.0, 99.999), edges), &bins);
  return trimmed(bins);
}

std::vector<RecallBin> recallBySize(const RunOutcomes& run) {
  const std::vector<double> edges{0,   16,  24,  32,  48,  64,   96, 128,
                                  192, 256, 384, 512, 768, 1024, 1e5};  // [px]
  std::vector<RecallBin> bins = emptyBins(edges);
  bins.back().label = "over 1024";
  for (const TruthOutcome& truth : run.truths)
    if (truth.wanted()) count(truth, binOf(truth.size, edges), &bins);
  return trimmed(bins);
}

std::vector<RecallBin> recallByDistance(const RunOutcomes& run) {
  constexpr int kMaxBins = 8;
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const TruthOutcome& truth : run.truths)
    if (truth.wanted()) {
      nearest = std::min(nearest, truth.distance);
      farthest = std::max(farthest, truth.distance);
    }
  if (!(farthest >= nearest)) return {};

  // One bin less than allowed: the first one begins at a round number below the nearest.
  const double step = roundStep(std::max((farthest - nearest) / (kMaxBins - 1), 0.01));
  std::vector<double> edges{std::floor(nearest / step) * step};
  while (edges.back() <= farthest) edges.push_back(edges.front() + double(edges.size()) * step);
  std::vector<RecallBin> bins = emptyBins(edges);
  for (const TruthOutcome& truth : run.truths)
    if (truth.wanted()) count(truth, binOf(truth.distance, edges), &bins);
  return trimmed(bins);
}

std::vector<RecallBin> recallBySide(const RunOutcomes& run, int object) {
  std::vector<RecallBin> bins;
  for (const char* side : {"+x", "\u2212x", "+y", "\u2212y", "+z", "\u2212z"}) bins.push_back({side, {}});
  for (const TruthOutcome& truth : run.truths) {
    if (!truth.wanted() || truth.object != object) continue;
    Eigen::Index axis = 0;
    truth.towards_camera.cwiseAbs().maxCoeff(&axis);
    count(truth, int(2 * axis) + (truth.towards_camera[axis] < 0), &bins);
  }
  return bins;
}

std::vector<Prediction> predictions(const std::vector<JudgedPose>& judged) {
  std::vector<Prediction> all;
  for (const JudgedPose& pose : judged)
    if (pose.fate != JudgedPose::kSuppressed) all.push_back({pose.probability, pose.right()});
  return all;
}

std::vector<PrecisionRecallPoint> precisionRecall(const std::vector<JudgedPose>& judged,
                                                  const RunOutcomes& run) {
  const auto wanted =
      std::count_if(run.truths.begin(), run.truths.end(), [](const TruthOutcome& t) { return t.wanted(); });
  std::vector<const JudgedPose*> order;
  for (const JudgedPose& pose : judged)
    if (pose.fate != JudgedPose::kSuppressed) order.push_back(&pose);
  if (wanted == 0) return {};
  std::stable_sort(order.begin(), order.end(),
                   [](const JudgedPose* a, const JudgedPose* b) { return a->probability > b->probability; });

  std::vector<PrecisionRecallPoint> curve;
  std::set<std::array<int, 3>> hit;  // scene, image, truth
  int right = 0;
  for (size_t k = 0; k < order.size(); ++k) {
    const JudgedPose& pose = *order[k];
    right += pose.right();
    if (pose.right() && pose.visible >= kWantedVisible) hit.insert({pose.scene, pose.image, pose.nearest});
    if (k + 1 < order.size() && order[k + 1]->probability == pose.probability) continue;
    curve.push_back({pose.probability, right / double(k + 1), double(hit.size()) / double(wanted)});
  }
  return curve;
}

RunComparison compareRuns(const BopSplit& split, const RunOutcomes& a, const ImageTimes& times_a,
                          const RunOutcomes& b, const ImageTimes& times_b) {
  RunComparison comparison;
  std::map<int, PairedCounts> pairs;
  bool same = a.truths.size() == b.truths.size();
  for (size_t k = 0; same && k < a.truths.size(); ++k) {
    const TruthOutcome &in_a = a.truths[k], &in_b = b.truths[k];
    same = in_a.scene == in_b.scene && in_a.image == in_b.image && in_a.object == in_b.object;
    if (!in_a.wanted()) continue;
    pairs[in_a.scene].add(in_a.found(), in_b.found());
    comparison.all.found.add(in_a.found(), in_b.found());
    if (in_a.found() != in_b.found()) comparison.changed.push_back({in_a, in_b});
  }
  if (!same) throw BadInput("runs can be compared only over the same images and truth");

  const auto scenes_a = scoresByScene(split, a, times_a), scenes_b = scoresByScene(split, b, times_b);
  std::set<int> scenes;
  for (const BopImage& image : split.images) scenes.insert(image.scene);
  size_t k = 0;
  for (const int scene : scenes) {
    comparison.scenes.push_back({scenes_a[k], scenes_b[k], pairs[scene]});
    ++k;
  }
  comparison.all.a = scoreOfAll(split, a, times_a);
  comparison.all.b = scoreOfAll(split, b, times_b);
  return comparison;
}

}  // namespace monocular_eye_hand
