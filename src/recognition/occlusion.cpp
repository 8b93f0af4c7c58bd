#include "recognition/occlusion.h"

#include <optional>
#include <utility>

#include "monocular_eye_hand/mesh/ray_scene.h"
#include "recognition/judging.h"
#include "recognition/shared_work.h"

namespace monocular_eye_hand {
namespace {

constexpr double kHides = 0.9;           // from this probability an object hides what is behind it
constexpr double kWorthExcusing = 0.02;  // probability below which hidden parts do not save a candidate
constexpr double kThickness = 0.002;     // nearer together than this, one does not hide the other [m]

// A candidate judged again with what surely hides parts of it; nothing when nothing does.
std::optional<Candidate> excused(const SearchTask& task, const std::vector<Candidate>& candidates,
                                 const std::vector<int>& sure, int index) {
  const Candidate& candidate = candidates[size_t(index)];
  if (candidate.probability < kWorthExcusing) return std::nullopt;
  std::vector<Occluder> occluders;
  for (int s : sure) {
    const Candidate& other = candidates[size_t(s)];
    if (s == index || (other.bounding_box & candidate.bounding_box).area() == 0) continue;
    if (conflict(other, candidate)) continue;
    occluders.push_back({&task.models[size_t(other.object)].model(), other.pose.camera_from_object.inverse(),
                         other.bounding_box});
  }
  if (occluders.empty()) return std::nullopt;

  Candidate seen = candidate;
  seen.occluders = std::move(occluders);
  if (!bearsOut(task, &seen)) seen.terms.hidden = 0;  // nothing is excused
  return seen;
}

}  // namespace

bool Occluder::hides(const Camera& camera, const Eigen::Vector2d& uv, double distance) const {
  if (!box.contains(cv::Point(int(std::lround(uv.x())), int(std::lround(uv.y()))))) return false;
  const Eigen::Vector3d ray = (object_from_camera.rotation * camera.ray(uv)).normalized();
  const RayScene::Hit hit = model->rays->cast(object_from_camera.translation, ray);
  return hit.hit && hit.distance < distance - kThickness;
}

std::vector<Candidate> excuseHidden(const SearchTask& task, Explained all, StageLog* log) {
  std::vector<Candidate>& candidates = all.candidates;
  return log->timed("hidden parts", [&](StageReport* report) {
    std::vector<int> sure;
    for (const Explanation& explanation : all.chosen)
      if (candidates[explanation.candidate].probability >= kHides) sure.push_back(explanation.candidate);

    // Every object judges by the candidates as they were, whatever the order.
    std::vector<std::optional<Candidate>> again(candidates.size());
    atOnce(int(candidates.size()), [&](int i) { again[size_t(i)] = excused(task, candidates, sure, i); });
    for (size_t i = 0; i < again.size(); ++i) {
      if (!again[i]) continue;
      ++report->counts["verified"];
      if (again[i]->terms.hidden > 0) candidates[i] = std::move(*again[i]);
    }
    return std::move(candidates);
  });
}

}  // namespace monocular_eye_hand
