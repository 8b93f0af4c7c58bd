#pragma once
#include <opencv2/core.hpp>
#include <string>

namespace monocular_eye_hand {

/// An image file as 8-bit grey. Throws BadInput naming the file when it is missing, no image, or cut off
/// (OpenCV fills the rest of a truncated JPEG with grey and says nothing).
cv::Mat loadGreyImage(const std::string& path);

}  // namespace monocular_eye_hand
