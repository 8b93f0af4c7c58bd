#include "nodes/task/world.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>
#include <utility>

#include "monocular_eye_hand/arm/load_arm_description.h"
#include "monocular_eye_hand/geometry/error.h"
#include "nodes/common/conversion.h"
#include "nodes/common/names.h"
#include "nodes/common/robot_messages.h"
#include "nodes/common/stamps.h"
#include "nodes/task/messages.h"

namespace monocular_eye_hand {
namespace {

const char kGraspTargets[] = "eye_hand/grasp_targets";
const char kForget[] = "eye_hand/forget";
const char kPick[] = "planner/pick";
const char kPlace[] = "planner/place";
const char kMove[] = "planner/move";
const ros::WallDuration kPoll(0.05), kTick(0.005);
constexpr int kRefusedViews = 3;  // in a row: waiting on helps no more
constexpr double kFuture = 1.0;   // stamps of one clock do not lie so far ahead of it [s]

/// Sends a goal and waits for its result. A cancelled task cancels the goal and waits on: the planner stops
/// the arm and says so.
template <class Client, class Goal>
ActionResult execute(Client* client, const char* action, const Goal& goal, const TaskParameters& parameters,
                     const std::function<bool()>& cancelled) {
  const auto fault = [&](const std::string& what) {
    return ActionResult{ActionOutcome::kFault, fmt::format("the action {} {}", action, what)};
  };
  const Moment begin = Moment::now();
  while (!client->isServerConnected()) {
    if (cancelled()) return {ActionOutcome::kCancelled, "cancelled"};
    if (begin.since() > parameters.answer_timeout)
      return fault("does not answer: is the node planner running?");
    kPoll.sleep();
  }
  if (cancelled()) return {ActionOutcome::kCancelled, "cancelled"};

  client->sendGoal(goal);
  bool asked_to_stop = false;
  const Moment sent = Moment::now();
  while (!client->getState().isDone()) {
    if (!ros::ok()) return {ActionOutcome::kCancelled, "the node ends"};
    if (cancelled() && !asked_to_stop) {
      client->cancelGoal();
      asked_to_stop = true;
    }
    if (!client->isServerConnected())
      return fault("went away while it worked: start the node planner again; a goal to " +
                   ros::names::resolve("planner/recover") + " then puts down what the gripper holds");
    if (sent.since() > parameters.motion_timeout) {
      client->cancelGoal();
      return fault(fmt::format("took longer than motion_timeout = {:g} s", parameters.motion_timeout));
    }
    kPoll.sleep();
  }

  const auto result = client->getResult();
  if (!result) return fault("ended without a result: " + client->getState().getText());
  if (client->getState() == actionlib::SimpleClientGoalState::REJECTED)
    return fault("refused the goal: " + client->getState().getText());
  // The server itself drops a goal whose stamp is before the last one's, with an empty result, which says
  // DONE.
  if (outcomeOf(result->outcome) == ActionOutcome::kDone &&
      client->getState() != actionlib::SimpleClientGoalState::SUCCEEDED)
    return fault(fmt::format("dropped the goal ({}: {}): is there another client, or one with another clock?",
                             client->getState().toString(), client->getState().getText()));
  return {outcomeOf(result->outcome), result->reason, result->planning_time, result->motion_time};
}

}  // namespace

RosTaskWorld::RosTaskWorld(const ModelBase* models, const TaskParameters& parameters,
                           std::function<bool()> cancelled)
    : models_(models),
      parameters_(parameters),
      cancelled_(std::move(cancelled)),
      arm_(parameters.arm),
      description_(loadArmDescription(parameters.urdf)),
      pick_(kPick, false),
      place_client_(kPlace, false),
      move_(kMove, false) {
  requireSameArm(description_, arm_);

  objects_subscriber_ = node_.subscribe(names::kLocatedObjects, 10, &RosTaskWorld::objectsCallback, this);

  grasp_targets_ = node_.serviceClient<GraspTargets>(kGraspTargets);
  forget_ = node_.serviceClient<ForgetObject>(kForget);
}

void RosTaskWorld::restart(const std::string& frame, bool go_on) {
  frame_ = frame;
  places_.restart(go_on);
}

void RosTaskWorld::wait(double seconds) {
  const Moment begin = Moment::now();
  while (!cancelled_() && begin.since() < seconds) kPoll.sleep();
}

void RosTaskWorld::objectsCallback(const LocatedObjectArray& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  view_ = message;
  if (withoutSlash(message.header.frame_id) != parameters_.base_frame) {
    view_->objects.clear();
    view_->refused =
        fmt::format("its objects are in the frame '{}' and must be in '{}' (the parameters base_frame)",
                    message.header.frame_id, parameters_.base_frame);
  }
  new_view_.notify_all();
}

std::optional<JointVector> RosTaskWorld::joints() const {
  const Moment begin = Moment::now();
  do {
    const RobotState robot = robot_.state();
    if (robot.joints && robot.joint_silence < parameters_.state_max_age) return robot.joints->joints;
    kPoll.sleep();
  } while (!cancelled_() && begin.since() < parameters_.answer_timeout);
  return std::nullopt;
}

/// As the last view told it.
std::optional<MappedObject> RosTaskWorld::frame() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!view_) return std::nullopt;
  for (const LocatedObject& object : view_->objects)
    if (object.name == frame_) return fromMessage(object, *models_);
  return std::nullopt;
}

