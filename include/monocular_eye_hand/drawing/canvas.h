#pragma once
#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/ellipse.h"

namespace monocular_eye_hand {

/// Blue, green, red.
using Colour = cv::Scalar;

/// Distinct colours for neighbouring indices, readable on grey.
Colour paletteColour(int index);

/// How large a picture becomes.
struct PictureSize {
  int min_width = 1200;   ///< smaller images are enlarged by a whole factor [px]
  int text_width = 1600;  ///< texts of wider pictures grow: they are readable when shown so wide [px]
};

/// The raw image in colour, enlarged by a whole factor when it is small. Everything is drawn in rectified
/// pixels (uv_rect) and appears where the lens shows it in the raw image, exact to 1/16 of a picture pixel.
/// Line widths and text heights are in picture pixels. What lies outside the picture is clipped.
class Canvas {
 public:
  /// `grey`: CV_8UC1 or CV_8UC3 of the camera's size. `dim`: 0..1, how much of the image's contrast is left.
  /// Throws BadInput when the image is empty, of another type, or of another size than the camera says.
  Canvas(const cv::Mat& grey, const Camera& camera, double dim = 1.0, const PictureSize& size = {});

  void line(const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Colour& colour, int width = 1);
  void polyline(const std::vector<Eigen::Vector2d>& points, bool closed, const Colour& colour, int width = 1);
  /// The part of the ellipse from eccentric angle `start` over `sweep` [rad].
  void arc(const Ellipse& ellipse, double start, double sweep, const Colour& colour, int width = 1);
  void ellipse(const Ellipse& ellipse, const Colour& colour, int width = 1);
  void dot(const Eigen::Vector2d& p, double radius, const Colour& colour);
  void arrow(const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Colour& colour, int width = 2);
  /// Text on a dark plate; its lower left corner at `p`, moved into the picture when it would leave it.
  void label(const Eigen::Vector2d& p, const std::string& text, const Colour& colour);
  /// Text at the top left of the picture, in as many lines as it needs.
  void caption(const std::string& text);

  const cv::Mat& picture() const { return picture_; }  ///< CV_8UC3
  int scale() const { return scale_; }                 ///< picture pixels per raw pixel
  const Camera& camera() const { return camera_; }
  /// Picture coordinates of a rectified pixel (pixel centres at integers in both).
  Eigen::Vector2d at(const Eigen::Vector2d& uv_rect) const;

 private:
  int strokeWidth() const;                           // of letters
  cv::Size textSize(const std::string& text) const;  // with the part below the line
  void textPlate(cv::Point lower_left, const std::string& text, const Colour& colour);

  cv::Mat picture_;
  Camera camera_;
  int scale_ = 1;
  double text_height_ = 0;
  double far_ = 0;  // rectified distance from the principal point beyond which the lens model folds back [px]
};

/// Writes a picture, into a new folder if need be. Throws BadInput naming the path when it cannot.
void writePicture(const std::string& path, const cv::Mat& picture);

}  // namespace monocular_eye_hand
