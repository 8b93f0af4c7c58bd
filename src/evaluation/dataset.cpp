#include "monocular_eye_hand/evaluation/dataset.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "evaluation/json_file.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/grey_image.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Eigen::Matrix3d matrixAt(const json& value, const char* key, const std::string& where) {
  const auto numbers = numbersAt<9>(value, key, where);
  return Eigen::Map<const RowMajor3>(numbers.data());
}

std::string findImage(const fs::path& scene_dir, int id) {
  const std::string name = fmt::format("{:06}", id);
  for (const char* folder : {"gray", "rgb"})
    for (const char* extension : {".png", ".tif", ".tiff", ".jpg", ".jpeg"}) {
      const fs::path path = scene_dir / folder / (name + extension);
      if (fs::exists(path)) return path.string();
    }
  return "";
}

std::vector<GroundTruth> readTruth(const json& entries, const json* infos, const std::string& where) {
  if (!entries.is_array()) throw BadInput(where + ": a list of objects expected");
  if (infos && (!infos->is_array() || infos->size() != entries.size()))
    throw BadInput(where + ": scene_gt_info.json does not list the same objects");
  std::vector<GroundTruth> truth;
  for (size_t k = 0; k < entries.size(); ++k) {
    const std::string entry = fmt::format("{}, object {}", where, k);
    GroundTruth gt;
    gt.object = integerAt(entries[k], "obj_id", entry);
    gt.camera_from_object = {matrixAt(entries[k], "cam_R_m2c", entry),
                             numbersAt<3>(entries[k], "cam_t_m2c", entry) * kMetresPerMillimetre};
    if (infos) gt.visible = numberAt((*infos)[k], "visib_fract", entry + " (scene_gt_info.json)");
    truth.push_back(gt);
  }
  return truth;
}

std::optional<Rigid3> cameraFromWorld(const json& camera, const std::string& where) {
  if (!camera.contains("cam_R_w2c")) return std::nullopt;
  return Rigid3{matrixAt(camera, "cam_R_w2c", where),
                numbersAt<3>(camera, "cam_t_w2c", where) * kMetresPerMillimetre};
}

void readScene(const fs::path& dir, int scene, const std::set<int>& wanted, std::vector<BopImage>* images) {
  const std::string camera_path = (dir / "scene_camera.json").string(),
                    gt_path = (dir / "scene_gt.json").string();
  const json cameras = loadJson(camera_path), truths = loadJson(gt_path);
  const bool has_info = fs::exists(dir / "scene_gt_info.json");
  const json infos = has_info ? loadJson((dir / "scene_gt_info.json").string()) : json();
  if (!truths.is_object()) throw BadInput(gt_path + ": a map of image ids expected");

  for (const auto& item : truths.items()) {
    const std::string& key = item.key();
    BopImage image;
    image.scene = scene;
    image.id = numberOfName(key);
    if (image.id < 0) throw BadInput(gt_path + ": '" + key + "' is not an image id");
    if (!wanted.empty() && !wanted.count(image.id)) continue;
    if (!cameras.is_object() || !cameras.contains(key))
      throw BadInput(camera_path + ": image " + key + " is missing");
    if (has_info && !infos.contains(key))
      throw BadInput((dir / "scene_gt_info.json").string() + ": image " + key + " is missing");

    image.intrinsics = matrixAt(cameras[key], "cam_K", camera_path + ": image " + key);
    image.camera_from_world = cameraFromWorld(cameras[key], camera_path + ": image " + key);
    image.truth = readTruth(item.value(), has_info ? &infos[key] : nullptr, gt_path + ": image " + key);
    image.path = findImage(dir, image.id);
    images->push_back(std::move(image));
  }
}

// The width that MSPD's thresholds refer to: of the data set's camera.json, else of the images.
int imageWidth(const fs::path& dataset, const std::vector<BopImage>& images) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(dataset)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("camera", 0) == 0 && entry.path().extension() == ".json") files.push_back(entry.path());
  }
  if (!files.empty()) {
    const std::string path = std::min_element(files.begin(), files.end())->string();
    const int width = integerAt(loadJson(path), "width", path);
    if (width <= 0) throw BadInput(path + ": 'width' must be positive");
    return width;
  }
  for (const BopImage& image : images)
    if (!image.path.empty()) return loadBopImage(image).cols;
  throw BadInput(dataset.string() + ": no camera.json and no image: the width of the images is unknown");
}

}  // namespace