/// Time went back: what was heard before does not answer what is asked from now on.
void RosTaskWorld::forgetFuture() {
  const ros::Time now = ros::Time::now();
  if (now.isZero()) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (view_ && secondsBetween(now, view_->header.stamp) > kFuture) view_.reset();
  recognizer_.forgetAfter(now + ros::Duration(kFuture));
}

TaskLook RosTaskWorld::look(const TaskView& view) {
  forgetFuture();
  TaskLook look;
  const std::optional<JointVector> current = joints();
  if (!current) {
    look.reason = "no joint_states of joint1 to joint6: is the arm's driver (or work_cell) running?";
    return look;
  }

  const Eigen::Vector3d target = lookTarget(view, frame(), parameters_.centre, *models_);
  const std::vector<Rigid3> poses =
      cameraViews(view, target, arm_, description_.tool0_from_camera, *current, parameters_.views);
  if (poses.empty()) {
    look.reason = "no camera pose from which to look there is within the arm's reach";
    return look;
  }

  MoveGoal goal;
  goal.link = names::kCameraFrame;
  for (const Rigid3& pose : poses) goal.poses.push_back(toPose(pose));
  const ActionResult moved = move(goal);
  if (!moved.done()) {
    look.reason = "the camera did not get there: " + moved.reason;
    return look;
  }

  // The clock may be later to arrive than the states it stamped: a view from before the motion must not
  // count.
  const ros::Time stands = std::max(ros::Time::now(), move_.getResult()->stamp);
  const ros::Time after = stands + ros::Duration(parameters_.settle);
  waitUntil(after);
  recognizer_.ask(after);
  const TaskLook seen = waitForView(after);
  recognizer_.ask(std::nullopt);
  return seen;
}

void RosTaskWorld::waitUntil(const ros::Time& moment) const {
  const Moment begin = Moment::now();
  while (ros::Time::now() < moment && !cancelled_() && begin.since() < parameters_.look_timeout)
    kTick.sleep();
}

EyeChain RosTaskWorld::eyeChain() const {
  EyeChain chain;
  recognizer_.describe(&chain);
  chain.located = objects_subscriber_.getTopic();
  chain.tells_located = objects_subscriber_.getNumPublishers() > 0;
  return chain;
}

