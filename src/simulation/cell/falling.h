#pragma once
#include "simulation/scenes/settling.h"

namespace monocular_eye_hand {

/// A part on its way from the gripper to where it comes to rest: its centre of mass falls freely while the
/// part tips.
class Fall {
 public:
  Fall(const Mesh& mesh, const Rigid3& from, const Rest& rest, double start);
  double end() const { return start_ + duration_; }
  Rigid3 at(double time) const;

 private:
  Rigid3 from_, to_;
  Eigen::Vector3d pivot_;  // centre of mass, object frame
  double start_, duration_;
};

}  // namespace monocular_eye_hand
