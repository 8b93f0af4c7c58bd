#pragma once
#include <Eigen/Core>
#include <algorithm>

namespace monocular_eye_hand {

/// The base triangle of the perspective tetrahedron with its longest side as unit of length and points 1, 2
/// at that side's ends: foot and altitude of point 3 keep the third dimension of a nearly flat triangle,
/// which the three side lengths alone would lose.
struct BaseTriangle {
  double a13 = 0, a23 = 0;  ///< squared sides (a12 = 1)
  double foot = 0;          ///< foot of the altitude from point 3 on side 12, from point 1
  double altitude = 0;      ///< > 0
};

/// One root: the legs and the camera-frame vectors of side 12 and altitude at these legs.
struct TetrahedronRoot {
  Eigen::Vector3d legs;
  Eigen::Vector3d base, height;
};

/// All real roots with positive legs, polished. `j`: three unit bearings. Returns how many (at most four).
int solveBaseTriangle(const Eigen::Vector3d* j, const BaseTriangle& triangle, TetrahedronRoot* roots);

/// Which of three points (indices) are the ends of the longest side, then the remaining one.
struct TriangleOrder {
  int first, second, third;
};
inline TriangleOrder longestSideFirst(double a12, double a13, double a23) {
  static constexpr TriangleOrder kOrders[3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}};
  const bool by13 = a13 > a12, by23 = a23 > std::max(a12, a13);
  return kOrders[by23 ? 2 : int(by13)];
}

}  // namespace monocular_eye_hand
