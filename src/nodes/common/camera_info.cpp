#include "nodes/common/camera_info.h"

#include <algorithm>

namespace monocular_eye_hand {

ImageCalibration fromMessage(const sensor_msgs::CameraInfo& message) {
  ImageCalibration out;
  out.width = int(message.width);
  out.height = int(message.height);
  out.distortion_model = message.distortion_model;
  out.d = message.D;
  std::copy(message.K.begin(), message.K.end(), out.k.begin());
  std::copy(message.R.begin(), message.R.end(), out.r.begin());
  std::copy(message.P.begin(), message.P.end(), out.p.begin());

  const sensor_msgs::RegionOfInterest& roi = message.roi;
  out.binning_x = int(message.binning_x);
  out.binning_y = int(message.binning_y);
  out.region = {int(roi.x_offset), int(roi.y_offset), int(roi.width), int(roi.height), bool(roi.do_rectify)};
  return out;
}

sensor_msgs::CameraInfo toMessage(const ImageCalibration& calibration) {
  sensor_msgs::CameraInfo message;
  message.width = uint32_t(calibration.width);
  message.height = uint32_t(calibration.height);
  message.distortion_model = calibration.distortion_model;
  message.D = calibration.d;
  std::copy(calibration.k.begin(), calibration.k.end(), message.K.begin());
  std::copy(calibration.r.begin(), calibration.r.end(), message.R.begin());
  std::copy(calibration.p.begin(), calibration.p.end(), message.P.begin());
  return message;
}

}  // namespace monocular_eye_hand
