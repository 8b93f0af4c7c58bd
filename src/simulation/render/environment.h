#pragma once
#include <vector>

#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

/// An Environment ready to be asked often.
class Surroundings {
 public:
  explicit Surroundings(const Environment& environment);
  /// `direction`: unit, world; `spread`: of the reflected rays (standard deviation of the slope), which
  /// softens the panels.
  float radiance(const Eigen::Vector3f& direction, float spread) const;

 private:
  struct Panel {
    Eigen::Vector3f middle, x, y;
    float half_width, half_height, softness, radiance;
  };
  float low_, high_;
  std::vector<Panel> panels_;
};

}  // namespace monocular_eye_hand
