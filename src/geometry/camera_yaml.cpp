#include <yaml-cpp/yaml.h>

#include <cmath>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

std::vector<double> readMatrix(const YAML::Node& root, const std::string& key, size_t rows, size_t cols) {
  const YAML::Node node = root[key];
  if (!node || !node["data"]) throw BadInput("'" + key + "' with 'data' is missing");
  const auto data = node["data"].as<std::vector<double>>();
  if (rows > 0 && data.size() != rows * cols)
    throw BadInput("'" + key + "' has " + std::to_string(data.size()) + " numbers, " +
                   std::to_string(rows * cols) + " expected");
  for (double v : data)
    if (!std::isfinite(v)) throw BadInput("'" + key + "' holds a value that is not finite");
  return data;
}

}  // namespace

Camera loadCamera(const std::string& yaml_path) {
  try {
    const YAML::Node root = YAML::LoadFile(yaml_path);
    if (!root.IsMap()) throw BadInput("not a map: expected the YAML of camera_calibration");
    Camera camera;
    for (const char* key : {"image_width", "image_height"})
      if (!root[key]) throw BadInput(std::string("'") + key + "' is missing");
    camera.width = root["image_width"].as<int>();
    camera.height = root["image_height"].as<int>();
    const std::vector<double> k = readMatrix(root, "camera_matrix", 3, 3);
    if (k[1] != 0 || k[3] != 0 || k[6] != 0 || k[7] != 0 || k[8] != 1)
      throw BadInput("'camera_matrix' is not of the form [fx 0 cx; 0 fy cy; 0 0 1], row by row");
    camera.fx = k[0], camera.cx = k[2], camera.fy = k[4], camera.cy = k[5];
    if (root["distortion_coefficients"]) {
      const std::vector<double> d = readMatrix(root, "distortion_coefficients", 0, 0);
      const std::string model =
          root["distortion_model"] ? root["distortion_model"].as<std::string>() : std::string();
      setDistortion(&camera, model, d.data(), d.size());
    }
    camera.check();
    return camera;
  } catch (const BadInput& e) {
    throw BadInput(yaml_path + ": " + e.what());
  } catch (const YAML::BadFile&) {
    throw BadInput(yaml_path + ": cannot be read (camera calibration YAML expected)");
  } catch (const YAML::Exception& e) {
    throw BadInput(yaml_path + ": " + e.what());
  }
}

}  // namespace monocular_eye_hand
