#pragma once
#include <vector>

#include "monocular_eye_hand/simulation/finish.h"

namespace monocular_eye_hand {

/// The prints of one object in world coordinates, ready to be looked up.
class PrintLookup {
 public:
  PrintLookup() = default;
  PrintLookup(const std::vector<Print>& prints, const Rigid3& world_from_object);
  struct Ink {
    float albedo;
    float bare;  ///< share of the surface that no print covers
  };
  /// At a surface point that would have `albedo` without prints. World frame.
  Ink at(float albedo, const Eigen::Vector3f& p, const Eigen::Vector3f& normal) const;

 private:
  struct Sheet {
    Eigen::Matrix3f rotation;  // print_from_world
    Eigen::Vector3f translation;
    float half_width, half_height, reach, facing;
    cv::Mat_<cv::Vec2f> picture;
  };
  std::vector<Sheet> sheets_;
};

}  // namespace monocular_eye_hand
