#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "recognition/focal_length.h"
#include "recognition/hypotheses.h"
#include "recognition/search_trace.h"

namespace monocular_eye_hand {
namespace {

constexpr int kPerPlace = 40;
constexpr float kMinHypothesisEvidence = 4.0f;  // nats: below, nothing in the image speaks for the pose

// Numbers that tell a pose from any other, in an order of their own.
auto numbers(const Rigid3& pose) {
  std::array<double, 12> all;
  std::copy_n(pose.translation.data(), 3, all.begin());
  std::copy_n(pose.rotation.data(), 9, all.begin() + 3);
  return all;
}

}  // namespace

bool Hypothesis::betterThan(const Hypothesis& other) const {
  if (evidence != other.evidence) return evidence > other.evidence;
  if (view != other.view) return view < other.view;
  const auto mine = numbers(camera_from_object);
  const auto others = numbers(other.camera_from_object);
  return mine != others ? mine < others : kind < other.kind;
}

DistanceRange searchedDistances(const SearchTask& task, const ObjectModel& model) {
  const RecognitionOptions& options = task.options;
  const double focal = focalLength(task.image.camera);
  return {std::max(options.nearest(model.diameter), model.diameter * focal / task.largest_size),
          std::min(options.max_distance, model.diameter * focal / options.min_size)};
}

HypothesisPool::HypothesisPool(const SearchTask& task, int object)
    : task_(task),
      object_(object),
      camera_(task.image.camera),
      model_(task.models[object]),
      options_(task.options),
      range_(searchedDistances(task, model_.model())),
      best_(camera_.width, camera_.height, kPerPlace) {}

void HypothesisPool::offer(const Rigid3& pose, GroupingKind kind, const EvidenceMap& map,
                           WorkBudget* budget) {
  budget->count();
  note(task_, SearchStage::kGenerated, object_, pose);
  const Eigen::Vector3d centre = pose * model_.model().centre();
  const double distance = centre.norm();
  if (!(centre.z() > 0) || distance < range_.nearest || distance > range_.farthest) return;
  const Eigen::Vector2d uv = camera_.project(centre);
  if (!best_.hasPlace(uv.x(), uv.y())) return;

  Hypothesis h;
  h.camera_from_object = model_.canonical(pose, &h.view);
  const CoarseScore score = scorePose(model_.coarse(h.view), h.camera_from_object, camera_, map);
  if (score.evidence < kMinHypothesisEvidence || score.in_frame < options_.min_in_frame) return;
  h.evidence = score.evidence;
  h.in_frame = score.in_frame;
  h.kind = kind;
  best_.offer(uv.x(), uv.y(), h);
}

std::vector<Hypothesis> HypothesisPool::take(int count) {
  std::vector<Hypothesis> all = best_.all();
  std::sort(all.begin(), all.end(), [](const Hypothesis& a, const Hypothesis& b) { return a.betterThan(b); });

  // Near-duplicates share view, place, distance and roll to within what refinement bridges.
  std::map<std::tuple<int, int, int, int, int>, int> seen;
  std::vector<Hypothesis> kept;
  const int directions = model_.object().views.directions;
  float min_evidence = 0;  // evidence of the last one looked at: everything above it leaves the pool
  for (const Hypothesis& h : all) {
    if (int(kept.size()) >= count) break;
    min_evidence = h.evidence;
    const Eigen::Vector3d centre = h.camera_from_object * model_.model().centre();
    const Eigen::Vector2d uv = camera_.project(centre);
    const Eigen::Matrix3d in_view = h.camera_from_object.rotation * model_.viewRotation(h.view).transpose();
    const double roll = std::atan2(in_view(1, 0) - in_view(0, 1), in_view(0, 0) + in_view(1, 1));
    const auto key =
        std::make_tuple(h.view % directions, int(std::floor(uv.x() / 6)), int(std::floor(uv.y() / 6)),
                        int(std::floor(std::log(centre.norm()) / 0.08)), int(std::floor(roll / 0.15)));
    if (seen[key]++) continue;
    kept.push_back(h);
  }

  best_.removeIf([&](const Hypothesis& h) { return h.evidence >= min_evidence; });
  return kept;
}

}  // namespace monocular_eye_hand
