#include <fmt/format.h>

#include <cmath>

#include "monocular_eye_hand/geometry/require.h"
#include "monocular_eye_hand/grasp/grasp_plan.h"

namespace monocular_eye_hand {

void GripperBox::check() const {
  for (size_t k = 0; k < 3; ++k) {
    requireFinite(fmt::format("centre[{}]", k), centre[k]);
    requirePositive(fmt::format("size[{}]", k), size[k]);
  }
}

GripperOptions::GripperOptions() {
  body = {{{{0, 0, -0.0635}}, {{0.034, 0.124, 0.027}}},         // finger rail and the fingers' feet
          {{{0, 0, -0.112}}, {{0.060, 0.090, 0.076}}},          // hand
          {{{0, 0, -0.154}}, {{0.070, 0.070, 0.012}}},          // flange
          {{{-0.0675, 0, -0.1175}}, {{0.081, 0.030, 0.065}}}};  // camera and its arm
}

void GripperOptions::check() const {
  requireNotNegative("opening_min", opening_min);
  require(opening_max > opening_min, "opening_max", opening_max, "above opening_min");
  requirePositive("pad_width", pad_width);
  requirePositive("pad_length", pad_length);
  require(finger_width >= pad_width, "finger_width", finger_width, "pad_width or more");
  requirePositive("finger_thickness", finger_thickness);
  require(finger_length >= pad_length / 2, "finger_length", finger_length, "half of pad_length or more");
  require(finger_tip >= pad_length / 2, "finger_tip", finger_tip, "half of pad_length or more");
  requirePositive("friction", friction);
  requirePositive("compliance", compliance);
  for (const GripperBox& box : body) box.check();
}

void GraspSamplingOptions::check() const {
  requirePositive("step", step);
  require(directions >= 1 && directions <= 360, "directions", directions, "1 to 360");
  require(max_face_angle > 0 && max_face_angle < 0.5, "max_face_angle", max_face_angle,
          "above 0 and below 0.5");
  requireShare("min_contact", min_contact);
  requireNotNegative("margin", margin);
  requireNotNegative("approach", approach);
  requireShare("lever_weight", lever_weight);
  require(per_direction >= 1, "per_direction", per_direction, "1 or more");
  require(max_grasps >= 1, "max_grasps", max_grasps, "1 or more");
}

void GraspPlanOptions::check() const {
  requireNotNegative("sigmas", sigmas);
  requireNotNegative("min_clearance", min_clearance);
  requireNotNegative("preferred_clearance", preferred_clearance);
  requirePositive("approach_distance", approach_distance);
  requirePositive("lift_distance", lift_distance);
  require(max_tilt > 0 && max_tilt < M_PI / 2, "max_tilt", max_tilt, "above 0 and below pi / 2");
  requireNotNegative("table_clearance", table_clearance);
  requireNotNegative("obstacle_clearance", obstacle_clearance);
  require(min_wrist >= 0 && min_wrist < 1, "min_wrist", min_wrist, "0 or more and below 1");
  requirePositive("max_joint_step", max_joint_step);
  require(rotation_steps >= 1 && rotation_steps <= 360, "rotation_steps", rotation_steps, "1 to 360");
  require(configurations >= 1 && configurations <= 8, "configurations", configurations, "1 to 8");
  require(max_candidates >= 1, "max_candidates", max_candidates, "1 or more");
}

std::string toString(GraspRefusal refusal) {
  switch (refusal) {
    case GraspRefusal::kFromBelow:
      return "approach too tilted";
    case GraspRefusal::kTable:
      return "meets the table";
    case GraspRefusal::kClearance:
      return "pose too uncertain";
    case GraspRefusal::kPart:
      return "meets the part";
    case GraspRefusal::kObstacle:
      return "meets an obstacle";
    case GraspRefusal::kUnreachable:
      return "unreachable";
    case GraspRefusal::kSingular:
      return "near a singularity";
  }
  return "unknown";
}

}  // namespace monocular_eye_hand
