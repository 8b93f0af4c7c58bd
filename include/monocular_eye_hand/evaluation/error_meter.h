#pragma once
#include <map>
#include <vector>

#include "monocular_eye_hand/evaluation/dataset.h"
#include "monocular_eye_hand/evaluation/results.h"

namespace monocular_eye_hand {

/// Errors of one estimate against one ground truth.
struct PoseErrors {
  double mssd = 0;  ///< share of the diameter
  double mspd = 0;  ///< [px]
};

/// Computes errors with each model's symmetries discretised once. Throws BadInput on a ground truth whose
/// object is not among the models.
class ErrorMeter {
 public:
  /// `symmetry_step` as in discretized(). Keeps a reference to `models`.
  ErrorMeter(const BopModels& models, double symmetry_step);
  const BopModel& model(int object) const;
  /// adi() as a share of the diameter.
  double closestDistance(const GroundTruth& truth, const Rigid3& estimate) const;
  PoseErrors measure(const BopImage& image, const GroundTruth& truth, const Rigid3& estimate) const;

 private:
  const BopModels& models_;
  std::map<int, std::vector<Rigid3>> symmetries_;
};

/// The results of an image, best score first, equal scores in the order of the file.
using ResultsByImage = std::map<std::pair<int, int>, std::vector<BopResult>>;
ResultsByImage byImage(const std::vector<BopResult>& results);

}  // namespace monocular_eye_hand
