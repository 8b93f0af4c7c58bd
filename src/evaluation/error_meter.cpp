#include "monocular_eye_hand/evaluation/error_meter.h"

#include <fmt/format.h>

#include <algorithm>

#include "evaluation/pose_error.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

ErrorMeter::ErrorMeter(const BopModels& models, double symmetry_step) : models_(models) {
  for (const auto& entry : models)
    symmetries_[entry.first] = discretized(entry.second.symmetries, symmetry_step);
}

const BopModel& ErrorMeter::model(int object) const {
  const auto at = models_.find(object);
  if (at == models_.end())
    throw BadInput(
        fmt::format("the ground truth names object {}, which models_info.json does not list", object));
  return at->second;
}

PoseErrors ErrorMeter::measure(const BopImage& image, const GroundTruth& truth,
                               const Rigid3& estimate) const {
  const BopModel& model = this->model(truth.object);
  const std::vector<Rigid3>& symmetries = symmetries_.at(truth.object);
  return {mssd(estimate, truth.camera_from_object, model.vertices, symmetries) / model.diameter,
          mspd(estimate, truth.camera_from_object, image.intrinsics, model.vertices, symmetries)};
}

double ErrorMeter::closestDistance(const GroundTruth& truth, const Rigid3& estimate) const {
  const BopModel& model = this->model(truth.object);
  return adi(estimate, truth.camera_from_object, model.vertices) / model.diameter;
}

ResultsByImage byImage(const std::vector<BopResult>& results) {
  ResultsByImage table;
  for (const BopResult& row : results) table[{row.scene, row.image}].push_back(row);
  for (auto& entry : table)
    std::stable_sort(entry.second.begin(), entry.second.end(),
                     [](const BopResult& a, const BopResult& b) { return a.score > b.score; });
  return table;
}

}  // namespace monocular_eye_hand
