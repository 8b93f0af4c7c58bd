#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "monocular_eye_hand/pose/circle_pose.h"

namespace monocular_eye_hand {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kOnAxis = 1e-9;  // distance from the axis, of the point's from the centre: no roll
constexpr double kLargestStep = 0.5, kSmallestStep = 1e-12;  // [rad]
constexpr double kMet = 1e-12;                               // the point is on its ray [rad]
constexpr int kSamples = 8;  // rolls that are tried besides those in closed form

/// The ring on which the point moves when the object is turned about the circle's axis, and the ray it is
/// seen on.
struct Ring {
  Vector3d centre, u, v;  // camera frame; u, v of the length of its radius
  Vector3d ray;           // unit
  Vector3d right, down;   // unit, normal to the ray

  /// Where the point is seen in the plane normal to the ray at distance 1: squared distance from the ray, and
  /// Newton's step to its minimum, Gauss-Newton's where it is not convex. Infinite behind the lens.
  double squaredDistance(double roll, double* step) const {
    const double c = std::cos(roll), s = std::sin(roll);
    const Vector3d turned = c * u + s * v, p = centre + turned, dp = c * v - s * u;
    const double depth = ray.dot(p);
    *step = 0;
    if (!(depth > 0)) return std::numeric_limits<double>::infinity();
    const double d_depth = ray.dot(dp);
    const Vector2d offset = flat(p) / depth;
    const Vector2d slope = (flat(dp) - offset * d_depth) / depth;
    const Vector2d bend = (offset * ray.dot(turned) - flat(turned) - 2 * d_depth * slope) / depth;
    const double square = slope.squaredNorm(), curvature = square + offset.dot(bend);
    const double divisor = curvature > 0 ? curvature : square;
    if (divisor > 0) *step = std::clamp(-offset.dot(slope) / divisor, -kLargestStep, kLargestStep);
    return offset.squaredNorm();
  }
  Vector2d flat(const Vector3d& p) const { return {right.dot(p), down.dot(p)}; }
};

struct Roll {
  double angle = 0, squared_distance = std::numeric_limits<double>::infinity();
};

/// Newton from a start, with shorter steps while they do not help.
Roll refined(const Ring& ring, double angle) {
  double step = 0;
  Roll roll{angle, ring.squaredDistance(angle, &step)};
  for (int i = 0; i < 30 && std::abs(step) > kSmallestStep; ++i) {
    double next_step = 0;
    const double next = ring.squaredDistance(roll.angle + step, &next_step);
    if (next <= roll.squared_distance) {
      roll = {roll.angle + step, next};
      step = next_step;
    } else {
      step *= 0.25;
    }
  }
  return roll;
}

/// The two rolls that bring the point into the plane through the lens with this normal, or the one that
/// brings it nearest: a cos(roll) + b sin(roll) + c = 0.
std::array<double, 2> rollsIntoPlane(const Ring& ring, const Vector3d& normal) {
  const double a = normal.dot(ring.u), b = normal.dot(ring.v), c = normal.dot(ring.centre);
  const double middle = std::atan2(b, a), amplitude = std::hypot(a, b);
  const double half = std::acos(amplitude > 0 ? std::clamp(-c / amplitude, -1.0, 1.0) : 0.0);
  return {middle + half, middle - half};
}

/// The roll that brings the point nearest to its ray. Where the ray can be met, two planes through it tell
/// the roll, however flat the ring is seen; where it cannot, the minimum is near one of these or of a few
/// others.
double bestRoll(const Ring& ring) {
  Roll best;
  const auto consider = [&](double start) {
    const Roll roll = refined(ring, start);
    if (roll.squared_distance < best.squared_distance) best = roll;
  };
  for (const Vector3d& normal : {ring.right, ring.down})
    for (const double start : rollsIntoPlane(ring, normal)) consider(start);
  if (best.squared_distance > kMet * kMet)
    for (int i = 0; i < kSamples; ++i) consider(i * 2 * M_PI / kSamples);
  return best.angle;
}

}  // namespace

CirclePointPoses circlePointPoses(const Ellipse& ellipse, const Camera& camera, const CircleAndPoint& object,
                                  const Vector2d& uv) {
  CirclePointPoses result;
  if (!object.centre.allFinite() || !object.point.allFinite() || !object.axis.allFinite() ||
      !(object.axis.squaredNorm() > 0) || !uv.allFinite())
    return result;
  const Vector3d axis = object.axis.normalized(), arm = object.point - object.centre;
  const double height = arm.dot(axis);
  const Vector3d across = arm - height * axis;
  const double reach = across.norm();
  if (!(reach > kOnAxis * std::max(arm.norm(), object.radius))) return result;
  Eigen::Matrix3d in_object;
  in_object.col(2) = axis;
  in_object.col(1) = axis.cross(across).normalized();
  in_object.col(0) = in_object.col(1).cross(axis);

  const CirclePoses circles = circlePoses(ellipse, camera, object.radius);
  Ring ring;
  ring.ray = camera.ray(uv).normalized();
  ring.right = ring.ray.unitOrthogonal();
  ring.down = ring.ray.cross(ring.right);
  for (int i = 0; i < circles.count; ++i) {
    const CirclePose& circle = circles.pose[i];
    const Vector3d x = circle.normal.unitOrthogonal(), y = circle.normal.cross(x);
    ring.centre = circle.centre + height * circle.normal;
    ring.u = reach * x;
    ring.v = reach * y;
    const double roll = bestRoll(ring);
    Eigen::Matrix3d in_camera;
    in_camera.col(0) = std::cos(roll) * x + std::sin(roll) * y;
    in_camera.col(1) = std::cos(roll) * y - std::sin(roll) * x;
    in_camera.col(2) = circle.normal;
    CirclePointPose& pose = result.pose[result.count++];
    pose.camera_from_object.rotation = in_camera * in_object.transpose();
    pose.camera_from_object.translation = circle.centre - pose.camera_from_object.rotation * object.centre;
    const Vector3d p = pose.camera_from_object * object.point;
    pose.error = std::atan2(p.cross(ring.ray).norm(), p.dot(ring.ray));
  }
  if (result.count == 2 && result.pose[1].error < result.pose[0].error)
    std::swap(result.pose[0], result.pose[1]);
  return result;
}

}  // namespace monocular_eye_hand
