#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/planning/pick_plan.h"

namespace monocular_eye_hand {

/// A world per kind of motion of one pick.
struct PickWorlds {
  CollisionWorld reach, approach, lift, carry;

  PickWorlds(const CollisionWorld& world, const PickRequest& request, double padding, double near_padding);
  /// With the object put down.
  CollisionWorld released(const PickRequest& request, const DropTarget& drop, double near_padding) const;
  Rigid3 tcp_from_object;
};

/// A failure; of several, the one that came furthest is kept.
struct PickFailure {
  PickOutcome outcome = PickOutcome::kGraspUnreachable;
  std::string reason;
  int progress = -1;

  void record(PickOutcome new_outcome, const std::string& new_reason);
};

/// Joints over a pose, and the straight lines from there.
struct GraspWay {
  JointVector before;
  std::vector<JointVector> approach, lift;
};
struct DropWay {
  JointVector above;
  std::vector<JointVector> lower, retreat;
};

/// Solutions of a pose, soonest reached from `current` first.
std::vector<JointVector> solutionsByTime(const ToolArm& arm, const Rigid3& base_from_tcp,
                                         const JointVector& current, int max_count);

/// A free straight line, or none with the failure recorded. `blocked` is the outcome of a collision.
std::vector<JointVector> straightLine(const ToolArm& arm, const CollisionWorld& world,
                                      const JointVector& start, const Rigid3& base_from_tcp,
                                      const PlanningOptions& options, PickOutcome unreachable,
                                      PickOutcome blocked, const char* what, PickFailure* failure);

bool graspWay(const ToolArm& arm, const PickWorlds& worlds, const PickTarget& target,
              const JointVector& before, const PlanningOptions& options, GraspWay* way, PickFailure* failure);
bool dropWay(const ToolArm& arm, const PickWorlds& worlds, const CollisionWorld& released,
             const DropTarget& drop, const JointVector& above, const PlanningOptions& options, DropWay* way,
             PickFailure* failure);

/// "a with b, 3.2 mm deep" for messages.
std::string describe(const CollisionPair& pair);

}  // namespace monocular_eye_hand
