#include "simulation/cell/falling.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/mesh/stable_poses.h"

namespace monocular_eye_hand {
namespace {

constexpr double kGravity = 9.80665;
constexpr double kTipping = 0.4;  // a part that tips in place takes this long per radian [s]

}  // namespace

Fall::Fall(const Mesh& mesh, const Rigid3& from, const Rest& rest, double start)
    : from_(from), to_(rest.world_from_object), pivot_(centreOfMass(mesh)), start_(start) {
  const double height = (from_ * pivot_ - to_ * pivot_).norm();
  duration_ =
      std::max(std::sqrt(2 * height / kGravity), kTipping * angleBetween(from_.rotation, to_.rotation));
}

Rigid3 Fall::at(double time) const {
  if (time >= end()) return to_;
  const double share = std::pow(std::max(0.0, time - start_) / duration_, 2);
  const Eigen::Matrix3d rotation =
      from_.quaternion().slerp(share, to_.quaternion()).normalized().toRotationMatrix();
  const Eigen::Vector3d centre = (1 - share) * (from_ * pivot_) + share * (to_ * pivot_);
  return {rotation, centre - rotation * pivot_};
}

}  // namespace monocular_eye_hand
