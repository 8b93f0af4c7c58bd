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

/// Share of the table area that two resting objects both cover, seen from above, as a share of the smaller
/// one (0: they stand side by side). Resolution about 1 mm.
double footprintOverlap(const SceneObject& a, const SceneObject& b);

}  // namespace monocular_eye_hand
