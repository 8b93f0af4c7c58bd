#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "evaluation/pose_error.h"
#include "monocular_eye_hand/evaluation/error_meter.h"
#include "monocular_eye_hand/evaluation/scores.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

constexpr double kSymmetryStep = 0.01;
constexpr double kMinVisible = 0.1;
constexpr size_t kMaxDetections = 100;   // of an image
constexpr double kReferenceWidth = 640;  // MSPD's thresholds are for images of this width [px]

enum class Kind { kMssd, kMspd };

struct Estimate {
  double score = 0;
  bool detection = false;         // among the image's best 100
  std::vector<PoseErrors> error;  // against each of the group's truths; MSPD scaled to 640 px
  double errorTo(size_t truth, Kind kind) const {
    return kind == Kind::kMssd ? error[truth].mssd : error[truth].mspd;
  }
};

// One object in one image.
struct Group {
  std::vector<double> visible;      // of its ground-truth instances
  std::vector<Estimate> estimates;  // best score first
};
using Groups = std::map<int, Group>;  // by object

Groups groupsOf(const BopImage& image, const std::vector<BopResult>& rows, const ErrorMeter& meter,
                int width) {
  Groups groups;
  for (const GroundTruth& truth : image.truth) groups[truth.object].visible.push_back(truth.visible);

  for (size_t k = 0; k < rows.size(); ++k) {
    Estimate estimate;
    estimate.score = rows[k].score;
    estimate.detection = k < kMaxDetections;
    for (const GroundTruth& truth : image.truth) {
      if (truth.object != rows[k].object) continue;
      const Rigid3& pose = rows[k].camera_from_object;
      PoseErrors errors = meter.measure(image, truth, pose);
      errors.mspd *= kReferenceWidth / width;
      const double distance = (pose.translation - truth.camera_from_object.translation).norm();
      if (distance >= meter.model(truth.object).diameter)
        errors.mssd = std::numeric_limits<double>::infinity();
      estimate.error.push_back(errors);
    }
    groups[rows[k].object].estimates.push_back(std::move(estimate));
  }
  return groups;
}

constexpr int kUnmatched = -1;

// Greedy by score: each estimate takes the free valid truth of smallest error below the threshold. Returns
// the truth of every estimate.
std::vector<int> match(const std::vector<const Estimate*>& estimates, const std::vector<bool>& valid,
                       Kind kind, double threshold) {
  std::vector<bool> taken(valid.size());
  std::vector<int> truth_of(estimates.size(), kUnmatched);
  for (size_t k = 0; k < estimates.size(); ++k) {
    double best = threshold;
    for (size_t g = 0; g < valid.size(); ++g) {
      if (!valid[g] || taken[g] || !(estimates[k]->errorTo(g, kind) < best)) continue;
      best = estimates[k]->errorTo(g, kind);
      truth_of[k] = int(g);
    }
    if (truth_of[k] != kUnmatched) taken[size_t(truth_of[k])] = true;
  }
  return truth_of;
}

const std::vector<double>& thresholds(Kind kind) {
  return kind == Kind::kMssd ? mssdThresholds() : mspdThresholds();
}

// ---- 6D localization

struct LocalizationTask {
  std::vector<const Estimate*> estimates;  // the best of them
  std::vector<bool> valid;                 // the most visible instances
  int instances = 0;
};

LocalizationTask localizationTask(const Group& group, int count) {
  LocalizationTask task;
  const size_t wanted = size_t(std::max(count, 0));
  std::vector<size_t> order(group.visible.size());
  for (size_t g = 0; g < order.size(); ++g) order[g] = g;
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return group.visible[a] > group.visible[b]; });
  task.valid.assign(order.size(), false);
  task.instances = int(std::min(wanted, order.size()));
  for (int i = 0; i < task.instances; ++i) task.valid[order[size_t(i)]] = true;
  for (size_t k = 0; k < std::min(wanted, group.estimates.size()); ++k)
    task.estimates.push_back(&group.estimates[k]);
  return task;
}

double averageRecall(const std::vector<LocalizationTask>& tasks, Kind kind) {
  int instances = 0;
  for (const LocalizationTask& task : tasks) instances += task.instances;
  if (instances == 0) return std::nan("");
  double sum = 0;
  for (double threshold : thresholds(kind)) {
    int right = 0;
    for (const LocalizationTask& task : tasks)
      for (int truth : match(task.estimates, task.valid, kind, threshold)) right += truth != kUnmatched;
    sum += double(right) / instances;
  }
  return sum / double(thresholds(kind).size());
}

// ---- 6D detection

struct Detection {
  double score = 0;
  bool right = false;
};

