#include "nodes/task/world.h"

#include <chrono>
#include <thread>
#include <utility>

#include "monocular_eye_hand/arm/load_arm_description.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/seconds_text.h"
#include "nodes/common/action_outcome.h"
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
constexpr std::chrono::milliseconds kSlowTopic(200);     // the objects may come so much later than the answer
constexpr std::chrono::milliseconds kSlowEyeHand(1000);  // ... and their view after them
constexpr double kGone = 3.0;          // a recogniser that is not there for so long is told [s]
constexpr int kRefusedViews = 3;       // in a row: waiting on helps no more
constexpr double kOneClock = 86400.0;  // stamps of one clock do not lie further apart [s]
constexpr double kFuture = 1.0;        // nor so far ahead of it [s]

std::string complaintOf(const RecognizeResponse& response) {
  const bool worked =
      response.status == RecognizeResponse::FOUND || response.status == RecognizeResponse::NOT_FOUND;
  return worked ? "" : response.text;
}

/// Sends a goal and waits for its result. A cancelled task cancels the goal and waits on: the planner stops
/// the arm and says so.
template <class Client, class Goal>
ActionResult execute(Client* client, const char* action, const Goal& goal, const TaskParameters& parameters,
                     const std::function<bool()>& cancelled) {
  const std::string called(action);
  const auto fault = [&](const std::string& what) {
    return ActionResult{ActionOutcome::kFault, "the action " + called + " " + what};
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
      return fault("took longer than motion_timeout = " + std::to_string(parameters.motion_timeout) + " s");
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
    return fault("dropped the goal (" + client->getState().toString() + ": " + client->getState().getText() +
                 "): is there another client, or one with another clock?");
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
  recognized_subscriber_ =
      node_.subscribe(names::kRecognizedObjects, 10, &RosTaskWorld::recognizedCallback, this);
  gripper_subscriber_ = node_.subscribe(names::kGripperState, 10, &RosTaskWorld::gripperCallback, this);
  joints_subscriber_ = node_.subscribe(names::kJointStates, 10, &RosTaskWorld::jointsCallback, this);

  recognize_ = node_.serviceClient<Recognize>(names::kAskRecognizer);
  grasp_targets_ = node_.serviceClient<GraspTargets>(kGraspTargets);
  forget_ = node_.serviceClient<ForgetObject>(kForget);
  asker_ = std::thread(&RosTaskWorld::askRecognizer, this);
}

RosTaskWorld::~RosTaskWorld() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  asked_.notify_all();
  asker_.join();
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
    view_->refused = "its objects are in the frame '" + message.header.frame_id + "' and must be in '" +
                     parameters_.base_frame + "' (the parameters base_frame)";
  }
  new_view_.notify_all();
}

void RosTaskWorld::recognizedCallback(const RecognizedObjectArray& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  recognized_ = message.header.stamp;
  recognized_at_ = Moment::now();
  asked_.notify_all();
}

void RosTaskWorld::gripperCallback(const GripperState& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  gripper_ = message;
  gripper_at_ = Moment::now();
}

void RosTaskWorld::jointsCallback(const sensor_msgs::JointState& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::optional<ArmState> state = arm_states_.add(fromMessage(message, ros::Time::now()));
  if (!state) return;  // another device's message, or not yet all of the arm
  joints_ = state->joints;
  joints_at_ = Moment::now();
}

std::optional<JointVector> RosTaskWorld::joints() const {
  const Moment begin = Moment::now();
  do {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (joints_ && joints_at_.since() < parameters_.state_max_age) return joints_;
    }
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
  const std::lock_guard<std::mutex> lock(mutex_);
  if (now.isZero()) return;
  if (view_ && secondsBetween(now, view_->header.stamp) > kFuture) view_.reset();
  if (secondsBetween(now, recognized_) > kFuture) recognized_ = ros::Time();
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
  ask(after);
  const TaskLook seen = waitForView(after);
  ask(std::nullopt);
  return seen;
}

void RosTaskWorld::waitUntil(const ros::Time& moment) const {
  const Moment begin = Moment::now();
  while (ros::Time::now() < moment && !cancelled_() && begin.since() < parameters_.look_timeout)
    kTick.sleep();
}

