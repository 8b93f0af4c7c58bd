#include <actionlib/server/simple_action_server.h>
#include <monocular_eye_hand/ClearFrameAction.h>
#include <ros/ros.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>

#include "monocular_eye_hand/io/file_path.h"
#include "monocular_eye_hand/model/model_base.h"
#include "nodes/common/conversion.h"
#include "nodes/common/run_node.h"
#include "nodes/task/messages.h"
#include "nodes/task/world.h"

namespace monocular_eye_hand {
namespace {

constexpr std::chrono::seconds kLongestStop(10);  // roslaunch waits no longer than 15 s for the end of a node

/// The action ~clear_frame: runs the task in the action's own thread.
class TaskNode {
 public:
  TaskNode(const ModelBase& models, const TaskParameters& parameters)
      : models_(models),
        parameters_(parameters),
        world_(&models, parameters, [this] { return stopped(); }),
        server_(
            ros::NodeHandle("~"), "clear_frame", [this](const ClearFrameGoalConstPtr& goal) { run(*goal); },
            false) {
    server_.start();
  }
  /// Cancels the task, and waits until the planner has stopped the arm.
  void stop() {
    stopping_ = true;
    if (busy_.try_lock_for(kLongestStop)) busy_.unlock();
  }

 private:
  bool stopped() { return stopping_ || server_.isPreemptRequested() || !ros::ok(); }

  /// What a stopped task left in the gripper is no part of the new one. No reason: nothing is there any more.
  TaskResult emptyHand() {
    TaskResult result;
    const ActionResult placed = world_.emptyHand();
    if (placed.done()) return result;
    if (placed.outcome == ActionOutcome::kCancelled) result.outcome = TaskOutcome::kCancelled;
    result.reason = "the gripper is not empty, and what it holds cannot be put down: " + placed.reason;
    if (placed.outcome != ActionOutcome::kCancelled)
      result.reason += " (a goal to " + ros::names::resolve("planner/recover") + " puts it down and opens)";
    return result;
  }

  void run(const ClearFrameGoal& goal) {
    const std::lock_guard<std::timed_mutex> lock(busy_);
    const ros::Time begin = ros::Time::now();
    TaskResult result;
    try {
      ClearFrameOptions options = parameters_.clear_frame;
      if (!goal.frame.empty()) options.frame = goal.frame;
      ClearFrameTask task(
          &models_, &world_, options, [this] { return stopped(); },
          [this](const TaskFeedback& feedback) {
            ROS_INFO("%s %s: %s", toString(feedback.stage).c_str(), feedback.object.c_str(),
                     feedback.text.c_str());
            server_.publishFeedback(toMessage(feedback));
          });
      world_.restart(options.frame, interrupted_);
      result = emptyHand();
      if (result.reason.empty()) result = task.run();
    } catch (const std::exception& e) {
      result.outcome = TaskOutcome::kFault;
      result.reason = e.what();
    }

    interrupted_ = result.outcome == TaskOutcome::kCancelled || result.outcome == TaskOutcome::kFault;
    const ClearFrameResult message =
        toMessage(result, parameters_.base_frame, (ros::Time::now() - begin).toSec());
    ROS_INFO("%s: %s", toString(result.outcome).c_str(), result.reason.c_str());
    if (result.outcome == TaskOutcome::kCancelled)
      server_.setPreempted(message, result.reason);
    else if (result.outcome == TaskOutcome::kCleared)
      server_.setSucceeded(message, result.reason);
    else
      server_.setAborted(message, result.reason);
  }

  const ModelBase& models_;
  const TaskParameters parameters_;
  RosTaskWorld world_;
  bool interrupted_ = false;  // the last task: what it carried counts on
  std::atomic<bool> stopping_{false};
  std::timed_mutex busy_;                                   // held by the task that runs
  actionlib::SimpleActionServer<ClearFrameAction> server_;  // last: its thread ends before the world goes
};

}  // namespace
}  // namespace monocular_eye_hand

namespace meh = monocular_eye_hand;

int main(int argc, char** argv) {
  meh::NodeSetup setup;
  setup.help = {"task",
                "clears a frame of the known objects that lie in it",
                "eye_hand/objects, recognizer/objects, joint_states, gripper/state",
                "feedback and result of its action",
                "action ~clear_frame",
                "task.launch objects:=FILE.yaml urdf:=ARM.urdf",
                "config/task.yaml"};
  setup.ends_when_asked = true;
  return meh::runNode<meh::TaskParameters>(
      argc, argv, setup, [](meh::TaskParameters& parameters, const meh::NodeWatch&) {
        parameters.base_frame = meh::withoutSlash(parameters.base_frame);
        parameters.objects = meh::pathParameter("objects", parameters.objects);
        parameters.urdf = meh::pathParameter("urdf", parameters.urdf);
        const meh::ModelBase models =
            meh::loadModels(parameters.objects, meh::ModelDepth::kViews, {}, parameters.cache);

        ros::AsyncSpinner spinner(2);  // topics and answers arrive while the task waits for them
        spinner.start();
        meh::TaskNode task(models, parameters);
        meh::runUntilAsked(&spinner, "the frame is " + parameters.clear_frame.frame,
                           [&task] { task.stop(); });
      });
}
