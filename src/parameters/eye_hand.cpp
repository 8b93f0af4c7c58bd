#include "monocular_eye_hand/parameters/eye_hand.h"

#include <fmt/format.h>

#include <cmath>

#include "monocular_eye_hand/arm/load_arm_description.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {
namespace {

constexpr double kSameWidth = 1e-6;  // [m]

}  // namespace

void EyeHandParameters::check() const {
  GraspingOptions::check();
  requireGiven("objects", objects, "the path of the model base, e.g. config/objects.yaml of this package");
  requireGiven("urdf", urdf, "the path of the arm's URDF, e.g. urdf/puma560.urdf of this package");
  requireGiven("base_frame", base_frame, "the tf frame of the arm's base");
  requireGiven("tool_frame", tool_frame, "the tf frame of the arm's flange");
  for (const std::string& joint : joint_names)
    requireGiven("joint_names", joint, "the six names of the arm's joints");

  requirePositive("wait", wait);
  requirePositive("memory", memory);
  requirePositive("max_joint_gap", max_joint_gap);
  requirePositive("max_joint_age", max_joint_age);
  requirePositive("max_tf_distance", max_tf_distance);
  requirePositive("max_tf_rotation", max_tf_rotation);
  require(max_waiting >= 1, "max_waiting", max_waiting, "1 or more");

  require(std::isfinite(table_height), "table_height", table_height, "finite");
  requirePositive("still", still);

  require(marker_triangles >= 0, "marker_triangles", marker_triangles, "0 or more");
  requirePositive("label_height", label_height);
  requirePositive("diagnostic_period", diagnostic_period);
}

ArmDescription loadSameArm(const EyeHandParameters& parameters, const Puma560& arm) {
  ArmDescription description = loadArmDescription(parameters.urdf);
  requireSameArm(description, arm);
  if (parameters.gripper.opening_max > description.gripper_width_max + kSameWidth)
    throw BadInput(fmt::format(
        "gripper.opening_max = {:.6g} must not be more than the {:.6g} m that the fingers of {} open",
        parameters.gripper.opening_max, description.gripper_width_max, parameters.urdf));
  return description;
}

}  // namespace monocular_eye_hand
