#pragma once
#include <optional>
#include <string>

#include "monocular_eye_hand/execution/placed_object.h"
#include "monocular_eye_hand/execution/robot.h"
#include "monocular_eye_hand/planning/pick_plan.h"

namespace monocular_eye_hand {

/// A planned pick whose second half waits for place().
struct KeptPlan {
  PickRequest request;
  PickPlan plan;
  int place = 0;
};

/// What the gripper holds.
struct HeldPart {
  PlacedObject object;  ///< as it stood
  PickTarget target;
  Rigid3 tcp_from_object;
  double width = 0;  ///< between the pads [m]
  std::optional<KeptPlan> kept;

  /// The object as the hand has it when gripper_tcp is there.
  PlacedObject inHand(const Rigid3& base_from_tcp) const;
  /// Why it is not held any more, by what the gripper tells; "" while it is. `tolerance` of the width [m].
  std::string lost(const GripperReading& gripper, double tolerance) const;
};

/// A part as it hangs in a hand that took it as its target says; `width` between the pads [m].
HeldPart holdPart(const PlacedObject& object, const PickTarget& target, double width);

/// The name of a part that nobody picked, and a box that is large enough for most that fit the gripper:
/// along the pads, between them, along the hand [m].
extern const char kUnknownPart[];
Eigen::Vector3d unknownPartSize(double width);
/// Such a part in a hand at `base_from_tcp`, as if it had stood on a table at this height [m] below the hand
/// as it is turned now. `opening`: of the gripper when it lets go [m].
HeldPart holdUnknownPart(const Rigid3& base_from_tcp, double table_height, double width, double opening);

/// Where the fingers may touch something because they were just there to take or leave it.
struct Visit {
  std::optional<PlacedObject> object;
  double opening = 0;  ///< that is free there [m]
};

}  // namespace monocular_eye_hand