TaskLook RosTaskWorld::waitForView(const ros::Time& after) {
  TaskLook look;
  std::string refused;
  int refusals = 0;
  ros::Time last;
  const Moment begin = Moment::now();
  std::unique_lock<std::mutex> lock(mutex_);

  while (true) {
    if (view_ && view_->header.stamp >= after) {
      if (view_->refused.empty()) break;
      refused = view_->refused;
      if (view_->header.stamp != last) ++refusals;
      last = view_->header.stamp;
    }
    if (cancelled_()) {
      look.reason = "cancelled";
      return look;
    }
    if (refusals == kRefusedViews || begin.since() > parameters_.look_timeout || recognizer_.gone()) {
      look.reason = refused.empty() ? missingInput(eyeChain(), after.toSec(), parameters_.look_timeout)
                                    : "eye_hand refuses the views: " + refused;
      return look;
    }
    new_view_.wait_for(lock, std::chrono::milliseconds(50));
  }

  look.done = true;
  look.stamp = view_->header.stamp.toSec();
  for (const LocatedObject& object : view_->objects) look.objects.push_back(fromMessage(object, *models_));
  return look;
}

bool RosTaskWorld::waitFor(ros::ServiceClient* service) const {
  const Moment begin = Moment::now();
  while (!service->exists()) {
    if (cancelled_() || begin.since() > parameters_.answer_timeout) return false;
    kPoll.sleep();
  }
  return true;
}

TaskGrasps RosTaskWorld::graspTargets(const MappedObject& object) {
  GraspTargets call;
  call.request.name = object.name;
  call.request.instance = object.number;
  if (!waitFor(&grasp_targets_) || !grasp_targets_.call(call))
    throw BadInput(
        fmt::format("the service {} does not answer: is the node eye_hand running?", kGraspTargets));
  return fromMessage(call.response, object, parameters_.base_frame);
}

ActionResult RosTaskWorld::pick(const PlannedGrasp& planned) {
  PickGoal goal;
  goal.target = toMessage(planned, parameters_.base_frame);
  goal.place = places_.next();
  return execute(&pick_, kPick, goal, parameters_, cancelled_);
}

TaskGrip RosTaskWorld::grip() {
  const RobotState robot = robot_.state();
  if (!robot.gripper || robot.gripper_silence > parameters_.state_max_age)
    return {false, false, "gripper/state is silent"};
  return gripOf(*robot.gripper, parameters_.holding_width);
}

ActionResult RosTaskWorld::carry(const MappedObject& object, int place) {
  PlaceGoal goal;
  goal.place = places_.of(place);
  ActionResult placed = execute(&place_client_, kPlace, goal, parameters_, cancelled_);
  if (!placed.done()) {
    const TaskGrip left = grip();
    if (left.known && !left.holding) places_.take(goal.place);  // stopped after it let go: it may lie there
    return placed;
  }
  places_.take(goal.place);
  ForgetObject call;
  call.request.name = object.name;
  call.request.instance = object.number;
  // It is carried out all the same; the next look finds out whether eye_hand is there.
  if (!waitFor(&forget_) || !forget_.call(call)) ROS_WARN("the service %s does not answer", kForget);
  return placed;
}

ActionResult RosTaskWorld::emptyHand() {
  const Moment begin = Moment::now();  // of a node that just started: nothing was heard yet
  while (!grip().known && !cancelled_() && begin.since() < parameters_.answer_timeout) kPoll.sleep();
  if (!grip().holding) return {ActionOutcome::kDone, ""};

  PlaceGoal goal;
  goal.place = places_.next();
  ActionResult placed = execute(&place_client_, kPlace, goal, parameters_, cancelled_);
  if (!placed.done()) return placed;
  places_.take(goal.place);
  places_.restart(true);
  return placed;
}

ActionResult RosTaskWorld::open() {
  const std::optional<JointVector> current = joints();
  if (!current) return {ActionOutcome::kFault, "no joint_states of joint1 to joint6"};
  MoveGoal goal;
  goal.joints.assign(current->data(), current->data() + 6);
  goal.open_gripper = true;
  return move(goal);
}

ActionResult RosTaskWorld::move(const MoveGoal& goal) {
  return execute(&move_, kMove, goal, parameters_, cancelled_);
}

}  // namespace monocular_eye_hand
