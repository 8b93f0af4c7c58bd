#pragma once
#include <actionlib/client/simple_action_client.h>
#include <monocular_eye_hand/ForgetObject.h>
#include <monocular_eye_hand/GraspTargets.h>
#include <monocular_eye_hand/LocatedObjectArray.h>
#include <monocular_eye_hand/MoveAction.h>
#include <monocular_eye_hand/PickAction.h>
#include <monocular_eye_hand/PlaceAction.h>
#include <ros/ros.h>

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/arm_description.h"
#include "monocular_eye_hand/parameters/task.h"
#include "monocular_eye_hand/task/drop_places.h"
#include "monocular_eye_hand/task/world.h"
#include "nodes/common/robot_input.h"
#include "nodes/task/recognizer_caller.h"

namespace monocular_eye_hand {

/// The robot as the task sees it: the nodes eye_hand and planner, the gripper and the joints, by their
/// topics, services and actions. Calls block; callbacks must run in other threads. Every wait ends by its
/// time-out or when `cancelled` says so.
class RosTaskWorld : public TaskWorld {
 public:
  /// Keeps a pointer to `models`.
  RosTaskWorld(const ModelBase* models, const TaskParameters& parameters, std::function<bool()> cancelled);

  TaskLook look(const TaskView& view) override;
  TaskGrasps graspTargets(const MappedObject& object) override;
  ActionResult pick(const PlannedGrasp& planned) override;
  TaskGrip grip() override;
  ActionResult carry(const MappedObject& object, int place) override;
  ActionResult open() override;
  void wait(double seconds) override;

  /// A new task begins, which clears `frame`. Places of the drop zone are counted from 0 again, or with
  /// `go_on` where the last task ended: what it carried still lies there.
  void restart(const std::string& frame, bool go_on);
  /// Puts down in the drop zone what the gripper holds since a task was stopped. kDone as well when it holds
  /// nothing.
  ActionResult emptyHand();

 private:
  void objectsCallback(const LocatedObjectArray& message);
  std::optional<JointVector> joints() const;
  bool waitFor(ros::ServiceClient* service) const;
  std::optional<MappedObject> frame() const;
  void waitUntil(const ros::Time& moment) const;  // of the clock; at most look_timeout
  TaskLook waitForView(const ros::Time& after);
  void forgetFuture();
  EyeChain eyeChain() const;
  ActionResult move(const MoveGoal& goal);

  const ModelBase* models_;
  const TaskParameters parameters_;
  const std::function<bool()> cancelled_;
  const Puma560 arm_;
  const ArmDescription description_;
  RobotInput robot_;
  RecognizerCaller recognizer_;
  DropPlaceCount places_;
  std::string frame_;  // of this task

  ros::NodeHandle node_;
  ros::Subscriber objects_subscriber_;
  ros::ServiceClient grasp_targets_, forget_;
  actionlib::SimpleActionClient<PickAction> pick_;
  actionlib::SimpleActionClient<PlaceAction> place_client_;
  actionlib::SimpleActionClient<MoveAction> move_;

  mutable std::mutex mutex_;
  std::condition_variable new_view_;
  std::optional<LocatedObjectArray> view_;
};

}  // namespace monocular_eye_hand
