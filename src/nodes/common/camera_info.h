#pragma once
#include <sensor_msgs/CameraInfo.h>

#include <string>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/camera_file.h"

namespace monocular_eye_hand {

/// A CameraInfo that is missing or cannot be used; the message says what is wrong with it.
class BadCameraInfo : public BadInput {
 public:
  using BadInput::BadInput;
};

enum class ImageKind {
  kRaw,        ///< as taken: K and D hold
  kRectified,  ///< image_rect: P holds, no distortion
};

/// The camera of an image of `width` x `height` pixels that came with `info` (REP-104). Binning and region of
/// interest are taken into account: a binned pixel is the mean of its block, so its centre lies at the
/// block's centre. Throws BadCameraInfo on an uncalibrated, implausible or non-finite calibration, an
/// unsupported distortion model, a right-hand stereo projection, and when the sizes of image and calibration
/// differ.
Camera cameraFromInfo(const sensor_msgs::CameraInfo& info, ImageKind kind, int width, int height);
/// The camera of an image of the size that `info` says.
Camera cameraFromInfo(const sensor_msgs::CameraInfo& info, ImageKind kind);

/// The calibration of a raw image of this camera; its header is left to the caller. image_rect of it has the
/// same fx, fy, cx, cy.
sensor_msgs::CameraInfo toCameraInfo(const Camera& camera);
/// The same of a calibration file, with the rectification and projection that it writes.
sensor_msgs::CameraInfo toCameraInfo(const CameraFile& file);

}  // namespace monocular_eye_hand
