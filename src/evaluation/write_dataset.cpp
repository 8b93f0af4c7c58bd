#include "monocular_eye_hand/evaluation/write_dataset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <limits>
#include <locale>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <sstream>

#include "evaluation/json_file.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
constexpr double kMillimetresPerMetre = 1e3;
constexpr double kMinTargetVisible = 0.1;  // of an instance that a target asks for (BOP'19)

std::string sixDigits(int number) { return fmt::format("{:06}", number); }

void makeFolder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw BadInput(path.string() + ": cannot be made: " + error.message());
}

std::string contentOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Whole or not at all: a reader never meets half a file.
void writeFile(const fs::path& path, const std::string& text) {
  const fs::path unfinished = path.string() + ".part";
  std::ofstream file(unfinished, std::ios::binary);
  file << text;
  file.close();
  std::error_code error;
  if (file) fs::rename(unfinished, path, error);
  if (!file || error) throw BadInput(path.string() + ": cannot be written");
}

void writeOrCompare(const fs::path& path, const std::string& text) {
  if (!fs::exists(path)) return writeFile(path, text);
  if (contentOf(path) != text)
    throw BadInput(path.string() + ": holds another model; write the data set into a new folder");
}

// One member per line: long lists stay readable and diffs small.
std::string linesOf(const Json& map) {
  std::string text = "{\n";
  size_t left = map.size();
  for (const auto& item : map.items())
    text += "  \"" + item.key() + "\": " + item.value().dump() + (--left > 0 ? ",\n" : "\n");
  return text + "}\n";
}

Json rowByRow(const Eigen::Matrix3d& matrix) {
  Json numbers = Json::array();
  for (int k = 0; k < 9; ++k) numbers.push_back(matrix(k / 3, k % 3));
  return numbers;
}

Json inMillimetres(const Eigen::Vector3d& metres) {
  Json numbers = Json::array();
  for (int k = 0; k < 3; ++k) numbers.push_back(metres[k] * kMillimetresPerMetre);
  return numbers;
}

// Rounding errors around zero are nothing to publish.
double tidy(double value) { return std::abs(value) < 1e-9 ? 0 : value; }

Json matrix4(const Rigid3& motion) {
  Json numbers = Json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) numbers.push_back(tidy(motion.rotation(row, column)));
    numbers.push_back(tidy(motion.translation[row] * kMillimetresPerMetre));
  }
  for (const double last : {0.0, 0.0, 0.0, 1.0}) numbers.push_back(last);
  return numbers;
}

Json modelInfo(const ObjectModel& model) {
  Json info;
  info["name"] = model.name;
  info["diameter"] = model.diameter * kMillimetresPerMetre;

  static const char* kAxes[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k) {
    info[std::string("min_") + kAxes[k]] = model.bounds.min()[k] * kMillimetresPerMetre;
    info[std::string("size_") + kAxes[k]] = model.bounds.sizes()[k] * kMillimetresPerMetre;
  }

  const BopSymmetries symmetries = bopSymmetries(model);
  for (const Rigid3& motion : symmetries.discrete) info["symmetries_discrete"].push_back(matrix4(motion));
  for (const SymmetryAxis& axis : symmetries.continuous)
    info["symmetries_continuous"].push_back(
        {{"axis", {axis.direction.x(), axis.direction.y(), axis.direction.z()}},
         {"offset", inMillimetres(axis.point)}});
  return info;
}

std::string plyOf(const Mesh& mesh) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(std::numeric_limits<float>::max_digits10) << "ply\nformat ascii 1.0\n"
       << "element vertex " << mesh.vertices.size()
       << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.triangles.size()
       << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Eigen::Vector3d& p : mesh.vertices) {
    const Eigen::Vector3d mm = p * kMillimetresPerMetre;
    text << mm.x() << " " << mm.y() << " " << mm.z() << "\n";
  }
  for (const auto& t : mesh.triangles) text << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
  return text.str();
}

// The number at the end of a name; -1 when there is none.
int lastNumber(const std::string& name) {
  const size_t before = name.find_last_not_of("0123456789");
  return numberOfName(before == std::string::npos ? name : name.substr(before + 1));
}

Json truthOf(const WrittenImage& image) {
  Json list = Json::array();
  for (const WrittenTruth& object : image.truth)
    list.push_back({{"cam_R_m2c", rowByRow(object.truth.camera_from_object.rotation)},
                    {"cam_t_m2c", inMillimetres(object.truth.camera_from_object.translation)},
                    {"obj_id", object.truth.object}});
  return list;
}

Json infoOf(const WrittenImage& image) {
  Json list = Json::array();
  for (const WrittenTruth& object : image.truth) {
    const cv::Rect& box = object.box_visible;
    list.push_back({{"bbox_visib", {box.x, box.y, box.width, box.height}},
                    {"px_count_all", object.pixels_all},
                    {"px_count_visib", object.pixels_visible},
                    {"visib_fract", object.truth.visible}});
  }
  return list;
}

Json cameraOf(const WrittenImage& image) {
  const Camera& camera = image.camera;
  Eigen::Matrix3d k;
  k << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  Json out = {{"cam_K", rowByRow(k)}, {"depth_scale", 1.0}};
  if (!image.camera_from_world) return out;

  out["cam_R_w2c"] = rowByRow(image.camera_from_world->rotation);
  out["cam_t_w2c"] = inMillimetres(image.camera_from_world->translation);
  return out;
}

