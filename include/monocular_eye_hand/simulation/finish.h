#pragma once
#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

// What makes a surface look real beyond albedo and highlight. Everything is off by default.

/// A picture on an object: print, label, handwriting, scratches. Projected along z of its frame onto the
/// surfaces that face it.
struct Print {
  Rigid3 object_from_print;  ///< origin in the picture's middle, x to its right, y to its top, z outwards
  double width = 0.05, height = 0.03;  ///< [m]
  double reach = 0.0005;               ///< colours what lies within this of its plane [m]
  double facing = 0.8;                 ///< ... and has a normal with at least this cosine to z
  cv::Mat_<cv::Vec2f> picture;         ///< albedo times cover, and cover (0..1), first row at the top
};

struct Finish {
  double gloss = 0;         ///< share of the light that is mirrored, seen straight on; grows when grazing
  double roughness = 0.03;  ///< spread of the mirrored directions (standard deviation of the slope)
  double brushed = 0;       ///< further spread across `brush_axis`: streaks as on ground metal
  Eigen::Vector3d brush_axis = Eigen::Vector3d::UnitX();  ///< object frame
  double translucency = 0;    ///< share of the light that comes from what lies behind
  double layer_loss = 0.12;   ///< ... of which every further surface of the object takes this away
  double edge_radius = 0;     ///< of the rounding that sharp edges show in their shading [m]
  double wear = 0;            ///< brighter (dirtier: below 0) albedo near convex edges, as a share of it
  double wear_width = 0.001;  ///< [m]
  std::vector<Print> prints;  ///< later ones lie on top
};

}  // namespace monocular_eye_hand
