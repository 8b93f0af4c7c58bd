#pragma once
#include <array>
#include <optional>
#include <string>

#include "monocular_eye_hand/arm/joint_sample.h"
#include "monocular_eye_hand/arm/puma560.h"

namespace monocular_eye_hand {

/// The arm's joints by their names in urdf/puma560.urdf, from the base to the flange.
const std::array<std::string, 6>& armJointNames();

/// Where joint1 to joint6 are. `speeds`: has_speeds tells whether they are given.
struct ArmState {
  double stamp = 0;  ///< since then all six are known [s]
  JointVector joints = JointVector::Zero(), speeds = JointVector::Zero();
  bool has_speeds = false;
};

/// Puts the arm's state together from samples, which may come in several parts, of several devices.
class ArmStates {
 public:
  /// The state that a sample brings; none when it names none of the six joints, when one of them was never
  /// told or is not finite, and while the slowest device has told nothing new.
  std::optional<ArmState> add(const JointSample& sample);

 private:
  struct Joint {
    double stamp = 0, position = 0, speed = 0;
    bool known = false, has_speed = false;
  };
  std::array<Joint, 6> joints_;
  double last_stamp_ = 0;  // of the last state
};

}  // namespace monocular_eye_hand
