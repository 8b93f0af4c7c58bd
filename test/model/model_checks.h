#pragma once
#include <gtest/gtest.h>

#include <algorithm>

#include "model/build_model.h"

namespace monocular_eye_hand {

inline ObjectModel build(const Mesh& mesh, ModelOptions options = {}) {
  options.find_symmetries = false;
  return buildModel("part", mesh, options);
}
inline int count(const ObjectModel& m, Surface::Kind kind) {
  return int(
      std::count_if(m.surfaces.begin(), m.surfaces.end(), [&](const Surface& s) { return s.kind == kind; }));
}
constexpr auto kPlane = Surface::Kind::kPlane;
constexpr auto kCylinder = Surface::Kind::kCylinder;
constexpr auto kFreeform = Surface::Kind::kFreeform;

/// What every model must keep, whatever its shape.
inline void checkConsistent(const ObjectModel& m) {
  ASSERT_EQ(m.surface_of_triangle.size(), m.mesh.triangles.size());
  for (const int s : m.surface_of_triangle) ASSERT_TRUE(s >= 0 && s < int(m.surfaces.size()));

  for (size_t e = 0; e < m.edges.size(); ++e) {
    const ModelEdge& edge = m.edges[e];
    const Eigen::Vector3d t = (edge.q - edge.p).normalized();
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(edge.normal[k].norm(), 1, 1e-9);
      EXPECT_NEAR(edge.normal[k].dot(t), 0, 0.05);
      if (edge.vertex[k] < 0) continue;
      const ModelCorner& c = m.corners[edge.vertex[k]];
      EXPECT_LT((c.p - (k == 0 ? edge.p : edge.q)).norm(), 1e-9);
      EXPECT_EQ(std::count(c.edges.begin(), c.edges.end(), int(e)), 1);
    }
    if (edge.surface[1] < 0) continue;
    // Surface 0 lies on the left: its triangles near the edge's middle are on that side.
    const double rise = edge.normal[0].cross(t).dot(edge.normal[1]);
    EXPECT_EQ(rise < 0, edge.convex) << "edge " << e;
  }

  for (const ModelCircle& c : m.circles) {
    EXPECT_NEAR(c.axis.norm(), 1, 1e-9);
    EXPECT_NEAR(c.axis.dot(c.x_axis), 0, 1e-9);
    EXPECT_GT(c.radius, 0);
    EXPECT_GT(c.sweep, 0);
    EXPECT_LE(c.sweep, 2 * M_PI + 1e-9);
  }
}

}  // namespace monocular_eye_hand
