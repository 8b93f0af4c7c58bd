#include "monocular_eye_hand/evaluation/outcomes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "evaluation/pose_error.h"

namespace monocular_eye_hand {
namespace {

constexpr double kCoarseSymmetryStep = 0.05;
constexpr double kFarDiameters = 2;

Eigen::Vector3d middleOf(const BopModel& model) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& x : model.vertices) box.extend(x);
  return box.isEmpty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(box.center());
}

TruthOutcome unmatched(const BopImage& image, int index, const BopModel& model,
                       const Eigen::Vector3d& middle) {
  const GroundTruth& truth = image.truth[size_t(index)];
  TruthOutcome outcome;
  outcome.scene = image.scene;
  outcome.image = image.id;
  outcome.index = index;
  outcome.object = truth.object;
  outcome.camera_from_object = truth.camera_from_object;
  outcome.visible = truth.visible;
  outcome.distance = (truth.camera_from_object * middle).norm();
  outcome.size = model.diameter * image.intrinsics(0, 0) / outcome.distance;
  outcome.towards_camera = (truth.camera_from_object.inverse().translation - middle).normalized();
  return outcome;
}

// Rows of every image by (scene, image), best score first, equal scores in the order of the file.
std::map<std::pair<int, int>, std::vector<RowOutcome>> rowsByImage(const std::vector<BopResult>& results) {
  std::map<std::pair<int, int>, std::vector<RowOutcome>> table;
  for (size_t k = 0; k < results.size(); ++k) {
    const BopResult& result = results[k];
    RowOutcome row;
    row.row = int(k);
    row.scene = result.scene;
    row.image = result.image;
    row.object = result.object;
    row.score = result.score;
    row.camera_from_object = result.camera_from_object;
    table[{row.scene, row.image}].push_back(row);
  }
  for (auto& entry : table)
    std::stable_sort(entry.second.begin(), entry.second.end(),
                     [](const RowOutcome& a, const RowOutcome& b) { return a.score > b.score; });
  return table;
}

// errors[row][truth]; not a match: infinite.
std::vector<std::vector<PoseErrors>> pairErrors(const BopImage& image, const std::vector<RowOutcome>& rows,
                                                const ErrorMeter& meter) {
  std::vector<std::vector<PoseErrors>> errors(rows.size(), {image.truth.size(), kNoMatch});
  for (size_t a = 0; a < rows.size(); ++a)
    for (size_t b = 0; b < image.truth.size(); ++b) {
      const GroundTruth& truth = image.truth[b];
      const Rigid3& estimate = rows[a].camera_from_object;
      if (truth.object != rows[a].object) continue;
      const double distance = (estimate.translation - truth.camera_from_object.translation).norm();
      if (distance > kFarDiameters * meter.model(truth.object).diameter) continue;
      errors[a][b] = meter.measure(image, truth, estimate);
    }
  return errors;
}

// One-to-one, smallest MSPD first.
void matchSmallestFirst(const std::vector<std::vector<PoseErrors>>& errors,
                        const std::vector<RowOutcome>& rows, std::vector<TruthOutcome>* truths) {
  std::vector<std::pair<size_t, size_t>> pairs;
  for (size_t a = 0; a < errors.size(); ++a)
    for (size_t b = 0; b < truths->size(); ++b)
      if (std::isfinite(errors[a][b].mspd)) pairs.emplace_back(a, b);
  std::stable_sort(pairs.begin(), pairs.end(), [&](const auto& p, const auto& q) {
    return errors[p.first][p.second].mspd < errors[q.first][q.second].mspd;
  });
  std::vector<bool> row_taken(errors.size());
  for (const auto& [a, b] : pairs) {
    TruthOutcome& truth = (*truths)[b];
    if (row_taken[a] || truth.row >= 0) continue;
    row_taken[a] = true;
    truth.row = rows[a].row;
    truth.errors = errors[a][b];
  }
}

void findNearest(const std::vector<PoseErrors>& errors, RowOutcome* row) {
  for (size_t b = 0; b < errors.size(); ++b)
    if (errors[b].mspd < row->errors.mspd) {
      row->nearest = int(b);
      row->errors = errors[b];
    }
}

}  // namespace

double TruthOutcome::recall() const {
  const auto share = [](double error, const std::vector<double>& thresholds) {
    const auto below =
        std::count_if(thresholds.begin(), thresholds.end(), [&](double th) { return error < th; });
    return double(below) / double(thresholds.size());
  };
  return (share(errors.mssd, mssdThresholds()) + share(errors.mspd, mspdThresholds())) / 2;
}

RunOutcomes judgeRun(const BopSplit& split, const BopModels& models, const std::vector<BopResult>& results) {
  const ErrorMeter meter(models, kCoarseSymmetryStep);
  std::map<int, Eigen::Vector3d> middles;
  for (const auto& entry : models) middles[entry.first] = middleOf(entry.second);

  auto table = rowsByImage(results);
  RunOutcomes outcomes;
  for (const BopImage& image : split.images) {
    std::vector<RowOutcome>& rows = table[{image.scene, image.id}];
    std::vector<TruthOutcome> truths;
    for (int k = 0; k < int(image.truth.size()); ++k) {
      const BopModel& model = meter.model(image.truth[size_t(k)].object);
      truths.push_back(unmatched(image, k, model, middles.at(model.id)));
    }
    const auto errors = pairErrors(image, rows, meter);
    matchSmallestFirst(errors, rows, &truths);
    for (size_t a = 0; a < rows.size(); ++a) findNearest(errors[a], &rows[a]);
    outcomes.truths.insert(outcomes.truths.end(), truths.begin(), truths.end());
    outcomes.rows.insert(outcomes.rows.end(), rows.begin(), rows.end());
  }
  return outcomes;
}

std::vector<JudgedPose> measured(std::vector<JudgedPose> poses, const BopSplit& split,
                                 const BopModels& models) {
  const ErrorMeter meter(models, kCoarseSymmetryStep);
  for (JudgedPose& pose : poses) {
    const BopImage* image = split.find(pose.scene, pose.image);
    if (!image) continue;
    for (size_t k = 0; k < image->truth.size(); ++k) {
      const GroundTruth& truth = image->truth[k];
      if (truth.object != pose.object) continue;
      const PoseErrors errors = meter.measure(*image, truth, pose.camera_from_object);
      if (pose.nearest >= 0 && !(errors.mspd < pose.errors.mspd)) continue;
      pose.nearest = int(k);
      pose.errors = errors;
      pose.visible = truth.visible;
    }
  }
  return poses;
}

}  // namespace monocular_eye_hand
