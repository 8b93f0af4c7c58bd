#include "recognition/support.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/length_text.h"
#include "monocular_eye_hand/mesh/stable_poses.h"

namespace monocular_eye_hand {
namespace {

constexpr double kSigmas = 3;        // of a pose's height below which it contradicts the plane
constexpr double kRuledOut = -1000;  // log-odds that nothing outweighs
// Of a part that rests, beside the pose's own: dirt, burrs, the table [rad].
constexpr double kSigmaOfTilt = 0.04;
// A pose whose rotation or height is less certain is not taken to rest farther off [rad], [m].
constexpr double kWidestTilt = 0.1, kWidestGap = 0.01;

double squared(double x) { return x * x; }

struct Height {
  double value = 0;  // [m]
  double sigma = 0;  // [m]
};

// Of the point of the part that is lowest.
Height lowestHeight(const SupportPlane& plane, const ObjectModel& model, const RefinedPose& pose) {
  const Rigid3& camera_from_object = pose.camera_from_object;
  const Eigen::Vector3d up = camera_from_object.rotation.transpose() * plane.normal;
  double min_along = std::numeric_limits<double>::max();
  Eigen::Vector3d lowest = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& vertex : model.mesh.vertices) {
    const double along = up.dot(vertex);
    if (along >= min_along) continue;
    min_along = along;
    lowest = vertex;
  }

  const Eigen::Vector3d arm = camera_from_object.rotation * lowest;
  Vector6d gradient;
  gradient << plane.normal, arm.cross(plane.normal);
  const double variance = gradient.dot(pose.covariance * gradient);
  return {plane.normal.dot(camera_from_object.translation) + min_along - plane.offset,
          std::sqrt(std::max(0.0, variance))};
}

double angleBetweenUnits(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Between the part's upright as it stands and the nearest one at rest; turns that cannot be seen do not
// count.
double tiltFromRest(const ObjectModel& model, const std::vector<Eigen::Vector3d>& up_at_rest,
                    const Eigen::Vector3d& up) {
  if (model.symmetries.sphere) return 0;
  double min_tilt = M_PI;
  for (const Eigen::Vector3d& rest : up_at_rest) {
    min_tilt = std::min(min_tilt, angleBetweenUnits(rest, up));
    if (!model.symmetries.axis) continue;
    const Eigen::Vector3d& axis = model.symmetries.axis->direction;
    min_tilt = std::min(min_tilt, std::abs(angleBetweenUnits(rest, axis) - angleBetweenUnits(up, axis)));
  }
  return min_tilt;
}

// Sigma of the tilt: of the rotations about the two axes in the plane, the worse one.
double sigmaOfTilt(const SupportPlane& plane, const RefinedPose& pose) {
  const Eigen::Matrix3d rotation = pose.covariance.bottomRightCorner<3, 3>();
  const Eigen::Vector3d side = plane.normal.unitOrthogonal(), other = plane.normal.cross(side);
  return std::sqrt(std::max({0.0, side.dot(rotation * side), other.dot(rotation * other)}));
}

}  // namespace

std::vector<Eigen::Vector3d> directionsUpAtRest(const ObjectModel& model) {
  std::vector<Eigen::Vector3d> directions;
  try {
    for (const StablePose& pose : stablePoses(model.mesh))
      directions.push_back(pose.table_from_object.rotation.row(2).transpose());
  } catch (const BadInput&) {
    // A sheet without thickness rests in no way that its mesh tells.
  }
  return directions;
}

SupportEvidence evidenceOfSupport(const Support& support, int object, const ObjectModel& model,
                                  const RefinedPose& pose) {
  const SupportPlane& plane = support.plane;
  const Height lowest = lowestHeight(plane, model, pose);
  SupportEvidence evidence;
  if (lowest.value < -plane.tolerance - kSigmas * lowest.sigma) {
    evidence.refused = "reaches " + millimetresText(-lowest.value) + " below the support plane";
    evidence.log_odds = kRuledOut;
    return evidence;
  }

  const Eigen::Vector3d up = pose.camera_from_object.rotation.transpose() * plane.normal;
  const double tilt = tiltFromRest(model, support.up_at_rest[size_t(object)], up);
  const double tilt_sigma = std::min(kWidestTilt, std::hypot(kSigmaOfTilt, sigmaOfTilt(plane, pose)));
  const double gap_sigma = std::min(kWidestGap, std::hypot(plane.tolerance / 2, lowest.sigma));
  evidence.rests = std::exp(-0.5 * (squared(tilt / tilt_sigma) + squared(lowest.value / gap_sigma)));
  evidence.log_odds = support.rest_log_odds * evidence.rests;
  return evidence;
}

}  // namespace monocular_eye_hand
