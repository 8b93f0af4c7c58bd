#pragma once
#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/Image.h>

#include <string>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

/// An image message that cannot be used; the message says why.
class BadImage : public BadInput {
 public:
  using BadInput::BadInput;
};

/// The 8-bit grey image (CV_8UC1) of a message. mono8 shares the message's memory, no copy is made: the
/// result keeps the message alive. 16-bit grey is scaled from the bits in use: drivers put 10 or 12 bits at
/// the low end. Colour and Bayer images are converted. Throws BadImage on an empty or damaged image and on
/// any other encoding, naming those that are supported.
cv_bridge::CvImageConstPtr greyImage(const sensor_msgs::ImageConstPtr& message);

}  // namespace monocular_eye_hand