const BopImage* BopSplit::find(int scene, int id) const {
  const auto at = std::lower_bound(images.begin(), images.end(), std::make_pair(scene, id),
                                   [](const BopImage& image, const std::pair<int, int>& key) {
                                     return std::make_pair(image.scene, image.id) < key;
                                   });
  return at != images.end() && at->scene == scene && at->id == id ? &*at : nullptr;
}

BopSplit loadBopSplit(const std::string& dataset_dir, const std::string& split,
                      const std::vector<int>& scenes, const std::vector<int>& images) {
  const fs::path dir = fs::path(dataset_dir) / split;
  if (!fs::is_directory(dir))
    throw BadInput(dir.string() + ": no such folder (a split of a BOP data set expected)");

  std::set<int> left(scenes.begin(), scenes.end());
  const std::set<int> wanted_images(images.begin(), images.end());
  BopSplit result;
  for (const auto& entry : fs::directory_iterator(dir)) {
    const int scene = numberOfName(entry.path().filename().string());
    if (scene < 0 || !entry.is_directory()) continue;
    if (!scenes.empty() && std::find(scenes.begin(), scenes.end(), scene) == scenes.end()) continue;
    left.erase(scene);
    readScene(entry.path(), scene, wanted_images, &result.images);
  }

  if (!left.empty()) throw BadInput(fmt::format("{}: there is no scene {}", dir.string(), *left.begin()));
  if (result.images.empty()) throw BadInput(dir.string() + ": no image with ground truth to evaluate");
  std::sort(result.images.begin(), result.images.end(), [](const BopImage& a, const BopImage& b) {
    return std::make_pair(a.scene, a.id) < std::make_pair(b.scene, b.id);
  });
  result.width = imageWidth(dataset_dir, result.images);
  return result;
}

std::vector<BopTarget> loadBopTargets(const std::string& path) {
  const json entries = loadJson(path);
  if (!entries.is_array() || entries.empty()) throw BadInput(path + ": a list of targets expected");
  std::vector<BopTarget> targets;
  for (size_t k = 0; k < entries.size(); ++k) {
    const std::string where = fmt::format("{}: target {} (the form of test_targets_bop19.json)", path, k);
    targets.push_back({integerAt(entries[k], "scene_id", where), integerAt(entries[k], "im_id", where),
                       integerAt(entries[k], "obj_id", where), integerAt(entries[k], "inst_count", where)});
  }
  return targets;
}

std::vector<BopTarget> visibleTargets(const BopSplit& split, double min_visible) {
  std::vector<BopTarget> targets;
  for (const BopImage& image : split.images) {
    std::map<int, int> counts;
    for (const GroundTruth& gt : image.truth)
      if (gt.visible >= min_visible) ++counts[gt.object];
    for (const auto& count : counts) targets.push_back({image.scene, image.id, count.first, count.second});
  }
  return targets;
}

cv::Mat loadBopImage(const BopImage& image) {
  const std::string name = fmt::format("scene {}, image {}", image.scene, image.id);
  if (image.path.empty()) throw BadInput(name + ": no image file in gray/ or rgb/");
  return loadGreyImage(image.path);
}

Camera bopCamera(const BopImage& image, int width, int height) {
  const Eigen::Matrix3d& k = image.intrinsics;
  const std::string where = fmt::format("scene {}, image {}", image.scene, image.id);
  if (k(0, 1) != 0 || k(1, 0) != 0 || k(2, 0) != 0 || k(2, 1) != 0 || k(2, 2) != 1)
    throw BadInput(where + ": cam_K is not of the form fx 0 cx, 0 fy cy, 0 0 1 (skew is not supported)");
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = k(0, 0);
  camera.fy = k(1, 1);
  camera.cx = k(0, 2);
  camera.cy = k(1, 2);
  try {
    camera.check();
  } catch (const BadInput& e) {
    throw BadInput(where + ": " + e.what());
  }
  return camera;
}

}  // namespace monocular_eye_hand
