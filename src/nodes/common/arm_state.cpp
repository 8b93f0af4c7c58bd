#include "nodes/common/arm_state.h"

#include <algorithm>
#include <cmath>

#include "nodes/common/names.h"

namespace monocular_eye_hand {
namespace {

constexpr double kRestart = 1.0;  // stamps that go back by more begin again [s]

}  // namespace

std::optional<ArmState> ArmStates::add(const sensor_msgs::JointState& message, double now) {
  const double stamp = message.header.stamp.isZero() ? now : message.header.stamp.toSec();
  const bool has_speeds = message.velocity.size() == message.name.size();
  std::array<Joint, 6> joints = joints_;
  int named = 0;
  for (size_t k = 0; k < joints.size(); ++k) {
    const auto found = std::find(message.name.begin(), message.name.end(), names::kArmJoints[k]);
    const size_t at = size_t(found - message.name.begin());
    if (at >= message.position.size()) continue;
    joints[k] = {stamp, message.position[at], has_speeds ? message.velocity[at] : 0, true, has_speeds};
    if (!std::isfinite(joints[k].position) || !std::isfinite(joints[k].speed)) return std::nullopt;
    ++named;
  }
  if (named == 0) return std::nullopt;
  for (Joint& joint : joints)
    if (joint.stamp - stamp > kRestart) joint.known = false;  // of a time before this one
  joints_ = joints;

  ArmState state;
  state.stamp = joints[0].stamp;
  state.has_speeds = true;
  for (size_t k = 0; k < joints.size(); ++k) {
    if (!joints[k].known) return std::nullopt;
    state.stamp = std::min(state.stamp, joints[k].stamp);
    state.joints[int(k)] = joints[k].position;
    state.speeds[int(k)] = joints[k].speed;
    state.has_speeds = state.has_speeds && joints[k].has_speed;
  }
  const bool whole = named == int(joints.size());
  const bool newer = state.stamp > told_ || told_ - state.stamp > kRestart;
  if (!whole && !newer) return std::nullopt;
  told_ = state.stamp;
  return state;
}

}  // namespace monocular_eye_hand
