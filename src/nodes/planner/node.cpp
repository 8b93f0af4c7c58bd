#include "nodes/planner/node.h"

#include <fmt/format.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>

#include "monocular_eye_hand/geometry/error.h"
#include "nodes/common/conversion.h"
#include "nodes/common/markers.h"
#include "nodes/common/names.h"
#include "nodes/common/robot_messages.h"
#include "nodes/planner/conversion.h"
#include "nodes/planner/markers.h"

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

ExecutorTexts texts() {
  ExecutorTexts texts;
  texts.recover_hint = "a goal to " + ros::names::resolve(std::string("~") + names::kRecover) + " leads out";
  texts.objects_source = names::kLocatedObjects;
  return texts;
}

ActionResult fault(const std::string& reason) {
  ActionResult result;
  result.reason = reason;
  return result;
}

}  // namespace

template <class Action>
void PlannerNode::serve(ServerPtr<Action>* server, const char* name,
                        const Work<typename Server<Action>::Goal>& work) {
  const auto on_goal = [this, server, name, work](const typename Server<Action>::GoalConstPtr& goal) {
    run<Action>(server->get(), name, [&](const ActionMonitor& monitor) { return work(*goal, monitor); });
  };
  *server = std::make_unique<Server<Action>>(private_node_, name, on_goal, false);
  (*server)->start();
}

template <class Action>
void PlannerNode::run(Server<Action>* server, const char* name,
                      const std::function<ActionResult(const ActionMonitor&)>& work) {
  ActionResult ended;
  {
    const std::unique_lock<std::mutex> lock(busy_, std::try_to_lock);
    if (stopping_) {
      ended = fault("the planner is going down; nothing moved");
    } else if (!lock.owns_lock()) {
      ended = fault("busy with " + running() + ": one action at a time; nothing moved");
    } else {
      setRunning(name);
      ended = guarded([&] { return work(monitorOf<Action>(server)); });
      remember(name, ended);
    }
  }  // free for the next goal before this one's result is known

  const auto result = toMessage<typename Server<Action>::Result>(ended);
  if (ended.done()) {
    server->setSucceeded(result);
    return;
  }
  ROS_WARN("%s: %s", name, ended.reason.c_str());
  if (ended.outcome == ActionOutcome::kCancelled)
    server->setPreempted(result, ended.reason);
  else
    server->setAborted(result, ended.reason);
}

template <class Action>
ActionMonitor PlannerNode::monitorOf(Server<Action>* server) {
  ActionMonitor monitor;
  monitor.cancelled = [this, server] { return stopping_ || server->isPreemptRequested(); };
  monitor.reportProgress = [server](const std::string& stage, double progress) {
    typename Server<Action>::Feedback feedback;
    feedback.stage = stage;
    feedback.progress = progress;
    server->publishFeedback(feedback);
  };
  monitor.show = [this](const std::vector<Trajectory>& motions) {
    path_.publish(pathMarker(parameters_.base_frame, executor_.arm(), motions));
  };
  monitor.log = [](const std::string& text) { ROS_INFO("%s", text.c_str()); };
  return monitor;
}

PlannerNode::PlannerNode(const PlannerParameters& parameters, const NodeWatch& node_watch)
    : parameters_(parameters),
      node_watch_(node_watch),
      executor_(parameters, &robot_, &memory_, texts()),
      private_node_("~") {
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

  using Monitor = ActionMonitor;
  serve<PickAction>(&pick_, names::kPick, [this](const PickGoal& g, const Monitor& m) { return pick(g, m); });
  serve<MoveAction>(&move_, names::kMove, [this](const MoveGoal& g, const Monitor& m) { return move(g, m); });
  serve<PlaceAction>(&place_, names::kPlace, [this](const PlaceGoal& g, const Monitor& m) {
    return executor_.place(PlaceOrder{g.place}, m);
  });
  serve<RecoverAction>(&recover_, names::kRecover,
                       [this](const RecoverGoal&, const Monitor& m) { return executor_.recover(m); });
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
  for (const std::string& label : executor_.see(objects))
    ROS_WARN("%s is not in the model base, or its pose is broken: it is no obstacle", label.c_str());
}

std::string PlannerNode::running() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return running_;
}
void PlannerNode::setRunning(const std::string& action) {
  const std::lock_guard<std::mutex> lock(mutex_);
  running_ = action;
}

ActionResult PlannerNode::guarded(const std::function<ActionResult()>& work) {
  try {
    takeObjects();
    return work();
  } catch (const std::exception& e) {  // BadInput: silent topics, broken numbers; nothing moves then
    return fault(e.what());
  }
}

ActionResult PlannerNode::pick(const PickGoal& goal, const ActionMonitor& monitor) {
  if (!goal.target.feasible)
    return executor_.refuse(ActionOutcome::kUnreachable,
                            "the target says that it is not feasible: " + goal.target.reason);
  PickOrder order;
  try {
    order = pickOrderOf(goal, parameters_.base_frame, executor_.scene(),
                        executor_.description().gripper_width_max);
  } catch (const BadInput& e) {
    return executor_.refuseBadGoal(e.what());
  }
  return executor_.pick(order, monitor);
}

ActionResult PlannerNode::move(const MoveGoal& goal, const ActionMonitor& monitor) {
  MoveOrder order;
  try {
    order = moveOrderOf(goal, executor_.description());
  } catch (const BadInput& e) {
    return executor_.refuseBadGoal(e.what());
  }
  return executor_.move(order, monitor);
}

void PlannerNode::remember(const char* action, const ActionResult& result) {
  const std::lock_guard<std::mutex> lock(mutex_);
  running_.clear();
  held_ = executor_.held();
  known_ = executor_.scene().seen().size();
  remembered_ = executor_.scene().remembered();
  last_ = std::string(action) + ": " + (result.done() ? "done" : result.reason);
  ++(result.done() ? done_ : not_done_);
  planning_time_ = result.planning_time;
  longest_planning_ = std::max(longest_planning_, planning_time_);
}

void PlannerNode::robotStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const RobotState state = robot_.state();
  const std::string joints = missingJoints(robot_, state, parameters_.execution);
  const std::string gripper = missingGripper(robot_, state, parameters_.execution);
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
  status.add("stamp of the objects heard of [s]",
             objects_ ? fmt::format("{:.3f}", objects_->header.stamp.toSec()) : "none yet");
  status.add("objects in the last plan", known_);
  status.add("objects put down and remembered", remembered_);
  status.add("planning time, last [s]", planning_time_);
  status.add("planning time, longest [s]", longest_planning_);
}

}  // namespace monocular_eye_hand
