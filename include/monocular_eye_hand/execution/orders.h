#pragma once
#include <functional>
#include <string>
#include <vector>

#include "monocular_eye_hand/execution/placed_object.h"
#include "monocular_eye_hand/planning/pick_plan.h"

namespace monocular_eye_hand {

/// Take an object. The way to its place in the drop zone is planned, too, and kept for place().
struct PickOrder {
  PlacedObject object;  ///< where it stands
  PickTarget target;    ///< how it is grasped; its object is the label of the one above
  int place = 0;        ///< of the drop zone, counted from 0
};

/// Put down what is held.
struct PlaceOrder {
  int place = 0;  ///< of the drop zone, counted from 0
};

/// Go somewhere.
struct MoveOrder {
  std::vector<Rigid3> base_from_tcp;  ///< the first that can be reached is taken
  std::vector<JointVector> joints;    ///< instead of poses [rad]
  bool open_gripper = false;          ///< before; what is held falls
};

/// What runs beside an action.
struct ActionMonitor {
  std::function<bool()> cancelled;
  std::function<void(const std::string& stage, double progress)> reportProgress;  ///< 0..1 of the stage
  std::function<void(const std::vector<Trajectory>&)> show;  ///< the planned motions, before the first
  std::function<void(const std::string&)> log;               ///< what is worth telling beside the result
};

}  // namespace monocular_eye_hand
