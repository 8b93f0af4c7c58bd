#include "nodes/eye_hand/setup.h"

#include <ros/console.h>
#include <ros/param.h>

#include <fstream>
#include <sstream>
#include <utility>

#include "monocular_eye_hand/arm/load_arm_description.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/model/build_model.h"
#include "monocular_eye_hand/model/model_base.h"

namespace monocular_eye_hand {
namespace {

constexpr double kSameWidth = 1e-6;  // [m]

// roslaunch may drop or add what surrounds the document.
std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t\r\n"), last = text.find_last_not_of(" \t\r\n");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

}  // namespace

ModelBase loadShapes(const std::string& yaml_path) {
  ModelBase models;
  for (const ObjectEntry& entry : readObjectEntries(yaml_path)) {
    KnownObject known;
    known.model = buildModel(entry.name, loadMesh(entry.mesh, entry.unit), entry.options);
    known.handling = entry.handling;
    models.objects.push_back(std::move(known));
  }
  return models;
}

ArmDescription loadSameArm(const EyeHandParameters& parameters, const Puma560& arm) {
  ArmDescription description = loadArmDescription(parameters.urdf);
  requireSameArm(description, arm);
  if (parameters.gripper.opening_max > description.gripper_width_max + kSameWidth) {
    std::ostringstream text;
    text << "gripper.opening_max = " << parameters.gripper.opening_max << " must not be more than the "
         << description.gripper_width_max << " m that the fingers of " << parameters.urdf << " open";
    throw BadInput(text.str());
  }
  return description;
}

void warnOfOtherRobot(const std::string& urdf_path) {
  std::string described;
  if (!ros::param::get("robot_description", described)) return;
  std::ifstream file(urdf_path);
  std::ostringstream text;
  text << file.rdbuf();
  if (trimmed(described) != trimmed(text.str()))
    ROS_WARN("robot_description is not what %s says: tf and grasps may be of two different arms",
             urdf_path.c_str());
}

}  // namespace monocular_eye_hand
