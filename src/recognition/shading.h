#pragma once
#include <Eigen/Core>
#include <vector>

namespace monocular_eye_hand {

/// A pixel of a drawn face: its grey and which way the face looks.
struct ShadedPixel {
  Eigen::Vector3f normal;  ///< outward, unit, camera frame
  float grey = 0;
};

/// Share (at most 1, of noise below 0) of the greys' spread that ambient light and one distant light explain:
/// matt faces that look the same way look the same, grey = a + b . normal (the linear part of Basri and
/// Jacobs, Lambertian reflectance and linear subspaces, 2003). Fitted robustly: a shadow or a highlight does
/// not bend it. 0 of too few pixels.
double shadingExplained(const std::vector<ShadedPixel>& pixels);

}  // namespace monocular_eye_hand
