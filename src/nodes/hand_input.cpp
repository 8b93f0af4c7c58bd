#include "nodes/hand_input.h"

#include <sstream>

#include "nodes/eye_hand_conversion.h"
#include "nodes/names.h"

namespace monocular_eye_hand {
namespace {

constexpr double kPoll = 0.005;  // while waiting for what is late [s]

// tf ends its sentences in several ways.
std::string withoutFullStop(const std::string& text) {
  return text.substr(0, text.find_last_not_of(" .") + 1);
}

}  // namespace

HandInput::HandInput(const EyeHandParameters& parameters, const Puma560& arm)
    : parameters_(parameters),
      arm_(arm),
      history_(parameters.joint_names, parameters.memory),
      buffer_(ros::Duration(parameters.memory)),
      listener_(buffer_) {
  joints_ = ros::NodeHandle().subscribe<sensor_msgs::JointState>(
      names::kJointStates, 200,
      [this](const sensor_msgs::JointStateConstPtr& message) { history_.add(*message, ros::Time::now()); },
      {}, ros::TransportHints().tcpNoDelay());
}

HandAtStamp HandInput::at(const ros::Time& stamp, const std::string& camera_frame,
                          const std::function<bool()>& stop) const {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(parameters_.wait);
  HandAtStamp result;
  JointVector joints;
  auto match = JointHistory::Match::kNone;
  std::string tool_problem, camera_problem;
  while (true) {
    const bool last = ros::WallTime::now() >= end || stop();
    tool_problem =
        lookUp(parameters_.base_frame, parameters_.tool_frame, stamp, &result.hand.base_from_tool0);
    camera_problem = lookUp(parameters_.tool_frame, camera_frame, stamp, &result.hand_eye.tool0_from_camera);
    match = history_.at(stamp, parameters_.max_joint_gap, &joints);
    if (last || (tool_problem.empty() && camera_problem.empty() && match == JointHistory::Match::kBetween))
      break;
    ros::WallDuration(kPoll).sleep();
  }
  if (!tool_problem.empty())
    result.problem = tool_problem + " (start robot_state_publisher, or the arm's driver)";
  else if (!camera_problem.empty())
    result.problem = camera_problem + " (the hand-eye transform: publish the calibration's result)";
  else if (match == JointHistory::Match::kNone)
    result.problem = noJointsText(stamp);
  if (!result.problem.empty()) return result;
  const HandPose by_joints = handPose(arm_, joints);
  result.hand.jacobian = by_joints.jacobian;
  if (match != JointHistory::Match::kBetween) return result;  // moving: an angle nearby proves nothing
  const Vector6d gap = difference(by_joints.base_from_tool0, result.hand.base_from_tool0);
  if (gap.head<3>().norm() <= parameters_.max_tf_distance && gap.tail<3>().norm() <= parameters_.max_tf_turn)
    return result;
  std::ostringstream text;
  text << "tf puts " << parameters_.tool_frame << " " << 1000 * gap.head<3>().norm() << " mm and "
       << gap.tail<3>().norm() << " rad from where the joint states put it in " << parameters_.base_frame
       << ": one of them is not this arm's, or its frames are not";
  result.problem = text.str();
  return result;
}

std::string HandInput::current(JointVector* joints) const {
  ros::Time stamp;
  if (!history_.latest(joints, &stamp))
    return "no joint states on " + joints_.getTopic() + ": " + history_.problem();
  const double age = (ros::Time::now() - stamp).toSec();
  if (age <= parameters_.max_joint_age) return "";
  std::ostringstream text;
  text << "the last joint state on " << joints_.getTopic() << " is " << age << " s old";
  return text.str();
}

std::string HandInput::lookUp(const std::string& target, const std::string& source, const ros::Time& stamp,
                              Rigid3* target_from_source) const {
  try {
    *target_from_source = fromTransform(buffer_.lookupTransform(target, source, stamp).transform);
    return "";
  } catch (const tf2::TransformException& e) {
    return "no transform from " + source + " to " + target +
           " at the image's stamp: " + withoutFullStop(e.what());
  }
}

std::string HandInput::noJointsText(const ros::Time& stamp) const {
  JointVector joints;
  ros::Time latest;
  std::ostringstream text;
  text << "no joint state within " << parameters_.max_joint_gap << " s of the image's stamp on "
       << joints_.getTopic();
  if (!history_.latest(&joints, &latest))
    text << ": " << history_.problem();
  else
    text << ": the latest one is " << (stamp - latest).toSec() << " s older";
  return text.str();
}

}  // namespace monocular_eye_hand
