#include "model/tessellation.h"

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

constexpr double kCoarsest = 0.8;  // edge of a polygon that may still stand for a circle [rad]
constexpr double kFullTurn = 2 * 3.14159265358979323846;
constexpr double kMaxShare = 5e-3;    // of the diameter
constexpr double kSpare = 1.2;        // for noise in vertices and fit
constexpr double kSameRadius = 0.02;  // radii within this share are of equal holes

}  // namespace

double sagitta(double radius, double segment) { return radius * (1 - std::cos(0.5 * segment)); }

Tessellation::Tessellation(const ObjectModel& model) : most_(kMaxShare * model.diameter) {
  for (const ModelCircle& c : model.circles) {
    if (c.full() && c.segment <= kCoarsest) parts_.push_back({c.centre, c.axis, c.radius, 0, c.segment});
  }
  for (const Surface& s : model.surfaces) {
    if (s.kind == Surface::Kind::kCylinder) addCylinder(model, s);
  }
  shareSegments();
}

/// A cylinder counts when its vertices stand all around the axis.
void Tessellation::addCylinder(const ObjectModel& model, const Surface& surface) {
  const Eigen::Vector3d u = surface.axis.unitOrthogonal(), v = surface.axis.cross(u);
  std::vector<double> angles;
  for (const int t : surface.triangles) {
    for (const int k : model.mesh.triangles[t]) {
      const Eigen::Vector3d d = model.mesh.vertices[k] - surface.point;
      angles.push_back(std::atan2(v.dot(d), u.dot(d)));
    }
  }
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + kFullTurn - angles.back();
  for (size_t k = 1; k < angles.size(); ++k) widest = std::max(widest, angles[k] - angles[k - 1]);
  if (widest <= kCoarsest)
    parts_.push_back({surface.point, surface.axis, surface.radius, surface.half_length, widest});
}

/// A motion may lay a fine polygon on a coarse one of an equal hole.
void Tessellation::shareSegments() {
  const std::vector<RoundPart> own = parts_;
  for (RoundPart& part : parts_) {
    for (const RoundPart& other : own) {
      if (std::abs(other.radius - part.radius) <= kSameRadius * part.radius)
        part.segment = std::max(part.segment, other.segment);
    }
  }
}

double Tessellation::allowanceAt(const Eigen::Vector3d& p) const {
  double allowance = 0;
  for (const RoundPart& part : parts_) {
    const double height = sagitta(part.radius, part.segment), reach = kSpare * height + 1e-9;
    const Eigen::Vector3d d = p - part.centre;
    const double along = part.axis.dot(d), out = (d - along * part.axis).norm();
    const double beyond = std::max(0.0, std::abs(along) - part.half_length);
    if (std::hypot(beyond, out - part.radius) <= reach) allowance = std::max(allowance, kSpare * height);
  }
  return std::min(allowance, most_);
}

double Tessellation::segmentAbout(const SymmetryAxis& line, double tolerance) const {
  double segment = 0;
  for (const RoundPart& part : parts_) {
    const Eigen::Vector3d d = part.centre - line.point;
    const double off = (d - line.direction * line.direction.dot(d)).norm();
    const bool parallel = part.axis.cross(line.direction).norm() < 1e-2;
    if (parallel && off <= tolerance) segment = std::max(segment, part.segment);
  }
  return segment;
}

}  // namespace monocular_eye_hand
