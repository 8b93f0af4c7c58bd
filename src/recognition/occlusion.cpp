#include "recognition/occlusion.h"

#include <utility>

#include "monocular_eye_hand/model/ray_scene.h"
#include "recognition/judging.h"

namespace monocular_eye_hand {
namespace {

constexpr double kSurelyRight = 0.9;     // from this probability an object hides what is behind it
constexpr double kWorthExcusing = 0.02;  // probability below which hidden parts do not save a candidate
constexpr double kThickness = 0.002;     // nearer together than this, one does not hide the other [m]

}  // namespace

bool Occluder::hides(const Camera& camera, const Eigen::Vector2d& uv, double distance) const {
  if (!box.contains(cv::Point(int(std::lround(uv.x())), int(std::lround(uv.y()))))) return false;
  const Eigen::Vector3d ray = (object_from_camera.rotation * camera.ray(uv)).normalized();
  const RayScene::Hit hit = model->rays->cast(object_from_camera.translation, ray);
  return hit.hit && hit.distance < distance - kThickness;
}

std::vector<Candidate> excuseHidden(const SearchTask& task, std::vector<Candidate> candidates,
                                    const std::vector<Explanation>& chosen, StageLog* log) {
  return log->timed("hidden parts", [&](StageReport* report) {
    std::vector<int> sure;
    for (const Explanation& explanation : chosen)
      if (candidates[explanation.candidate].probability >= kSurelyRight)
        sure.push_back(explanation.candidate);

    // Every object judges by the candidates as they were, whatever the order.
    const std::vector<Candidate>& before = candidates;
    std::vector<std::pair<int, Candidate>> again;
    for (int i = 0; i < int(before.size()); ++i) {
      const Candidate& candidate = before[i];
      if (candidate.probability < kWorthExcusing) continue;
      std::vector<Occluder> occluders;
      for (int s : sure) {
        const Candidate& other = before[s];
        if (s == i || (other.bounding_box & candidate.bounding_box).area() == 0) continue;
        if (conflict(other, candidate)) continue;
        occluders.push_back({&task.models[other.object].model(), other.pose.camera_from_object.inverse(),
                             other.bounding_box});
      }
      if (occluders.empty()) continue;
      Candidate seen = candidate;
      seen.occluders = std::move(occluders);
      ++report->counts["verified"];
      if (bearsOut(task, &seen) && seen.terms.hidden > 0) again.emplace_back(i, std::move(seen));
    }
    for (auto& [index, candidate] : again) candidates[index] = std::move(candidate);
    return std::move(candidates);
  });
}

}  // namespace monocular_eye_hand
