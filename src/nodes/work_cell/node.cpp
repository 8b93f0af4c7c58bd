#include "nodes/work_cell/node.h"

#include <ros/callback_queue.h>

#include <algorithm>
#include <chrono>
#include <functional>

#include "monocular_eye_hand/geometry/error.h"
#include "nodes/common/names.h"

namespace monocular_eye_hand {
namespace {

constexpr double kFirstTime = 1;  // cell time of the first message [s]: to ROS, time 0 means "not known yet"

double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

JointCommand fromMessage(const trajectory_msgs::JointTrajectory& message) {
  JointCommand command;
  command.stamp = message.header.stamp.toSec();
  command.joint_names = message.joint_names;
  for (const trajectory_msgs::JointTrajectoryPoint& point : message.points)
    command.points.push_back(
        {point.time_from_start.toSec(), point.positions, point.velocities, point.accelerations});
  return command;
}

/// What the cell refuses is logged with the topic that it came by.
void take(const ros::Subscriber& from, const std::function<void()>& command) {
  try {
    command();
  } catch (const BadInput& e) {
    ROS_ERROR("%s refused: %s", from.getTopic().c_str(), e.what());
  }
}

}  // namespace

WorkCellNode::WorkCellNode(WorkCell cell, const WorkCellParameters& parameters)
    : images_in_motion_(parameters.images_in_motion),
      cell_(std::move(cell)),
      outputs_(cell_, parameters.camera_threads),
      pace_(parameters.real_time_factor),
      joint_instants_(parameters.joint_rate, nanosecondsOf(kFirstTime)),
      camera_instants_(parameters.camera_rate, nanosecondsOf(kFirstTime)),
      truth_instants_(parameters.truth_rate, nanosecondsOf(kFirstTime)) {
  cell_.advance(kFirstTime);
  trajectory_subscriber_ = node_.subscribe(names::kArmCommand, 10, &WorkCellNode::onTrajectory, this);
  width_subscriber_ = node_.subscribe(names::kGripperCommand, 10, &WorkCellNode::onWidth, this);
  take_away_subscriber_ =
      ros::NodeHandle("~").subscribe(names::kTakeAway, 10, &WorkCellNode::onTakeAway, this);
}

Nanoseconds WorkCellNode::now() const { return nanosecondsOf(cell_.time()); }

Nanoseconds WorkCellNode::nextInstant() const {
  Nanoseconds next = std::min({joint_instants_.next(), camera_instants_.next(), truth_instants_.next()});
  if (waiting_) next = std::min(next, nanosecondsOf(waiting_->start));
  return std::max(next, now());
}

bool WorkCellNode::driven() const { return cell_.armMoving() || cell_.gripperMoving(); }

bool WorkCellNode::moving() const {
  if (driven()) return true;
  const std::vector<CellTruth> objects = cell_.truth();
  return std::any_of(objects.begin(), objects.end(), [](const CellTruth& object) { return object.falling; });
}

void WorkCellNode::takeCommands() {
  double wait = 1;
  while (ros::ok() && wait > 0) {
    // While only parts fall the next command may be on its way: it must not come seconds of the cell too
    // late.
    wait = pace_.wait(double(nextInstant()) * 1e-9, steadySeconds(), driven());
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(wait));  // back at the first command
  }
}

void WorkCellNode::startWaiting() {
  if (!waiting_ || nanosecondsOf(waiting_->start) > now()) return;
  cell_.commandArm(waiting_->path);
  waiting_.reset();
}

void WorkCellNode::publishDue() {
  const bool camera = camera_instants_.pass(now()), joints = joint_instants_.pass(now());
  if (joints || camera) {  // the arm's pose at every exposure is known before its image
    outputs_.joints();
    outputs_.clock();
  }
  if (truth_instants_.pass(now()) || outputs_.newEvents()) outputs_.truth();
  if (camera && (images_in_motion_ || !moving())) outputs_.camera();
}

void WorkCellNode::run() {
  publishDue();
  while (ros::ok()) {
    takeCommands();
    cell_.advance(double(nextInstant() - now()) * 1e-9);
    startWaiting();
    publishDue();
  }
}

void WorkCellNode::onTrajectory(const trajectory_msgs::JointTrajectory& message) {
  take(trajectory_subscriber_, [&] {
    const ArmCommand command = armCommand(fromMessage(message), cell_.time());
    waiting_.reset();
    if (command.start > cell_.time())
      waiting_ = command;
    else
      cell_.commandArm(command.path);
  });
}

void WorkCellNode::onWidth(const std_msgs::Float64& message) {
  take(width_subscriber_, [&] { cell_.commandGripper(message.data); });
}

void WorkCellNode::onTakeAway(const std_msgs::String& message) {
  take(take_away_subscriber_, [&] { cell_.takeAway(message.data); });
}

}  // namespace monocular_eye_hand
