#pragma once
#include <vector>

#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// How far the polygons that stand for circles and cylinders may lie from themselves after a rotation: two
/// polygons of one circle differ by at most its sagitta r (1 - cos(segment / 2)). Only full circles and full
/// cylinders that were fitted count: a smooth bend may be any shape.
class Tessellation {
 public:
  explicit Tessellation(const ObjectModel& model);

  /// Distance by which a point of the mesh may miss the mesh after a motion that keeps the true shape [m]: 0
  /// away from the round parts, at most half a per cent of the diameter.
  double allowanceAt(const Eigen::Vector3d& p) const;
  /// The largest angle that one edge covers on the round parts about this line [rad]; 0 without one.
  double segmentAbout(const SymmetryAxis& line, double tolerance) const;

 private:
  struct RoundPart {
    Eigen::Vector3d centre, axis;
    double radius = 0;       // [m]
    double half_length = 0;  // of a cylinder; 0 of a circle [m]
    double segment = 0;      // angle that one edge covers at most [rad]
  };
  void addCylinder(const ObjectModel& model, const Surface& surface);
  void shareSegments();

  std::vector<RoundPart> parts_;
  double most_ = 0;  // [m]
};

/// r (1 - cos(segment / 2)).
double sagitta(double radius, double segment);

}  // namespace monocular_eye_hand
