#include "nodes/eye_hand/hand_input.h"

#include <cmath>
#include <sstream>

#include "monocular_eye_hand/geometry/seconds_text.h"
#include "nodes/common/conversion.h"
#include "nodes/common/gripper_reading.h"
#include "nodes/common/moment.h"
#include "nodes/common/names.h"
#include "nodes/common/optical_frame.h"
#include "nodes/common/stamps.h"
#include "nodes/eye_hand/conversion.h"

namespace monocular_eye_hand {
namespace {

constexpr double kPoll = 0.005;      // while waiting for what is late [s]
constexpr double kSpeedSpan = 0.05;  // over which a joint's speed is measured [s]
constexpr double kLongestWait =
    10;  // in `wait`s of the wall clock, when the clock stands: a bag may have ended
const double kLevel = std::cos(0.02);  // of the table's normal against base's z

// tf ends its sentences in several ways.
std::string withoutFullStop(const std::string& text) {
  return text.substr(0, text.find_last_not_of(" .") + 1);
}

}  // namespace

HandInput::HandInput(const EyeHandParameters& parameters, const Puma560& arm)
    : parameters_(parameters),
      arm_(arm),
      history_(parameters.joint_names, parameters.memory),
      grippers_(parameters.memory),
      buffer_(ros::Duration(parameters.memory)),
      listener_(buffer_) {
  joints_ = ros::NodeHandle().subscribe<sensor_msgs::JointState>(
      names::kJointStates, 200,
      [this](const sensor_msgs::JointStateConstPtr& message) { history_.add(*message, ros::Time::now()); },
      {}, ros::TransportHints().tcpNoDelay());
  gripper_ = ros::NodeHandle().subscribe<GripperState>(
      names::kGripperState, 200,
      [this](const GripperStateConstPtr& state) { grippers_.add(*state, ros::Time::now()); });
}

std::string HandInput::tableHeight(const ros::Time& stamp, double* height) const {
  *height = parameters_.table_height;
  if (!parameters_.table || parameters_.table_frame.empty()) return "";
  Rigid3 base_from_table;
  const std::string problem =
      lookUp(parameters_.base_frame, parameters_.table_frame, stamp, &base_from_table);
  if (!problem.empty()) return problem + " (the parameter table_frame)";
  if (base_from_table.rotation(2, 2) < kLevel)
    return "table_frame = " + parameters_.table_frame + " is not level in " + parameters_.base_frame +
           ": its z axis must point up";
  *height += base_from_table.translation.z();
  return "";
}

HandAtStamp HandInput::at(const ros::Time& stamp, const std::string& camera_frame,
                          const std::function<bool()>& stop) const {
  const Moment begin = Moment::now();
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kLongestWait * parameters_.wait);
  HandAtStamp result;
  JointVector joints;
  auto match = JointHistory::Match::kNone;
  std::string tool_problem, camera_problem, table_problem;
  while (true) {
    const bool last = begin.since() >= parameters_.wait || ros::WallTime::now() >= end || stop();
    tool_problem =
        lookUp(parameters_.base_frame, parameters_.tool_frame, stamp, &result.hand.base_from_tool0);
    camera_problem = lookUp(parameters_.tool_frame, camera_frame, stamp, &result.hand_eye.tool0_from_camera);
    table_problem = tableHeight(stamp, &result.table_height);
    match = history_.at(stamp, parameters_.max_joint_gap, &joints);
    const bool transforms = tool_problem.empty() && camera_problem.empty() && table_problem.empty();
    if (last || (transforms && match == JointHistory::Match::kBetween)) break;
    ros::WallDuration(kPoll).sleep();
  }

  if (!tool_problem.empty())
    result.problem = tool_problem + " (start robot_state_publisher, or the arm's driver)";
  else if (!camera_problem.empty())
    result.problem = camera_problem + " (the hand-eye transform: publish the calibration's result)";
  else if (!table_problem.empty())
    result.problem = table_problem;
  else if (match == JointHistory::Match::kNone)
    result.problem = noJointsText(stamp);
  if (!result.problem.empty()) return result;

  if (const auto gripper = grippers_.at(stamp, parameters_.max_joint_age))
    result.gripper = fromMessage(*gripper);
  result.moves = history_.speedAt(stamp, kSpeedSpan, parameters_.max_joint_gap) > parameters_.still;
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
  const double age = secondsBetween(stamp, ros::Time::now());
  if (age <= parameters_.max_joint_age) return "";
  return "the last joint state on " + joints_.getTopic() + " is " + secondsText(age) + " old";
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

std::string HandInput::opticalFrameIn(const std::string& frame) const {
  return monocular_eye_hand::opticalFrameIn(buffer_, frame);
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
    text << ": the latest one is " << secondsText(secondsBetween(latest, stamp)) << " older";
  return text.str();
}

}  // namespace monocular_eye_hand
