#pragma once
#include <opencv2/core.hpp>

#include "monocular_eye_hand/geometry/camera.h"

namespace monocular_eye_hand {

/// An image and the camera that took it.
struct CameraImage {
  cv::Mat grey;  ///< CV_8UC1
  Camera camera;
};

/// Makes an image of an ideal pinhole camera look as if taken through `lens`, which has the same size and
/// intrinsics and a distortion: every raw pixel takes the grey value (bicubic) that the ideal image has at
/// its rectified pixel; beyond the ideal image its border is continued. Keeps the map of the last lens.
class LensWarp {
 public:
  /// Throws BadInput when the image has another size than the lens.
  cv::Mat apply(const cv::Mat& ideal, const Camera& lens);

 private:
  Camera lens_;
  cv::Mat map_;
};

/// The image resized by `factor` (bicubic up, area average down) and its camera with it.
CameraImage resized(const CameraImage& input, double factor);

}  // namespace monocular_eye_hand
