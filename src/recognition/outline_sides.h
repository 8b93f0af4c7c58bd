#pragma once
#include <Eigen/Core>
#include <vector>

#include "recognition/flat_view.h"

namespace monocular_eye_hand {

/// A straight line of a view whose ends an image segment may have: the base edge of a template.
struct BaseEdge {
  Eigen::Vector2d a, b;   ///< on the plane of the flat view [m]
  std::vector<char> own;  ///< a flag per sample: it lies on the edge
  double length() const { return (b - a).norm(); }
};

/// Long straight sides of a view's outline, whatever makes them up: the crests of a thread, teeth, the ends
/// of ribs. A camera that does not resolve these sees one straight edge there. `diameter`: of the object [m].
std::vector<BaseEdge> outlineSides(const FlatView& flat, double diameter);

}  // namespace monocular_eye_hand
