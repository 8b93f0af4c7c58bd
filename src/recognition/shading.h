#pragma once
#include <Eigen/Core>
#include <vector>

namespace monocular_eye_hand {

/// A pixel of a drawn face: its grey and which way the face looks.
struct ShadedPixel {
  Eigen::Vector3f normal;  ///< outward, unit, camera frame
  float grey = 0;
};

/// Ambient light and one distant light on matt faces: grey = grey of a + b . normal (the linear part of Basri
/// and Jacobs, Lambertian reflectance and linear subspaces, 2003).
struct FittedLight {
  Eigen::Vector4d light = Eigen::Vector4d::Zero();  ///< a, b
  double residual = 0;                              ///< median of the absolute residuals [grey levels]
  double grey(const Eigen::Vector3f& normal) const {
    return light[0] + light.tail<3>().dot(normal.cast<double>());
  }
};

/// Fitted robustly: a shadow or a highlight does not bend it. The pixels must not be empty.
FittedLight fitLight(const std::vector<ShadedPixel>& pixels);

/// Share (at most 1, of noise below 0) of the greys' spread that the fitted light explains: matt faces that
/// look the same way look the same. 0 of too few pixels.
double shadingExplained(const std::vector<ShadedPixel>& pixels);

}  // namespace monocular_eye_hand
