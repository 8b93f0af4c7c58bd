#include "tools/offline_files.h"

#include <filesystem>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/options/options.h"
#include "monocular_eye_hand/parameters/eye_hand.h"
#include "monocular_eye_hand/parameters/planner.h"
#include "monocular_eye_hand/parameters/recognizer.h"
#include "monocular_eye_hand/parameters/task.h"
#include "tools/package_files.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;

/// `parameters` with what the file sets.
template <class Parameters>
Parameters withFile(Parameters parameters, const std::string& path) {
  try {
    readOptions(loadYaml(path), &parameters);
  } catch (const BadInput& e) {
    throw BadInput(path + ": " + e.what());
  }
  return parameters;
}

std::string either(const std::string& given, const fs::path& otherwise) {
  return given.empty() ? otherwise.string() : given;
}

fs::path configFolder(const OfflineFiles& files) {
  return files.config.empty() ? fs::path(packageFolder()) / "config" : fs::path(files.config);
}

}  // namespace

std::string objectsFile(const OfflineFiles& files) {
  return either(files.objects, configFolder(files) / "objects.yaml");
}

OfflineOptions readOfflineFiles(const OfflineFiles& files) {
  const fs::path config = configFolder(files);
  const std::string objects = objectsFile(files);
  const std::string urdf = either(files.urdf, fs::path(packageFolder()) / "urdf" / "puma560.urdf");
  OfflineOptions options;

  RecognizerParameters recognizer;
  recognizer.objects = objects;
  recognizer = withFile(recognizer, (config / "recognizer.yaml").string());
  options.cache = recognizer.cache;
  options.recognition = recognizer.recognition;
  options.instances = recognizer.instances;
  options.support_tolerance = recognizer.support.tolerance;

  EyeHandParameters eye_hand;
  PlannerParameters planner;
  TaskParameters task;
  eye_hand.objects = planner.objects = task.objects = objects;
  eye_hand.urdf = planner.urdf = task.urdf = urdf;
  options.grasping = withFile(eye_hand, (config / "eye_hand.yaml").string());
  options.executor = withFile(planner, (config / "planner.yaml").string());
  options.task = withFile(task, (config / "task.yaml").string());

  options.cell = loadOptions<CellOptions>(either(files.cell, config / "cell.yaml"));
  options.executor.table.z = options.cell.table.pose.z;
  return options;
}

}  // namespace monocular_eye_hand
