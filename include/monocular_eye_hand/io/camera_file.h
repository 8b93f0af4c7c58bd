#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"

namespace monocular_eye_hand {

/// CameraFile::kind of the YAML that camera_calibration and camera_info_manager write.
constexpr char kRosYamlKind[] = "YAML of camera_calibration";

/// A camera calibration as a file holds it.
struct CameraFile {
  Camera camera;     ///< of the images as taken, in pixels
  std::string kind;  ///< what the file is: "YAML of camera_calibration", "kalibr camchain", ...
  std::string name;  ///< of the camera, when the file gives one
  std::optional<std::array<double, 9>> rectification;  ///< rows of rectified_from_camera, when it is written
  std::optional<std::array<double, 12>> projection;    ///< rows of the rectified camera's matrix, in pixels
  std::vector<std::string> warnings;                   ///< what was ignored or looks wrong, without the path
};

/// Reads a calibration, told apart by content: the YAML and the ost.ini of camera_calibration, OpenCV's
/// FileStorage (YAML, XML or JSON), a CameraInfo as rostopic echo prints it (binning and region of interest
/// are taken into account), kalibr's camchain of one camera, ViSP's XML. `path` as in io/file_path.h. Throws
/// BadInput that names the file, its kind and what to do.
CameraFile readCameraFile(const std::string& path);

/// Warnings about a camera that may be used but looks wrong: a principal point far from the middle, as
/// binning and cropping leave it when the calibration was made without them.
std::vector<std::string> cameraWarnings(const Camera& camera);

/// The camera of such a file alone; its warnings are dropped.
Camera loadCamera(const std::string& path);

}  // namespace monocular_eye_hand
