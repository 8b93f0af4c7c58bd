#include "tools/offline_files.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/options/options.h"
#include "tools/package_files.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;

// Keys that only the nodes need.
const std::vector<std::string> kOfRecognizer{"objects",         "rectified",       "continuous",
                                             "on_request",      "frame_prefix",    "camera_frame",
                                             "image_transport", "service_timeout", "marker_triangles",
                                             "label_height",    "marker_lifetime", "diagnostic_period"};
const std::vector<std::string> kOfEyeHand{"objects",
                                          "urdf",
                                          "base_frame",
                                          "tool_frame",
                                          "joint_names",
                                          "rectified",
                                          "wait",
                                          "memory",
                                          "max_joint_gap",
                                          "max_joint_age",
                                          "max_tf_distance",
                                          "max_tf_turn",
                                          "max_waiting",
                                          "table_height",
                                          "table_frame",
                                          "still",
                                          "marker_triangles",
                                          "label_height",
                                          "diagnostic_period"};
const std::vector<std::string> kOfPlanner{"base_frame", "diagnostic_period"};
const std::vector<std::string> kOfTask{"objects",      "cache",          "urdf",           "base_frame",
                                       "look_timeout", "answer_timeout", "motion_timeout", "state_max_age"};

struct RecognizerSupport {
  std::string frame;
  double height = 0, wait = 0;  // the cell's own table counts
  double tolerance = SupportPlane().tolerance;

  template <class Visitor>
  void visit(Visitor&& v) {
    v("frame", frame);
    v("height", height);
    v("tolerance", tolerance);
    v("wait", wait);
  }
};

struct RecognizerFile {
  std::string cache;
  RecognizerSupport support;
  ObjectTrackerOptions instances;
  RecognitionOptions recognition;

  template <class Visitor>
  void visit(Visitor&& v) {
    v("cache", cache);
    v("support", support);
    v("instances", instances);
    v("recognition", recognition);
  }
};

/// Sets what the file says, without the keys that only the node knows.
template <class Options>
void read(const std::string& path, const std::vector<std::string>& of_node, Options* options) {
  OptionTree tree = loadYaml(path);
  auto& map = tree.map;
  const auto node_only = [&](const auto& entry) {
    return std::find(of_node.begin(), of_node.end(), entry.first) != of_node.end();
  };
  map.erase(std::remove_if(map.begin(), map.end(), node_only), map.end());

  try {
    readOptions(tree, options);
  } catch (const BadInput& e) {
    throw BadInput(path + ": " + e.what());
  }
}

std::string either(const std::string& given, const fs::path& otherwise) {
  return given.empty() ? otherwise.string() : given;
}

fs::path configFolder(const OfflineFiles& files) {
  return files.config.empty() ? fs::path(packageFolder()) / "config" : fs::path(files.config);
}

}  // namespace

std::string objectsFile(const OfflineFiles& files) {
  return files.objects.empty() ? (configFolder(files) / "objects.yaml").string() : files.objects;
}

OfflineOptions readOfflineFiles(const OfflineFiles& files) {
  const fs::path config = configFolder(files);
  OfflineOptions options;
  RecognizerFile recognizer;
  read((config / "recognizer.yaml").string(), kOfRecognizer, &recognizer);
  options.cache = recognizer.cache;
  options.recognition = recognizer.recognition;
  options.instances = recognizer.instances;
  options.support_tolerance = recognizer.support.tolerance;

  read((config / "eye_hand.yaml").string(), kOfEyeHand, &options.grasping);
  read((config / "task.yaml").string(), kOfTask, &options.task);
  read(either(files.cell, config / "cell.yaml"), {}, &options.cell);

  options.executor.objects = objectsFile(files);
  options.executor.urdf =
      files.urdf.empty() ? (fs::path(packageFolder()) / "urdf" / "puma560.urdf").string() : files.urdf;
  read((config / "planner.yaml").string(), kOfPlanner, &options.executor);
  options.executor.table.z = options.cell.table.pose.z;
  return options;
}

}  // namespace monocular_eye_hand
