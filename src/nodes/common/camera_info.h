#pragma once
#include <sensor_msgs/CameraInfo.h>

#include "monocular_eye_hand/io/image_calibration.h"

namespace monocular_eye_hand {

ImageCalibration fromMessage(const sensor_msgs::CameraInfo& message);
/// Its header is left to the caller.
sensor_msgs::CameraInfo toMessage(const ImageCalibration& calibration);

}  // namespace monocular_eye_hand
