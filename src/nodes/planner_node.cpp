#include "nodes/planner_node.h"

#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cstdio>

#include "monocular_eye_hand/geometry/error.h"
#include "nodes/action_outcome.h"
#include "nodes/conversion.h"
#include "nodes/markers.h"
#include "nodes/names.h"
#include "nodes/planner_markers.h"

namespace monocular_eye_hand {
namespace {

template <class Result>
Result toMessage(const ActionResult& work) {
  Result result;
  result.outcome = codeOf(work.outcome);
  result.reason = work.reason;
  result.planning_time = work.planning_time;
  result.motion_time = work.motion_time;
  if constexpr (std::is_same_v<Result, MoveResult>) {
    result.reached = work.reached;
    result.stamp = ros::Time(work.stamp);
  }
  return result;
}

ActionResult fault(const std::string& reason) {
  ActionResult result;
  result.reason = reason;
  return result;
}

}  // namespace

PlannerNode::PlannerNode(const PlannerParameters& parameters, const NodeWatch& node_watch)
    : parameters_(parameters),
      node_watch_(node_watch),
      work_(parameters),
      private_node_("~"),
      pick_(
          private_node_, names::kPick,
          [this](const PickGoalConstPtr& goal) {
            run<PickAction, PickResult, PickFeedback>(
                &pick_, names::kPick, [&](const WorkWatch& watch) { return work_.pick(*goal, watch); });
          },
          false),
      place_(
          private_node_, names::kPlace,
          [this](const PlaceGoalConstPtr& goal) {
            run<PlaceAction, PlaceResult, PlaceFeedback>(
                &place_, names::kPlace, [&](const WorkWatch& watch) { return work_.place(*goal, watch); });
          },
          false),
      move_(
          private_node_, names::kMove,
          [this](const MoveGoalConstPtr& goal) {
            run<MoveAction, MoveResult, MoveFeedback>(
                &move_, names::kMove, [&](const WorkWatch& watch) { return work_.move(*goal, watch); });
          },
          false),
      recover_(
          private_node_, names::kRecover,
          [this](const RecoverGoalConstPtr&) {
            run<RecoverAction, RecoverResult, RecoverFeedback>(
                &recover_, names::kRecover, [&](const WorkWatch& watch) { return work_.recover(watch); });
          },
          false) {
  path_ = private_node_.advertise<visualization_msgs::Marker>(names::kPath, 1, true);
  path_.publish(deleteAllMarker(parameters_.base_frame));  // what a former planner left
  cell_ = private_node_.advertise<visualization_msgs::MarkerArray>(names::kCell, 1, true);
  cell_.publish(cellMarkers(parameters_));
  cell_timer_ = node_.createWallTimer(ros::WallDuration(kMarkerRepeat), [this](const ros::WallTimerEvent&) {
    cell_.publish(cellMarkers(parameters_));
  });
  objects_subscriber_ = node_.subscribe(names::kLocatedObjects, 10, &PlannerNode::onObjects, this);

  updater_.setHardwareID("none");
  updater_.add("robot", this, &PlannerNode::robotStatus);
  updater_.add("planning", this, &PlannerNode::planningStatus);
  timer_ = node_.createWallTimer(ros::WallDuration(parameters.diagnostic_period),
                                 [this](const ros::WallTimerEvent&) { updater_.force_update(); });

  pick_.start();
  place_.start();
  move_.start();
  recover_.start();
}

PlannerNode::~PlannerNode() { stop(); }

void PlannerNode::stop() {
  stopping_ = true;
  const std::lock_guard<std::mutex> lock(busy_);
}

void PlannerNode::onObjects(const LocatedObjectArrayConstPtr& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (withoutSlash(message->header.frame_id) != parameters_.base_frame) {
    ROS_ERROR_THROTTLE(10, "%s is in the frame '%s' and must be in '%s': left out",
                       objects_subscriber_.getTopic().c_str(), message->header.frame_id.c_str(),
                       parameters_.base_frame.c_str());
    return;
  }
  objects_ = message;
}

/// What eye-hand knows at this moment is what the action plans with.
void PlannerNode::takeObjects() {
  LocatedObjectArrayConstPtr array;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    array = objects_;
  }
  if (!array) return;
  std::vector<PlacedObject> objects;
  for (const LocatedObject& object : array->objects)
    objects.push_back({object.name, object.instance, fromPose(object.pose.pose)});
  for (const std::string& label : work_.see(objects))
    ROS_WARN("%s is not in the model base, or its pose is broken: it is no obstacle", label.c_str());
}

