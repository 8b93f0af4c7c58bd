#pragma once
#include <Eigen/Core>
#include <array>
#include <string>

namespace monocular_eye_hand {

enum class DistortionModel { kNone, kPlumbBob, kRationalPolynomial, kEquidistant };

/// A raw pixel with its derivative to the rectified one.
struct DistortedPixel {
  Eigen::Vector2d uv_raw;
  Eigen::Matrix2d jacobian;  ///< d uv_raw / d uv_rect
};

/// A part of the image that is published alone, in whole blocks of pixels (REP-104).
struct PixelWindow {
  int x = 0, y = 0;           ///< first pixel [px]
  int width = 0, height = 0;  ///< before binning [px]
  int bin_x = 1, bin_y = 1;   ///< pixels that become one
};

/// Pinhole camera with lens distortion. Camera frame: optical (x right, y down, z forward, metres). Pixel
/// centres lie at integer coordinates. `uv_raw` is a pixel of the image as taken, `uv_rect` the pixel where
/// an ideal pinhole with the same fx, fy, cx, cy would see the same ray; without distortion they are equal.
struct Camera {
  int width = 0;                          ///< pixels
  int height = 0;                         ///< pixels
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< pixels
  DistortionModel model = DistortionModel::kNone;
  std::array<double, 8> d{};  ///< k1, k2, p1, p2, k3 to k6 (OpenCV's order); equidistant: k1 to k4

  bool distorted() const;
  /// Pinhole projection of a point with z > 0.
  Eigen::Vector2d project(const Eigen::Vector3d& p_in_camera) const {
    return {fx * p_in_camera.x() / p_in_camera.z() + cx, fy * p_in_camera.y() / p_in_camera.z() + cy};
  }
  /// Direction through a rectified pixel, scaled to z = 1.
  Eigen::Vector3d ray(const Eigen::Vector2d& uv_rect) const {
    return {(uv_rect.x() - cx) / fx, (uv_rect.y() - cy) / fy, 1.0};
  }
  Eigen::Vector2d distort(const Eigen::Vector2d& uv_rect) const;
  DistortedPixel distortWithJacobian(const Eigen::Vector2d& uv_rect) const;
  /// Inverse of distort by Newton's method, to 1e-10 px inside the region where the model is one-to-one (of
  /// an equidistant lens up to 87 degrees off the axis, where the result stays for what lies beyond).
  Eigen::Vector2d undistort(const Eigen::Vector2d& uv_raw) const;
  Eigen::Matrix3d intrinsics() const;
  /// The same camera with an image resized by `factor` (pixel centres stay at integers).
  Camera resized(double factor) const;
  /// The camera of an image that shows only this window. A binned pixel is the mean of its block, so its
  /// centre lies at the block's centre. Throws BadInput when the window leaves the image or leaves out the
  /// principal point.
  Camera seenThrough(const PixelWindow& window) const;
  /// Throws BadInput naming the field when a value is missing, not finite or implausible (fx or fy below a
  /// fifth of the image's width, principal point outside the image, unknown distortion).
  void check() const;
};

/// Sets the lens from the name of its model as ROS, kalibr or a driver spells it ("plumb_bob", "radtan",
/// "rational_polynomial", "equidistant", "none" or empty) and coefficients of any length that the model
/// allows; zeros behind them are taken. Throws BadInput naming the model and what to do.
void setDistortion(Camera* camera, const std::string& name, const double* coefficients, size_t count);

/// The ROS name of the camera's lens model ("plumb_bob" of one without distortion) and how many of its
/// coefficients count.
std::string distortionName(const Camera& camera);
int distortionCount(const Camera& camera);

}  // namespace monocular_eye_hand
