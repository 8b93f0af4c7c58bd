#include "nodes/eye_hand/hand_input.h"

#include <fmt/format.h>

#include <cmath>

#include "nodes/common/conversion.h"
#include "nodes/common/moment.h"
#include "nodes/common/names.h"
#include "nodes/common/optical_frame.h"
#include "nodes/common/robot_messages.h"
#include "nodes/common/stamps.h"

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
      [this](const sensor_msgs::JointStateConstPtr& message) {
        history_.add(fromMessage(*message, ros::Time::now()));
      },
      {}, ros::TransportHints().tcpNoDelay());
  gripper_ = ros::NodeHandle().subscribe<GripperState>(
      names::kGripperState, 200, [this](const GripperStateConstPtr& message) {
        const ros::Time now = ros::Time::now();
        grippers_.add(nanoseconds(stampOr(message->header.stamp, now)), fromMessage(*message, now));
      });
}

std::string HandInput::tableHeight(const ros::Time& stamp, double* height) const {
  *height = parameters_.table_height;
  if (!parameters_.table || parameters_.table_frame.empty()) return "";
  Rigid3 base_from_table;
  const std::string problem =
      lookUp(parameters_.base_frame, parameters_.table_frame, stamp, &base_from_table);
  if (!problem.empty()) return problem + " (the parameter table_frame)";
  if (base_from_table.rotation(2, 2) < kLevel)
    return fmt::format("table_frame = {} is not level in {}: its z axis must point up",
                       parameters_.table_frame, parameters_.base_frame);
  *height += base_from_table.translation.z();
  return "";
}

HandAtStamp HandInput::at(const ros::Time& stamp, const std::string& camera_frame,
                          const std::function<bool()>& stop) const {
  const Moment begin = Moment::now();
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kLongestWait * parameters_.wait);
  HandAtStamp result;
  JointHistory::Found found;

  std::string tool_problem, camera_problem, table_problem;
  while (true) {
    const bool last = begin.since() >= parameters_.wait || ros::WallTime::now() >= end || stop();
    tool_problem =
        lookUp(parameters_.base_frame, parameters_.tool_frame, stamp, &result.hand.base_from_tool0);
    camera_problem = lookUp(parameters_.tool_frame, camera_frame, stamp, &result.hand_eye.tool0_from_camera);
    table_problem = tableHeight(stamp, &result.table_height);
    found = history_.at(nanoseconds(stamp), parameters_.max_joint_gap);
    const bool transforms = tool_problem.empty() && camera_problem.empty() && table_problem.empty();
    if (last || (transforms && found.match == JointHistory::Match::kBetween)) break;
    ros::WallDuration(kPoll).sleep();
  }

  if (!tool_problem.empty())
    result.problem = tool_problem + " (start robot_state_publisher, or the arm's driver)";
  else if (!camera_problem.empty())
    result.problem = camera_problem + " (the hand-eye transform: publish the calibration's result)";
  else if (!table_problem.empty())
    result.problem = table_problem;
  else if (found.match == JointHistory::Match::kNone)
    result.problem = noJointsText(stamp);
  if (!result.problem.empty()) return result;

  result.gripper = grippers_.at(nanoseconds(stamp), parameters_.max_joint_age);
  result.moves =
      history_.speedAt(nanoseconds(stamp), kSpeedSpan, parameters_.max_joint_gap) > parameters_.still;
  const HandPose by_joints = handPose(arm_, found.joints);
  result.hand.jacobian = by_joints.jacobian;
  if (found.match != JointHistory::Match::kBetween) return result;  // moving: an angle nearby proves nothing

  result.problem = mismatch(by_joints.base_from_tool0, result.hand.base_from_tool0);
  return result;
}

std::string HandInput::mismatch(const Rigid3& by_joints, const Rigid3& by_tf) const {
  const Vector6d gap = difference(by_joints, by_tf);
  const double distance = gap.head<3>().norm(), angle = gap.tail<3>().norm();
  if (distance <= parameters_.max_tf_distance && angle <= parameters_.max_tf_rotation) return "";

  return fmt::format(
      "tf puts {} {:.3g} mm and {:.3g} rad from where the joint states put it in {}: one of them is not this "
      "arm's, or "
      "its frames are not",
      parameters_.tool_frame, 1000 * distance, angle, parameters_.base_frame);
}

ArmNow HandInput::now() const {
  const std::optional<JointHistory::Latest> latest = history_.latest();
  if (!latest) return {{}, fmt::format("no joint states on {}: {}", joints_.getTopic(), history_.problem())};
  const double age = secondsBetween(latest->stamp, nanoseconds(ros::Time::now()));
  if (age <= parameters_.max_joint_age) return {latest->joints, ""};
  return {latest->joints, fmt::format("the last joint state on {} is {:.3f} s old", joints_.getTopic(), age)};
}

std::string HandInput::lookUp(const std::string& target, const std::string& source, const ros::Time& stamp,
                              Rigid3* target_from_source) const {
  try {
    *target_from_source = fromTransform(buffer_.lookupTransform(target, source, stamp).transform);
    return "";
  } catch (const tf2::TransformException& e) {
    return fmt::format("no transform from {} to {} at the image's stamp: {}", source, target,
                       withoutFullStop(e.what()));
  }
}

std::string HandInput::opticalFrameIn(const std::string& frame) const {
  return monocular_eye_hand::opticalFrameIn(buffer_, frame);
}

std::string HandInput::noJointsText(const ros::Time& stamp) const {
  const std::optional<JointHistory::Latest> latest = history_.latest();
  const std::string why = latest ? fmt::format("the latest one is {:.3f} s older",
                                               secondsBetween(latest->stamp, nanoseconds(stamp)))
                                 : history_.problem();
  return fmt::format("no joint state within {:g} s of the image's stamp on {}: {}", parameters_.max_joint_gap,
                     joints_.getTopic(), why);
}

}  // namespace monocular_eye_hand
