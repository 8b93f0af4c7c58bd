#pragma once
#include <actionlib/client/simple_action_client.h>
#include <monocular_eye_hand/ForgetObject.h>
#include <monocular_eye_hand/GraspTargets.h>
#include <monocular_eye_hand/GripperState.h>
#include <monocular_eye_hand/LocatedObjectArray.h>
#include <monocular_eye_hand/MoveAction.h>
#include <monocular_eye_hand/PickAction.h>
#include <monocular_eye_hand/PlaceAction.h>
#include <monocular_eye_hand/Recognize.h>
#include <monocular_eye_hand/RecognizedObjectArray.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "monocular_eye_hand/arm/arm_description.h"
#include "monocular_eye_hand/arm/arm_state.h"
#include "monocular_eye_hand/task/drop_places.h"
#include "monocular_eye_hand/task/world.h"
#include "nodes/common/moment.h"
#include "nodes/task/parameters.h"

namespace monocular_eye_hand {

/// The robot as the task sees it: the nodes eye_hand and planner, the gripper and the joints, by their
/// topics, services and actions. Calls block; callbacks must run in other threads. Every wait ends by its
/// time-out or when `cancelled` says so.
class RosTaskWorld : public TaskWorld {
 public:
  /// Keeps a pointer to `models`.
  RosTaskWorld(const ModelBase* models, const TaskParameters& parameters, std::function<bool()> cancelled);
  ~RosTaskWorld() override;

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
  void recognizedCallback(const RecognizedObjectArray& message);
  void gripperCallback(const GripperState& message);
  void jointsCallback(const sensor_msgs::JointState& message);
  std::optional<JointVector> joints() const;
  bool waitFor(ros::ServiceClient* service) const;
  std::optional<MappedObject> frame() const;
  void waitUntil(const ros::Time& moment) const;  // of the clock; at most look_timeout
  TaskLook waitForView(const ros::Time& after);
  void forgetFuture();
  void ask(const std::optional<ros::Time>& after);
  void askRecognizer();  // the thread asker_
  std::string silence(
      const ros::Time& after) const;  // who in the chain of eyes says nothing; with mutex_ held
  bool recognizerGone() const;        // with mutex_ held
  ActionResult move(const MoveGoal& goal);

  const ModelBase* models_;
  const TaskParameters parameters_;
  const std::function<bool()> cancelled_;
  const Puma560 arm_;
  const ArmDescription description_;
  DropPlaceCount places_;
  std::string frame_;  // of this task

  ros::NodeHandle node_;
  ros::Subscriber objects_subscriber_, recognized_subscriber_, gripper_subscriber_, joints_subscriber_;
  ros::ServiceClient recognize_, grasp_targets_, forget_;
  actionlib::SimpleActionClient<PickAction> pick_;
  actionlib::SimpleActionClient<PlaceAction> place_client_;
  actionlib::SimpleActionClient<MoveAction> move_;

  mutable std::mutex mutex_;
  std::condition_variable new_view_, asked_;
  std::optional<ros::Time> ask_after_;  // an image from then on is wanted
  bool gone_now_ = false;               // the recogniser does not answer, by the last call for this view
  Moment gone_at_;                      // since then it does not
  std::string complaint_;               // why it did not work on the last image asked for; "": it did
  bool ending_ = false;
  std::optional<LocatedObjectArray> view_;
  ros::Time recognized_;  // stamp of the last image that was recognised
  Moment recognized_at_;
  std::optional<GripperState> gripper_;
  std::optional<JointVector> joints_;
  ArmStates arm_states_;
  Moment gripper_at_, joints_at_;
  std::thread asker_;
};

}  // namespace monocular_eye_hand
