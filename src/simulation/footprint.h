#pragma once
#include <opencv2/core.hpp>

#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

/// What an object covers of the table, seen from above.
struct Footprint {
  cv::Mat1b mask;    ///< 255 where covered
  cv::Point corner;  ///< grid cell of the mask's first pixel
};
constexpr double kCell = 0.001;  ///< [m]

Footprint footprint(const SceneObject& object, double grow = 0);
/// Cells that both cover.
int sharedCells(const Footprint& a, const Footprint& b);

}  // namespace monocular_eye_hand
