#include "monocular_eye_hand/simulation/render/truth.h"

#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

using Json = nlohmann::ordered_json;

std::ofstream openToWrite(const std::string& path) {
  std::ofstream file(path);
  if (!file) throw BadInput(path + ": cannot be written; does the folder exist?");
  file << std::setprecision(12);
  return file;
}

TruthObject parseObject(const Json& node) {
  TruthObject object;
  object.name = node.at("name").get<std::string>();
  object.model = node.value("model", -1);
  const auto rotation = node.at("cam_R_m2c").get<std::vector<double>>();
  const auto translation = node.at("cam_t_m2c").get<std::vector<double>>();
  if (rotation.size() != 9 || translation.size() != 3)
    throw BadInput("object '" + object.name + "': 9 numbers in cam_R_m2c and 3 in cam_t_m2c expected");
  for (int k = 0; k < 9; ++k) object.camera_from_object.rotation(k / 3, k % 3) = rotation[k];
  for (int k = 0; k < 3; ++k) object.camera_from_object.translation[k] = translation[k] / 1000;
  object.visible_fraction = node.value("visib_fract", 1.0);
  if (node.contains("bbox_visib")) {
    const auto box = node["bbox_visib"].get<std::vector<int>>();
    if (box.size() != 4) throw BadInput("object '" + object.name + "': 4 numbers in bbox_visib expected");
    object.box_visible = {box[0], box[1], box[2], box[3]};
  }
  return object;
}

}  // namespace

std::vector<TruthObject> truthOf(const Scene& scene, const RenderedImage& image) {
  std::vector<TruthObject> out;
  for (size_t k = 0; k < scene.objects.size(); ++k) {
    const SceneObject& object = scene.objects[k];
    if (object.model < 0) continue;
    out.push_back({object.name, object.model, scene.cameraFromObject(int(k)), image.objects[k].fraction,
                   image.objects[k].box_visible});
  }
  return out;
}

void writeTruth(const std::string& path, const std::vector<TruthObject>& objects) {
  Json list = Json::array();
  for (const TruthObject& object : objects) {
    Json node;
    node["name"] = object.name;
    node["model"] = object.model;

    std::vector<double> rotation(9), translation(3);
    for (int k = 0; k < 9; ++k) rotation[k] = object.camera_from_object.rotation(k / 3, k % 3);
    for (int k = 0; k < 3; ++k) translation[k] = object.camera_from_object.translation[k] * 1000;
    node["cam_R_m2c"] = rotation;
    node["cam_t_m2c"] = translation;

    node["visib_fract"] = object.visible_fraction;
    const cv::Rect& box = object.box_visible;
    node["bbox_visib"] = {box.x, box.y, box.width, box.height};
    list.push_back(node);
  }

  Json root;
  root["objects"] = list;
  std::ofstream file = openToWrite(path);
  file << root.dump(1) << "\n";
  if (!file.flush()) throw BadInput(path + ": cannot be written");
}

std::vector<TruthObject> readTruth(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw BadInput(path + ": cannot be read (truth JSON expected)");
  try {
    std::vector<TruthObject> out;
    const Json root = Json::parse(file);
    for (const Json& node : root.at("objects")) out.push_back(parseObject(node));
    return out;
  } catch (const Json::exception& e) {
    throw BadInput(path + ": " + e.what());
  } catch (const BadInput& e) {
    throw BadInput(path + ": " + e.what());
  }
}

void writeCamera(const std::string& path, const Camera& camera, const std::string& name) {
  std::ofstream file = openToWrite(path);
  const std::string lens = distortionName(camera);
  const int count = distortionCount(camera);
  file << "image_width: " << camera.width << "\nimage_height: " << camera.height << "\ncamera_name: " << name
       << "\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: [" << camera.fx << ", 0, " << camera.cx << ", 0, "
       << camera.fy << ", " << camera.cy << ", 0, 0, 1]\ndistortion_model: " << lens
       << "\ndistortion_coefficients:\n  rows: 1\n  cols: " << count << "\n  data: [";
  for (int k = 0; k < count; ++k) file << (k ? ", " : "") << camera.d[k];
  file << "]\nrectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]"
       << "\nprojection_matrix:\n  rows: 3\n  cols: 4\n  data: [" << camera.fx << ", 0, " << camera.cx
       << ", 0, 0, " << camera.fy << ", " << camera.cy << ", 0, 0, 0, 1, 0]\n";
  if (!file.flush()) throw BadInput(path + ": cannot be written");
}

}  // namespace monocular_eye_hand
