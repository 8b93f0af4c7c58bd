#pragma once
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/action_outcome.h"
#include "monocular_eye_hand/execution/held_part.h"
#include "monocular_eye_hand/execution/options.h"
#include "monocular_eye_hand/execution/orders.h"
#include "monocular_eye_hand/execution/pick_memory.h"
#include "monocular_eye_hand/execution/robot_motion.h"
#include "monocular_eye_hand/execution/scene_memory.h"
#include "monocular_eye_hand/planning/move_planner.h"

namespace monocular_eye_hand {

/// How messages to people call what stands around the executor.
struct ExecutorTexts {
  std::string recover_hint = "recover() leads out";  ///< added to refusals that recover() ends
  std::string objects_source = "see()";              ///< where it is told what stands around
};

/// Pick, place, move and recover: each plans a whole way, then drives it. One call at a time; calls block.
/// Whenever an action ends otherwise than done the arm stands, or the result is a fault that says why it may
/// not. They throw BadInput on poses or joints that are not finite, and while arm or gripper are silent
/// before anything was planned; then nothing moved.
class PickPlaceExecutor {
 public:
  /// `robot` and `memory` must outlive it. Throws BadInput on a broken model base or URDF, or an arm that
  /// differs from it.
  PickPlaceExecutor(const ExecutorOptions& options, Robot* robot, PickMemoryStore* memory,
                    const ExecutorTexts& texts = {});

  const ToolArm& arm() const { return arm_; }
  const ArmDescription& description() const { return description_; }
  const SceneMemory& scene() const { return scene_; }
  std::string held() const { return held_ ? held_->object.label() : ""; }  ///< "" for nothing
  /// SceneMemory::see(). Before the first call pick() is refused.
  std::vector<std::string> see(const std::vector<PlacedObject>& objects);

  /// An action that ends before anything was planned.
  ActionResult refuse(ActionOutcome outcome, const std::string& reason);
  ActionResult refuseBadGoal(const std::string& what);  ///< a fault

  ActionResult pick(const PickOrder& order, const ActionMonitor& monitor);
  /// The plan that pick() kept is used when the arm stands within start_tolerance of its start and nothing is
  /// in its way now; else a new one.
  ActionResult place(const PlaceOrder& order, const ActionMonitor& monitor);
  ActionResult move(const MoveOrder& order, const ActionMonitor& monitor);
  /// Backs off, puts down what is held, opens; the reason says what was done.
  ActionResult recover(const ActionMonitor& monitor);

 private:
  struct PlannedPick {
    Departure departure;
    KeptPlan kept;
    std::string refused;  // why the arm cannot leave its start
  };
  struct PlannedMove {
    MovePlan plan;
    double opening = 0;  // of the gripper while it moves [m]
  };

  // executor.cpp: what all four need
  ActionResult result(ActionOutcome outcome, const std::string& reason) const;
  ActionResult result(const MotionResult& moved) const;
  ActionResult noPlace(int place);
  bool hasPlace(int place) const { return place >= 0 && place < int(places_.size()); }
  MotionMonitor motionMonitor(const ActionMonitor& monitor, const std::string& stage, bool holding) const;
  JointVector start() const;
  CollisionWorld worldNow(const JointVector& joints, double gripper_width) const;
  TouchingPairs touching(const CollisionWorld& world) const;
  std::string sweep(const CollisionWorld& world, const JointVector& joints, double from, double to) const;
  double freeOpening(const CollisionWorld& world, const JointVector& joints, double wanted) const;
  void recall(const ActionMonitor& monitor);
  bool holdsSomething(const GripperReading& gripper) const;
  std::string lost(const GripperReading& gripper) const;
  std::optional<PlacedObject> heldObject() const;
  std::optional<PlacedObject> inHand(const JointVector& joints) const;
  void letGo();

  // pick.cpp
  PlannedPick planThePick(const PlacedObject& object, const PickTarget& target, int place);
  PickRequest pickRequest(const PlacedObject& object, const PickTarget& target, int place,
                          const JointVector& start) const;
  void planAfterWithdrawal(const CollisionWorld& world, const JointVector& joints,
                           PlannedPick* planned) const;
  ActionResult drivePick(const PlacedObject& object, const PlannedPick& planned,
                         const ActionMonitor& monitor);
  MotionResult driveToPregrasp(const PlannedPick& planned, const ActionMonitor& monitor);
  MotionResult grasp(const PlacedObject& object, const KeptPlan& kept, const ActionMonitor& monitor);
  MotionResult closeOn(const PlacedObject& object, const KeptPlan& kept, const MotionMonitor& monitor);

  // place.cpp
  bool keptFits(int place, const JointVector& joints) const;
  PickPlan planThePlace(int place, const JointVector& joints, bool free = true) const;
  ActionResult drivePlace(int place, const PickPlan& plan, const ActionMonitor& monitor);
  MotionResult carry(const PickPlan& plan, const ActionMonitor& monitor);
  PlacedObject putDownBy(const PickPlan& plan) const;

  // move.cpp
  PlannedMove planTheMove(const MoveOrder& order);
  ActionResult driveMove(const MovePlan& plan, double opening, const ActionMonitor& monitor);

  // recover.cpp
  Departure planTheRecovery(const JointVector& joints);
  void holdUnknown(const GripperReading& gripper, const JointVector& joints);
  ActionResult leave(const Departure& departure, const JointVector& joints, const ActionMonitor& monitor,
                     std::string* said);
  ActionResult emptyTheHand(const ActionMonitor& monitor, std::string* said);
  ActionResult putDownSomewhere(const ActionMonitor& monitor, std::string* said);
  ActionResult openHere(const ActionMonitor& monitor, std::string* said);

  const ExecutorOptions options_;
  const ExecutorTexts texts_;
  const ArmDescription description_;
  const ToolArm arm_;
  const std::vector<DropPlace> places_;
  SceneMemory scene_;
  RobotMotion motion_;
  PickMemoryStore& memory_;
  bool seen_ = false;
  bool recalled_ = false;
  std::optional<HeldPart> held_;
  Visit visit_;
};

}  // namespace monocular_eye_hand