// Area under the precision-recall curve, precision interpolated at the recalls 0, 0.01, ..., 1.
double averagePrecision(std::vector<Detection> detections, int instances) {
  std::stable_sort(detections.begin(), detections.end(),
                   [](const Detection& a, const Detection& b) { return a.score > b.score; });
  std::vector<double> recall, precision;
  int right = 0;
  for (size_t k = 0; k < detections.size(); ++k) {
    right += detections[k].right;
    recall.push_back(double(right) / instances);
    precision.push_back(double(right) / double(k + 1));
  }
  for (size_t k = precision.size(); k-- > 1;) precision[k - 1] = std::max(precision[k - 1], precision[k]);
  double sum = 0;
  for (int i = 0; i <= 100; ++i) {
    const auto at = std::lower_bound(recall.begin(), recall.end(), i == 100 ? 1.0 : i * 0.01);
    if (at != recall.end()) sum += precision[size_t(at - recall.begin())];
  }
  return sum / 101;
}

// NaN when no instance of the object is visible.
double averagePrecision(const std::vector<Groups>& images, int object, Kind kind, double threshold,
                        bool strict) {
  std::vector<Detection> detections;
  int instances = 0;
  for (const Groups& groups : images) {
    const auto found = groups.find(object);
    if (found == groups.end()) continue;
    const Group& group = found->second;
    if (group.visible.empty() && !strict) continue;

    std::vector<const Estimate*> estimates;
    for (const Estimate& estimate : group.estimates)
      if (estimate.detection) estimates.push_back(&estimate);
    const std::vector<int> truth_of =
        match(estimates, std::vector<bool>(group.visible.size(), true), kind, threshold);

    const auto visible = [&](int g) { return group.visible[size_t(g)] >= kMinVisible; };
    for (size_t g = 0; g < group.visible.size(); ++g) instances += visible(int(g));
    for (size_t k = 0; k < estimates.size(); ++k) {
      const bool right = truth_of[k] != kUnmatched;
      if (!right || visible(truth_of[k])) detections.push_back({estimates[k]->score, right});
    }
  }
  return instances > 0 ? averagePrecision(std::move(detections), instances) : std::nan("");
}

double meanAveragePrecision(const std::vector<Groups>& images, Kind kind, bool strict) {
  std::set<int> objects;
  for (const Groups& groups : images)
    for (const auto& entry : groups)
      if (!entry.second.visible.empty()) objects.insert(entry.first);
  double sum = 0;
  int count = 0;
  for (int object : objects) {
    double of_object = 0;
    for (double threshold : thresholds(kind))
      of_object += averagePrecision(images, object, kind, threshold, strict);
    if (std::isnan(of_object)) continue;
    sum += of_object / double(thresholds(kind).size());
    ++count;
  }
  return count > 0 ? sum / count : std::nan("");
}

}  // namespace

BopScores scoreBop(const BopSplit& split, const BopModels& models, const std::vector<BopResult>& results,
                   const std::vector<BopTarget>& given_targets) {
  const std::vector<BopTarget> targets = given_targets.empty() ? visibleTargets(split) : given_targets;
  const ResultsByImage table = byImage(results);
  using Key = std::pair<int, int>;
  // Without a list every image with results counts, in ascending order; with one, its images in its order.
  std::vector<Key> keys;
  std::set<Key> seen, target_images;
  for (const BopTarget& target : targets) {
    const Key key(target.scene, target.image);
    target_images.insert(key);
    if (!split.find(key.first, key.second))
      throw BadInput(fmt::format("the targets name scene {}, image {}, which the split does not have",
                                 key.first, key.second));
    if (seen.insert(key).second) keys.push_back(key);
  }
  if (given_targets.empty()) {
    for (const auto& entry : table)
      if (split.find(entry.first.first, entry.first.second)) seen.insert(entry.first);
    keys.assign(seen.begin(), seen.end());
  }

  const ErrorMeter meter(models, kSymmetryStep);
  std::vector<Groups> images;
  std::map<Key, size_t> index;
  const std::vector<BopResult> none;
  for (const Key& key : keys) {
    const auto rows = table.find(key);
    index[key] = images.size();
    images.push_back(groupsOf(*split.find(key.first, key.second), rows == table.end() ? none : rows->second,
                              meter, split.width));
  }
  std::vector<LocalizationTask> tasks;
  BopScores scores;
  for (const BopTarget& target : targets) {
    tasks.push_back(
        localizationTask(images[index.at({target.scene, target.image})][target.object], target.count));
    scores.targets += tasks.back().instances;
  }
  scores.images = int(target_images.size());
  scores.estimates = int(results.size());
  scores.ar_mssd = averageRecall(tasks, Kind::kMssd);
  scores.ar_mspd = averageRecall(tasks, Kind::kMspd);
  scores.map_mssd = meanAveragePrecision(images, Kind::kMssd, false);
  scores.map_mspd = meanAveragePrecision(images, Kind::kMspd, false);
  scores.map_mssd_strict = meanAveragePrecision(images, Kind::kMssd, true);
  scores.map_mspd_strict = meanAveragePrecision(images, Kind::kMspd, true);
  return scores;
}

}  // namespace monocular_eye_hand