std::vector<BopTarget> targetsOf(int scene, const std::vector<WrittenImage>& images) {
  std::vector<BopTarget> targets;
  for (const WrittenImage& image : images) {
    std::map<int, int> counts;
    for (const WrittenTruth& object : image.truth)
      if (object.truth.visible >= kMinTargetVisible) ++counts[object.truth.object];
    for (const auto& count : counts) targets.push_back({scene, image.id, count.first, count.second});
  }
  return targets;
}

}  // namespace

std::vector<int> bopIds(const std::vector<std::string>& names) {
  std::vector<int> ids;
  for (const std::string& name : names) ids.push_back(lastNumber(name));

  const std::set<int> distinct(ids.begin(), ids.end());
  const bool usable = distinct.size() == ids.size() && (ids.empty() || *distinct.begin() > 0);
  if (!usable)
    for (size_t k = 0; k < ids.size(); ++k) ids[k] = int(k) + 1;
  return ids;
}

BopSymmetries bopSymmetries(const ObjectModel& model) {
  const Symmetries& known = model.symmetries;
  BopSymmetries out;
  for (size_t k = 1; k < known.discrete.size(); ++k) out.discrete.push_back(known.discrete[k]);
  if (known.axis) out.continuous.push_back(*known.axis);
  if (known.sphere) {
    out.continuous.clear();
    for (int k = 0; k < 3; ++k) out.continuous.push_back({model.centre(), Eigen::Vector3d::Unit(k)});
  }
  return out;
}

void writeBopModels(const std::string& dataset_dir, const std::vector<BopPart>& parts) {
  const fs::path folder = fs::path(dataset_dir) / "models";
  makeFolder(folder);
  std::map<int, Json> infos;
  for (const BopPart& part : parts) {
    if (part.id < 1 || !infos.emplace(part.id, modelInfo(part.model)).second)
      throw BadInput(fmt::format("object '{}': the id {} is taken or below 1", part.model.name, part.id));
    writeOrCompare(folder / ("obj_" + sixDigits(part.id) + ".ply"), plyOf(part.model.mesh));
  }

  Json all;
  for (const auto& info : infos) all[std::to_string(info.first)] = info.second;
  writeOrCompare(folder / "models_info.json", linesOf(all));
}

void writeBopCamera(const std::string& dataset_dir, const Camera& camera) {
  makeFolder(dataset_dir);
  const fs::path path = fs::path(dataset_dir) / "camera.json";
  if (fs::exists(path)) return;
  writeFile(path, linesOf({{"width", camera.width},
                           {"height", camera.height},
                           {"fx", camera.fx},
                           {"fy", camera.fy},
                           {"cx", camera.cx},
                           {"cy", camera.cy},
                           {"depth_scale", 1.0}}));
}

BopSceneWriter::BopSceneWriter(const std::string& dataset_dir, const std::string& split, int scene)
    : dataset_dir_(dataset_dir),
      split_(split),
      scene_dir_((fs::path(dataset_dir) / split / sixDigits(scene)).string()),
      scene_(scene) {
  makeFolder(fs::path(scene_dir_) / "gray");
}

void BopSceneWriter::add(const WrittenImage& image, const cv::Mat& grey) {
  const std::string path = (fs::path(scene_dir_) / "gray" / (sixDigits(image.id) + ".png")).string();
  if (image.camera.distorted()) throw BadInput(path + ": a BOP camera has no distortion; undistort first");
  if (grey.cols != image.camera.width || grey.rows != image.camera.height)
    throw BadInput(path + ": image and camera have different sizes");
  if (!cv::imwrite(path, grey)) throw BadInput(path + ": cannot be written");
  images_.push_back(image);
}

void BopSceneWriter::finish() const {
  Json cameras = Json::object(), truths = Json::object(), infos = Json::object();
  for (const WrittenImage& image : images_) {
    const std::string key = std::to_string(image.id);
    cameras[key] = cameraOf(image);
    truths[key] = truthOf(image);
    infos[key] = infoOf(image);
  }
  const fs::path folder = scene_dir_;
  writeFile(folder / "scene_camera.json", linesOf(cameras));
  writeFile(folder / "scene_gt.json", linesOf(truths));
  writeFile(folder / "scene_gt_info.json", linesOf(infos));
  writeTargets();
}

void BopSceneWriter::writeTargets() const {
  const fs::path path = fs::path(dataset_dir_) / (split_ + "_targets_bop19.json");
  std::vector<BopTarget> targets = targetsOf(scene_, images_);
  if (fs::exists(path) && loadJson(path.string()).size() > 0)
    for (const BopTarget& other : loadBopTargets(path.string()))
      if (other.scene != scene_) targets.push_back(other);
  std::stable_sort(targets.begin(), targets.end(),
                   [](const BopTarget& a, const BopTarget& b) { return a.scene < b.scene; });

  std::string text = "[";
  for (const BopTarget& target : targets) {
    const Json entry = {{"im_id", target.image},
                        {"inst_count", target.count},
                        {"obj_id", target.object},
                        {"scene_id", target.scene}};
    text += (text.size() > 1 ? ",\n  " : "\n  ") + entry.dump();
  }
  writeFile(path, text + "\n]\n");
}

}  // namespace monocular_eye_hand
