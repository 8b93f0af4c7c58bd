#include "monocular_eye_hand/execution/held_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

// An unknown part: from so far behind gripper_tcp to so far before it, so long along the pads [m].
constexpr double kUnknownBehind = 0.03;
constexpr double kUnknownBefore = 0.07;
constexpr double kUnknownLength = 0.06;
constexpr double kThinnest = 1e-3;  // a box needs a width [m]

}  // namespace

const char kUnknownPart[] = "unknown part";

PlacedObject HeldPart::inHand(const Rigid3& base_from_tcp) const {
  PlacedObject held = object;
  held.base_from_object = base_from_tcp * tcp_from_object;
  return held;
}

std::string HeldPart::lost(const GripperReading& gripper, double tolerance) const {
  const double off = std::abs(gripper.width - width);
  if (gripper.stalled && off <= tolerance) return "";
  return fmt::format("the gripper lost {}: it stands at {:.3g} mm and held it at {:.3g} mm", object.label(),
                     gripper.width * 1e3, width * 1e3);
}

HeldPart holdPart(const PlacedObject& object, const PickTarget& target, double width) {
  HeldPart held;
  held.object = object;
  held.target = target;
  held.tcp_from_object = target.base_from_grasp.inverse() * object.base_from_object;
  held.width = width;
  return held;
}

Eigen::Vector3d unknownPartSize(double width) {
  return {kUnknownLength, std::max(width, kThinnest), kUnknownBehind + kUnknownBefore};
}

HeldPart holdUnknownPart(const Rigid3& base_from_tcp, double table_height, double width, double opening) {
  PickTarget target;
  target.object = std::string(kUnknownPart) + " 0";
  target.base_from_grasp = base_from_tcp;
  target.base_from_grasp.translation.z() = table_height + kUnknownBefore;
  target.base_from_pregrasp = target.base_from_grasp;
  target.base_from_lift = target.base_from_grasp;
  target.part_width = width;
  target.opening = opening;

  PlacedObject object{kUnknownPart, 0, target.base_from_grasp};
  object.base_from_object.translation +=
      target.base_from_grasp.rotation.col(2) * (kUnknownBefore - kUnknownBehind) / 2;
  return holdPart(object, target, width);
}

}  // namespace monocular_eye_hand