void RosTaskWorld::ask(const std::optional<ros::Time>& after) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ask_after_ = after;
  gone_now_ = false;
  complaint_.clear();
  asked_.notify_all();
}

/// Its service is not there, and for as long nothing came from it.
bool RosTaskWorld::recognizerGone() const {
  const bool silent = recognized_at_.never() || recognized_at_.since() >= kGone;
  return gone_now_ && silent && gone_at_.since() >= kGone;
}

/// A recogniser that works on request does so now; one that works on every image answers with the next. Asks
/// again when the answer is of an image that was on its way before, and when eye_hand makes no use of it. A
/// thread of its own: a recogniser that hangs does not answer for ever.
void RosTaskWorld::askRecognizer() {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto wanted = [this] { return ending_ || ask_after_; };
  const auto enough = [this] { return ending_ || !ask_after_; };

  while (true) {
    asked_.wait(lock, wanted);
    if (ending_) return;
    const ros::Time after = *ask_after_;
    lock.unlock();
    Recognize call;
    const bool there = recognize_.exists();
    const bool answered = there && recognize_.call(call);
    lock.lock();

    if (there)
      gone_at_ = Moment();
    else if (gone_at_.never())
      gone_at_ = Moment::now();
    gone_now_ = !there && ask_after_;
    complaint_ = answered ? complaintOf(call.response) : "";

    const auto recognized = [&] { return enough() || recognized_ >= after; };
    if (!answered)
      asked_.wait_for(lock, kSlowTopic, enough);
    else if (asked_.wait_for(lock, kSlowTopic, recognized) && !enough())
      asked_.wait_for(lock, kSlowEyeHand, enough);
  }
}

std::string RosTaskWorld::silence(const ros::Time& after) const {
  const std::string recognized = recognized_subscriber_.getTopic(), located = objects_subscriber_.getTopic();
  if (recognizerGone())
    return "the node recognizer does not run (any more): its service " +
           node_.resolveName(names::kAskRecognizer) + " is not there";

  std::string who;
  if (recognized_subscriber_.getNumPublishers() == 0)
    who = "nobody publishes " + recognized + ": is the node recognizer running?";
  else if (recognized_.isZero())
    who = recognized + " is silent: does the camera send images to the recognizer?";
  else if (recognized_ < after)
    who = recognized + " last answered for an image of " + secondsText(recognized_.toSec(), 2) +
          ", the camera stands still since " + secondsText(after.toSec(), 2) + ": " +
          (secondsBetween(recognized_, after) > kOneClock
               ? "do the nodes share one clock? use_sim_time must be set before they start"
               : "does the camera send images to the recognizer?");
  else if (objects_subscriber_.getNumPublishers() == 0)
    who = "nobody publishes " + located + ": is the node eye_hand running?";
  else
    who = located + " is silent, though the recognizer is not: look at the node eye_hand";

  if (!complaint_.empty()) who += "; the recognizer says: " + complaint_;
  return "no view within look_timeout = " + std::to_string(parameters_.look_timeout) + " s; " + who;
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
    if (refusals == kRefusedViews || begin.since() > parameters_.look_timeout || recognizerGone()) {
      look.reason = refused.empty() ? silence(after) : "eye_hand refuses the views: " + refused;
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
    throw BadInput(std::string("the service ") + kGraspTargets +
                   " does not answer: is the node eye_hand running?");
  return fromMessage(call.response, object, parameters_.base_frame);
}

ActionResult RosTaskWorld::pick(const PlannedGrasp& planned) {
  PickGoal goal;
  goal.target = toMessage(planned, parameters_.base_frame);
  goal.place = places_.next();
  return execute(&pick_, kPick, goal, parameters_, cancelled_);
}

TaskGrip RosTaskWorld::grip() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!gripper_ || gripper_at_.since() > parameters_.state_max_age)
    return {false, false, "gripper/state is silent"};
  return gripOf(fromMessage(*gripper_, gripper_->header.stamp), parameters_.holding_width);
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
