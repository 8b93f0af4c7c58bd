#pragma once
#include <string>

namespace monocular_eye_hand {

/// How a pick, a place, a move or a part of one ended.
enum class ActionOutcome {
  kDone,
  kUnreachable,  ///< no path; nothing moved
  kInCollision,  ///< every path meets something; nothing moved
  kGraspLost,    ///< nothing, or nothing any more, between the fingers
  kCancelled,    ///< stopped on request
  kFault         ///< the arm, the gripper or the planner does not answer
};
/// "in collision" and so on, for messages.
std::string toString(ActionOutcome outcome);

struct ActionResult {
  ActionOutcome outcome = ActionOutcome::kFault;
  std::string reason;                         ///< for people
  double planning_time = 0, motion_time = 0;  ///< [s]
  int reached = -1;                           ///< of a move: which of its goals
  double stamp = 0;                           ///< of the last joint state [s]; 0: not known
  bool done() const { return outcome == ActionOutcome::kDone; }
};

}  // namespace monocular_eye_hand
