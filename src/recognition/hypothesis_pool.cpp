#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "recognition/hypotheses.h"
#include "recognition/search_trace.h"

namespace monocular_eye_hand {
namespace {

constexpr double kCellSize = 32.0;  // side of a place [px]
constexpr int kPerCell = 40;
constexpr float kMinEvidence = 4.0f;  // nats: below, nothing in the image speaks for the pose

}  // namespace

HypothesisPool::HypothesisPool(const SearchTask& task, int object)
    : task_(task),
      object_(object),
      camera_(task.image.camera),
      model_(task.models[object]),
      options_(task.options),
      cells_x_(int(std::ceil(camera_.width / kCellSize)) + 2),
      cells_y_(int(std::ceil(camera_.height / kCellSize)) + 2),
      cells_(size_t(cells_x_) * cells_y_) {}

void HypothesisPool::offer(const Rigid3& pose, GroupingKind kind, const EvidenceMap& map,
                           WorkBudget* budget) {
  budget->count();
  note(task_, SearchStage::kGenerated, object_, pose);
  const Eigen::Vector3d centre = pose * model_.model().centre();
  const double distance = centre.norm();
  const double diameter = model_.model().diameter;
  if (!(centre.z() > 0) || distance < options_.nearest(diameter) || distance > options_.max_distance) return;
  if (diameter * camera_.fx / distance < options_.min_size) return;
  const Eigen::Vector2d uv = camera_.project(centre);
  const int x = int(std::floor(uv.x() / kCellSize)) + 1, y = int(std::floor(uv.y() / kCellSize)) + 1;
  if (x < 0 || y < 0 || x >= cells_x_ || y >= cells_y_) return;

  Hypothesis h;
  h.camera_from_object = model_.canonical(pose, &h.view);
  const CoarseScore score = scorePose(model_, h.view, h.camera_from_object, camera_, map);
  if (score.evidence < kMinEvidence || score.in_frame < options_.min_in_frame) return;
  h.evidence = score.evidence;
  h.in_frame = score.in_frame;
  h.kind = kind;
  auto& cell = cells_[size_t(y) * cells_x_ + x];
  const auto better = [](const Hypothesis& a, const Hypothesis& b) { return a.evidence > b.evidence; };
  if (int(cell.size()) < kPerCell) {
    cell.push_back(h);
    std::push_heap(cell.begin(), cell.end(), better);
  } else if (h.evidence > cell.front().evidence) {
    std::pop_heap(cell.begin(), cell.end(), better);
    cell.back() = h;
    std::push_heap(cell.begin(), cell.end(), better);
  }
}

std::vector<Hypothesis> HypothesisPool::take(int count) {
  std::vector<Hypothesis> all;
  for (const auto& cell : cells_) all.insert(all.end(), cell.begin(), cell.end());
  const auto better = [](const Hypothesis& a, const Hypothesis& b) { return a.evidence > b.evidence; };
  std::sort(all.begin(), all.end(), [](const Hypothesis& a, const Hypothesis& b) {
    if (a.evidence != b.evidence) return a.evidence > b.evidence;
    if (a.view != b.view) return a.view < b.view;
    for (int i = 0; i < 3; ++i)
      if (a.camera_from_object.translation[i] != b.camera_from_object.translation[i])
        return a.camera_from_object.translation[i] < b.camera_from_object.translation[i];
    return false;
  });

  // Near-duplicates share view, place, distance and roll to within what refinement bridges.
  std::map<std::tuple<int, int, int, int, int>, int> seen;
  std::vector<Hypothesis> kept;
  const int directions = model_.object().views.directions;
  float least = 0;  // evidence of the last one looked at: everything above it leaves the pool
  for (const Hypothesis& h : all) {
    if (int(kept.size()) >= count) break;
    least = h.evidence;
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

  for (auto& cell : cells_) {
    cell.erase(
        std::remove_if(cell.begin(), cell.end(), [&](const Hypothesis& h) { return h.evidence >= least; }),
        cell.end());
    std::make_heap(cell.begin(), cell.end(), better);
  }
  return kept;
}

}  // namespace monocular_eye_hand
