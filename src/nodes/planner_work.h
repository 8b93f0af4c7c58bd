#pragma once
#include <monocular_eye_hand/MoveAction.h>
#include <monocular_eye_hand/PickAction.h>
#include <monocular_eye_hand/PlaceAction.h>
#include <monocular_eye_hand/RecoverAction.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/execution/drop_zone.h"
#include "monocular_eye_hand/execution/scene_memory.h"
#include "monocular_eye_hand/planning/move_planner.h"
#include "nodes/planner_memory.h"
#include "nodes/planner_parameters.h"
#include "nodes/robot_driver.h"

namespace monocular_eye_hand {

/// What runs beside an action.
struct WorkWatch {
  std::function<bool()> cancelled;
  std::function<void(const std::string& stage, double progress)> say;
  std::function<void(const std::vector<Trajectory>&)> show;  ///< the planned motions, before the first
};

/// Pick, place and move: plans with the planning room, then drives. One call at a time; calls block.
class PlannerWork {
 public:
  /// Throws BadInput on a broken model base or URDF, or an arm that differs from it.
  explicit PlannerWork(const PlannerParameters& parameters);

  const ToolArm& arm() const { return arm_; }
  RobotDriver& driver() { return driver_; }
  SceneMemory& scene() { return scene_; }
  std::vector<std::string> see(const std::vector<PlacedObject>& objects);  ///< SceneMemory::see

  ActionResult pick(const PickGoal& goal, const WorkWatch& watch);
  ActionResult place(const PlaceGoal& goal, const WorkWatch& watch);
  ActionResult move(const MoveGoal& goal, const WorkWatch& watch);
  /// Backs off, puts down what is held, opens; the reason says what was done.
  ActionResult recover(const WorkWatch& watch);
  std::string held() const { return held_ ? held_->object.label() : ""; }

 private:
  /// A planned pick whose second half waits for place().
  struct KeptPlan {
    PickRequest request;
    PickPlan plan;
    int place = 0;
  };
  /// What the gripper holds.
  struct Held {
    PlacedObject object;  // as it stood
    PickTarget target;
    Rigid3 tcp_from_object;
    double width = 0;  // between the pads [m]
    std::optional<KeptPlan> kept;
  };
  /// Where the fingers may touch something because they were just there to take or leave it.
  struct Visit {
    std::optional<PlacedObject> object;
    double opening = 0;  // that is free there [m]
  };

  ActionResult refuse(const std::string& what) const;
  ActionResult result(ActionOutcome outcome, const std::string& reason) const;
  ActionResult result(const Drive& drive) const;
  PlacedObject checked(const PickGoal& goal, PickTarget* target) const;
  JointVector start() const;
  TouchingPairs touching(const CollisionWorld& world) const;
  std::string sweep(const CollisionWorld& world, const JointVector& joints, double from, double to) const;
  double freeOpening(const CollisionWorld& world, const JointVector& joints, double wanted) const;

  struct PlannedPick {
    Departure departure;
    KeptPlan kept;
    std::string refused;  // why the arm cannot leave its start
  };
  PlannedPick planThePick(const PlacedObject& object, const PickTarget& target, int place);
  ActionResult drivePick(const PlacedObject& object, const PlannedPick& planned, const WorkWatch& watch);
  Drive closeOn(const PlacedObject& object, const KeptPlan& kept, const DriveWatch& watch);
  bool keptFits(int place, const JointVector& joints) const;
  /// `free`: the caller says that nothing stands at the place; else it must be known to be free.
  PickPlan planThePlace(int place, const JointVector& joints, bool free = true) const;
  ActionResult drivePlace(int place, const PickPlan& plan, const WorkWatch& watch);
  ActionResult driveMove(const MovePlan& plan, double opening, const WorkWatch& watch);
  std::string lost(const GripperState& state) const;
  std::optional<PlacedObject> inHand(const JointVector& joints) const;

  static std::string recoverHint();
  bool holdsSomething(const GripperState& gripper) const;
  void recall();
  void hold(const PlacedObject& object, const PickTarget& target, double width);
  void holdUnknown(const GripperState& gripper, const JointVector& joints);
  CollisionWorld worldNow(const JointVector& joints, double gripper_width) const;
  ActionResult putDownSomewhere(const WorkWatch& watch, std::string* said);
  ActionResult openHere(const WorkWatch& watch, std::string* said);
  DriveWatch driveWatch(const WorkWatch& watch, const std::string& stage, bool holding) const;

  const PlannerParameters parameters_;
  const ArmDescription description_;
  const ToolArm arm_;
  const std::vector<DropPlace> places_;
  SceneMemory scene_;
  RobotDriver driver_;
  bool seen_ = false, recalled_ = false;
  std::optional<Held> held_;
  Visit visit_;
};

}  // namespace monocular_eye_hand
