#pragma once
#include <sensor_msgs/JointState.h>

#include <array>
#include <optional>

#include "monocular_eye_hand/arm/puma560.h"

namespace monocular_eye_hand {

/// Where joint1 to joint6 are. `speeds`: has_speeds tells whether they are given.
struct ArmState {
  double stamp = 0;  ///< since then all six are known [s]
  JointVector joints = JointVector::Zero(), speeds = JointVector::Zero();
  bool has_speeds = false;
};

/// Puts the arm's state together from joint states, which may come in several messages, of several
/// publishers.
class ArmStates {
 public:
  /// The state that a message brings; none when it names none of the six joints, when one of them was never
  /// told or is not finite, and while the slowest publisher has told nothing new. A message without stamp
  /// counts as of `now` [s].
  std::optional<ArmState> add(const sensor_msgs::JointState& message, double now);

 private:
  struct Joint {
    double stamp = 0, position = 0, speed = 0;
    bool known = false, has_speed = false;
  };
  std::array<Joint, 6> joints_;
  double told_ = 0;  // stamp of the last state
};

}  // namespace monocular_eye_hand