void PlannerNode::show(const std::vector<Trajectory>& motions) {
  path_.publish(pathMarker(parameters_.base_frame, work_.arm(), motions));
}

std::string PlannerNode::running() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return running_;
}
void PlannerNode::setRunning(const std::string& action) {
  const std::lock_guard<std::mutex> lock(mutex_);
  running_ = action;
}

ActionResult PlannerNode::guarded(const WorkWatch& watch,
                                  const std::function<ActionResult(const WorkWatch&)>& work) {
  try {
    takeObjects();
    return work(watch);
  } catch (const std::exception& e) {  // BadInput: silent topics, broken numbers; nothing moves then
    return fault(e.what());
  }
}

template <class Action, class Result, class Feedback>
void PlannerNode::run(Server<Action>* server, const char* action,
                      const std::function<ActionResult(const WorkWatch&)>& work) {
  ActionResult ended;
  {
    const std::unique_lock<std::mutex> lock(busy_, std::try_to_lock);
    if (stopping_) {
      ended = fault("the planner is going down; nothing moved");
    } else if (!lock.owns_lock()) {
      ended = fault("busy with " + running() + ": one action at a time; nothing moved");
    } else {
      setRunning(action);
      WorkWatch watch;
      watch.cancelled = [this, server] { return stopping_ || server->isPreemptRequested(); };
      watch.say = [server](const std::string& stage, double progress) {
        Feedback feedback;
        feedback.stage = stage;
        feedback.progress = progress;
        server->publishFeedback(feedback);
      };
      watch.show = [this](const std::vector<Trajectory>& motions) { show(motions); };
      ended = guarded(watch, work);
      remember(action, ended);
    }
  }  // free for the next goal before this one's result is known

  const Result result = toMessage<Result>(ended);
  if (ended.done()) {
    server->setSucceeded(result);
    return;
  }
  ROS_WARN("%s: %s", action, ended.reason.c_str());
  if (ended.outcome == ActionOutcome::kCancelled)
    server->setPreempted(result, ended.reason);
  else
    server->setAborted(result, ended.reason);
}

void PlannerNode::remember(const char* action, const ActionResult& result) {
  const std::lock_guard<std::mutex> lock(mutex_);
  running_.clear();
  held_ = work_.held();
  known_ = work_.scene().seen().size();
  remembered_ = work_.scene().remembered();
  last_ = std::string(action) + ": " + (result.done() ? "done" : result.reason);
  ++(result.done() ? done_ : not_done_);
  planning_time_ = result.planning_time;
  longest_planning_ = std::max(longest_planning_, planning_time_);
}

void PlannerNode::robotStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const std::string joints = work_.driver().jointSilence(), gripper = work_.driver().gripperSilence();
  const std::string clock = node_watch_.clockProblem();
  if (!clock.empty())
    status.summary(DiagnosticStatus::WARN, clock + " Waits are paused");
  else if (!joints.empty())
    status.summary(DiagnosticStatus::ERROR, joints);
  else if (!gripper.empty())
    status.summary(DiagnosticStatus::ERROR, gripper);
  else
    status.summary(DiagnosticStatus::OK, "arm and gripper tell where they are");
}

void PlannerNode::planningStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string idle = last_.empty() ? "no goal yet" : "last " + last_;
  status.summary(diagnostic_msgs::DiagnosticStatus::OK, running_.empty() ? idle : running_ + " runs");
  status.add("goals done", done_);
  status.add("goals not done", not_done_);
  status.add("held", held_);
  char stamp[32] = "none yet";
  if (objects_) std::snprintf(stamp, sizeof stamp, "%.3f", objects_->header.stamp.toSec());
  status.add("stamp of the objects heard of [s]", stamp);
  status.add("objects in the last plan", known_);
  status.add("objects put down and remembered", remembered_);
  status.add("planning time, last [s]", planning_time_);
  status.add("planning time, longest [s]", longest_planning_);
}

}  // namespace monocular_eye_hand
