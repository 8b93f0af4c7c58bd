#include "monocular_eye_hand/model/equal_poses.h"

#include <cmath>
#include <limits>

namespace monocular_eye_hand {

Rigid3 rotationAbout(const Eigen::Vector3d& point, const Eigen::Matrix3d& rotation) {
  return {rotation, point - rotation * point};
}

Rigid3 rotationAbout(const SymmetryAxis& axis, double angle) {
  return rotationAbout(axis.point, Eigen::AngleAxisd(angle, axis.direction).toRotationMatrix());
}

Rigid3 turnedTowards(const ObjectModel& model, const Rigid3& pose, const Rigid3& wanted) {
  const Eigen::Matrix3d relative = pose.rotation.transpose() * wanted.rotation;
  if (model.symmetries.axis) {
    // The part of the remaining rotation that is about the axis.
    const Eigen::Quaterniond q(relative);
    const SymmetryAxis& axis = *model.symmetries.axis;
    return pose * rotationAbout(axis, 2 * std::atan2(q.vec().dot(axis.direction), q.w()));
  }
  if (model.symmetries.sphere) return pose * rotationAbout(model.centre(), relative);
  return pose;
}

Rigid3 nearestEqualPose(const ObjectModel& model, const Rigid3& pose, const Rigid3& wanted) {
  Rigid3 best = pose;
  double min_angle = std::numeric_limits<double>::max();
  for (const Rigid3& s : model.symmetries.discrete) {
    const Rigid3 equal = turnedTowards(model, pose * s, wanted);
    const double angle = angleBetween(equal.rotation, wanted.rotation);
    if (angle < min_angle - 1e-9) {
      min_angle = angle;
      best = equal;
    }
  }
  return best;
}

}  // namespace monocular_eye_hand
