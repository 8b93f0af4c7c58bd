#include "monocular_eye_hand/arm/arm_state.h"

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {

const std::array<std::string, 6>& armJointNames() {
  static const std::array<std::string, 6> names{{"joint1", "joint2", "joint3", "joint4", "joint5", "joint6"}};
  return names;
}

std::optional<ArmState> ArmStates::add(const JointSample& sample) {
  const double stamp = secondsOf(sample.stamp);
  const bool has_speeds = sample.speeds.size() == sample.names.size();
  std::array<Joint, 6> joints = joints_;
  int named = 0;
  for (size_t k = 0; k < joints.size(); ++k) {
    const auto found = std::find(sample.names.begin(), sample.names.end(), armJointNames()[k]);
    const size_t at = size_t(found - sample.names.begin());
    if (at >= sample.positions.size()) continue;
    joints[k] = {stamp, sample.positions[at], has_speeds ? sample.speeds[at] : 0, true, has_speeds};
    if (!std::isfinite(joints[k].position) || !std::isfinite(joints[k].speed)) return std::nullopt;
    ++named;
  }
  if (named == 0) return std::nullopt;
  for (Joint& joint : joints)
    if (joint.stamp - stamp > kTimeRestart) joint.known = false;  // of a time before this one
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
  const bool newer = state.stamp > last_stamp_ || last_stamp_ - state.stamp > kTimeRestart;
  if (!whole && !newer) return std::nullopt;
  last_stamp_ = state.stamp;
  return state;
}

}  // namespace monocular_eye_hand
