#pragma once
#include <array>
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/camera_file.h"

namespace monocular_eye_hand {

/// A calibration that is missing or cannot be used; the message says what is wrong with it.
class BadCameraInfo : public BadInput {
 public:
  using BadInput::BadInput;
};

enum class ImageKind {
  kRaw,        ///< as taken: K and D hold
  kRectified,  ///< image_rect: P holds, no distortion
};

/// The calibration that comes with an image, as sensor_msgs/CameraInfo has it (REP-104); nothing is checked
/// yet. Sizes and offsets in pixels of the whole sensor.
struct ImageCalibration {
  int width = 0, height = 0;
  std::string distortion_model;
  std::vector<double> d;
  std::array<double, 9> k{}, r{};
  std::array<double, 12> p{};
  int binning_x = 0, binning_y = 0;  ///< 0: as 1
  /// The part of the sensor that the image shows; without size: all of it.
  struct Region {
    int x = 0, y = 0, width = 0, height = 0;
    bool do_rectify = false;  ///< the rectified image has a part of its own
  };
  Region region;
};

/// The camera of an image of `width` x `height` pixels that came with this calibration. Binning and region of
/// interest are taken into account: a binned pixel is the mean of its block, so its centre lies at the
/// block's centre. Throws BadCameraInfo on an uncalibrated, implausible or non-finite calibration, an
/// unsupported distortion model, a right-hand stereo projection, and when the sizes of image and calibration
/// differ.
Camera cameraOf(const ImageCalibration& calibration, ImageKind kind, int width, int height);
/// The camera of an image of the size that the calibration says.
Camera cameraOf(const ImageCalibration& calibration, ImageKind kind);

/// The calibration of raw images of this camera. image_rect of it has the same fx, fy, cx, cy.
ImageCalibration calibrationOf(const Camera& camera);
/// The same of a calibration file, with the rectification and projection that it writes.
ImageCalibration calibrationOf(const CameraFile& file);

}  // namespace monocular_eye_hand
