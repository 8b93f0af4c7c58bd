#pragma once
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

/// An image that cannot be used; the message says why.
class BadImage : public BadInput {
 public:
  using BadInput::BadInput;
};

/// An image as a camera's driver sends it; the bytes are somebody else's. Nothing is checked yet.
struct RawImage {
  std::string encoding;  ///< as in sensor_msgs/image_encodings.h
  int width = 0, height = 0;
  size_t step = 0;          ///< bytes from row to row
  bool big_endian = false;  ///< of pixels of 16 bits
  const uint8_t* data = nullptr;
  size_t size = 0;  ///< bytes
};

/// The 8-bit grey image (CV_8UC1). An 8-bit grey one shares the bytes, no copy is made: they must live as
/// long as the result. 16-bit grey is scaled from the bits in use: drivers put 10 or 12 bits at the low end.
/// Colour and Bayer images are converted. Throws BadImage on an empty or damaged image and on any other
/// encoding, naming those that are supported.
cv::Mat greyPixels(const RawImage& image);

}  // namespace monocular_eye_hand
