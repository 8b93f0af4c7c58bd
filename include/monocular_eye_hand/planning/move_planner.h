#pragma once
#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/planning/pick_planner.h"

namespace monocular_eye_hand {

/// Names of links or objects that touch where the arm stands, and may while it leaves.
using TouchingPairs = std::vector<std::pair<std::string, std::string>>;

/// The way out for an arm that stands nearer to something than the padding.
struct Departure {
  bool possible = false;
  std::string reason;     ///< not possible: what it touches, by name
  Trajectory trajectory;  ///< empty when the arm may start where it is
  JointVector end = JointVector::Zero();
  double padding = 0;  ///< that `end` is free with [m]
};

/// From `start` in `world` (gripper width and carried object as they are). The padding is halved down to
/// near_padding; where even that is not free but the true shapes are, a short straight line leads to where it
/// is: up, back along the hand, sideways, or turning a single joint. Throws BadInput as planMove() does.
Departure planDeparture(const ToolArm& arm, const CollisionWorld& world, const JointVector& start,
                        const TouchingPairs& touching, const PlanningOptions& options = {});

/// As planDeparture(), and a way out for an arm whose true shapes meet something: a straight line on which
/// what meets parts, and nothing else is met, to where it is free.
Departure planRecovery(const ToolArm& arm, const CollisionWorld& world, const JointVector& start,
                       const TouchingPairs& touching, const PlanningOptions& options = {});

/// Straight lines out of a narrow place, for an arm that may start where it is and finds no way from there:
/// up and back along the hand, 0.1 m or half of that; those that are free. Throws as planDeparture().
std::vector<Departure> planWithdrawals(const ToolArm& arm, const CollisionWorld& world,
                                       const JointVector& start, const TouchingPairs& touching,
                                       const PlanningOptions& options = {});

struct MoveRequest {
  JointVector start = JointVector::Zero();
  std::vector<Rigid3> base_from_tcp;  ///< the first that can be reached is taken
  std::vector<JointVector> joints;    ///< instead of poses
  TouchingPairs touching;
};

enum class MoveOutcome { kPlanned, kStartInCollision, kUnreachable, kGoalInCollision, kNoPath };
/// "start in collision" and so on, for messages.
std::string toString(MoveOutcome outcome);
ActionOutcome outcomeOf(MoveOutcome outcome);

struct MovePlan {
  MoveOutcome outcome = MoveOutcome::kUnreachable;
  std::string reason;  ///< what stands in the way, by name; empty when planned
  std::vector<Trajectory>
      motions;    ///< each beginning where the last one ended; none when it is there already
  int goal = -1;  ///< MoveRequest::base_from_tcp or joints
  bool planned() const { return outcome == MoveOutcome::kPlanned; }
};

/// A free motion to the first of some goals that works; of failures the one that came furthest is told. The
/// budget of options.path is shared by at most four searches; without a path it is tried again after each of
/// planWithdrawals(). Throws BadInput without a goal, on joints or
/// poses that are not finite, a start outside the joint limits, or options out of range.
MovePlan planMove(const ToolArm& arm, const CollisionWorld& world, const MoveRequest& request,
                  const PlanningOptions& options = {});

struct PlaceRequest {
  JointVector start = JointVector::Zero();
  std::string object;                  ///< a world object; where it stands in the world does not matter
  Rigid3 tcp_from_object;              ///< how it is held
  double opening = 0, part_width = 0;  ///< between the finger pads, after and before letting go [m]
  std::vector<DropTarget> drops;       ///< the first that works is taken
  std::vector<std::string> supports;   ///< world objects that the held one may touch at start and end
};

/// Plans to put down what is held: the last three motions of a pick, kCarry, kLower and kRetreat; before them
/// a kLift when the arm has to leave something first, or finds no path before it withdrew. Throws BadInput as
/// planPick() does.
PickPlan planPlace(const ToolArm& arm, const CollisionWorld& world, const PlaceRequest& request,
                   const PlanningOptions& options = {});

}  // namespace monocular_eye_hand
