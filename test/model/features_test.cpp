#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../mesh/shapes.h"
#include "model_checks.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/model/known_object.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using namespace shapes;

bool warned(const ObjectModel& m, const std::string& text) {
  return std::any_of(m.warnings.begin(), m.warnings.end(),
                     [&](const std::string& w) { return w.find(text) != std::string::npos; });
}

TEST(Features, CubeHasTwelveEdgesEightCornersSixPlanes) {
  const ObjectModel m = build(box(0.08, 0.08, 0.08));
  checkConsistent(m);
  EXPECT_EQ(m.mesh.vertices.size(), 8u);
  EXPECT_EQ(m.edges.size(), 12u);
  EXPECT_EQ(m.corners.size(), 8u);
  EXPECT_EQ(m.circles.size(), 0u);
  EXPECT_EQ(count(m, kPlane), 6);
  EXPECT_TRUE(m.closed);
  EXPECT_TRUE(m.warnings.empty());
  EXPECT_NEAR(m.diameter, 0.08 * std::sqrt(3.0), 1e-9);
  for (const ModelEdge& e : m.edges) {
    EXPECT_TRUE(e.convex);
    EXPECT_NEAR(e.dihedral, kPi / 2, 1e-9);
    EXPECT_NEAR((e.q - e.p).norm(), 0.08, 1e-9);
  }
  for (const ModelCorner& c : m.corners) EXPECT_EQ(c.edges.size(), 3u);
}

TEST(Features, HexagonAndOctagonKeepTheirEdges) {
  for (const int n : {3, 4, 5, 6, 8, 10}) {
    const ObjectModel m = build(prism(polygon(n, 0.03, 0.2), 0.05));
    checkConsistent(m);
    EXPECT_EQ(m.edges.size(), size_t(3 * n)) << n;
    EXPECT_EQ(m.corners.size(), size_t(2 * n)) << n;
    EXPECT_EQ(m.circles.size(), 0u) << n;
    EXPECT_EQ(count(m, kPlane), n + 2) << n;
  }
}

class Round : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Segments, Round,
                         testing::Values(12, 13, 16, 17, 18, 20, 24, 36, 48, 64, 100, 144, 200));

TEST_P(Round, CylinderHasTwoCirclesAndOneWall) {
  for (unsigned pose = 0; pose < 4; ++pose) {
    for (const int rows : {1, 3}) {
      const Rigid3 object_from_shape = pose == 0 ? Rigid3{} : somewhere(pose);
      const ObjectModel m = build(rounded(moved(cylinder(GetParam(), 0.02, 0.03, rows), object_from_shape)));
      checkConsistent(m);
      ASSERT_EQ(m.circles.size(), 2u);
      EXPECT_EQ(m.edges.size(), 0u);
      EXPECT_EQ(count(m, kPlane), 2);
      ASSERT_EQ(count(m, kCylinder), 1);
      EXPECT_EQ(count(m, kFreeform), 0);

      for (const ModelCircle& c : m.circles) {
        EXPECT_TRUE(c.full());
        EXPECT_TRUE(c.convex);
        EXPECT_NEAR(c.radius, 0.02, 1e-6);
        EXPECT_NEAR(c.segment, 2 * kPi / GetParam(), 1e-3);
        EXPECT_NEAR(c.dihedral, kPi / 2, 0.01);
        const Eigen::Vector3d outward = c.centre - object_from_shape * Eigen::Vector3d(0, 0, 0.015);
        EXPECT_NEAR(c.axis.dot(outward.normalized()), 1, 1e-6);  // out of the cap it bounds
      }

      for (const Surface& s : m.surfaces) {
        if (s.kind != kCylinder) continue;
        EXPECT_TRUE(s.convex);
        EXPECT_NEAR(s.radius, 0.02, 1e-6);
        EXPECT_NEAR(s.half_length, 0.015, 1e-6);
        EXPECT_LT((s.point - object_from_shape * Eigen::Vector3d(0, 0, 0.015)).norm(), 1e-6);
      }
    }
  }
}

TEST_P(Round, HoleIsConcaveCylinderWithTwoCircles) {
  const int n = (GetParam() + 3) / 4 * 4;
  const ObjectModel m = build(rounded(moved(plateWithHole(n, 0.03, 0.01, 0.008), somewhere(7))));
  checkConsistent(m);
  EXPECT_EQ(m.edges.size(), 12u);
  EXPECT_EQ(m.corners.size(), 8u);
  ASSERT_EQ(m.circles.size(), 2u);
  ASSERT_EQ(count(m, kCylinder), 1);
  EXPECT_EQ(count(m, kPlane), 6);
  for (const Surface& s : m.surfaces) {
    if (s.kind == kCylinder) {
      EXPECT_FALSE(s.convex);
      EXPECT_NEAR(s.radius, 0.01, 1e-6);
    }
  }

  for (const ModelCircle& c : m.circles) {
    EXPECT_TRUE(c.full());
    EXPECT_TRUE(
        c.convex);  // the rim of a hole is a convex edge: material on less than half of its surroundings
  }
}

TEST_P(Round, SlotHasArcsAndStraightEdges) {
  const int n = std::max(6, GetParam() / 2);
  const ObjectModel m = build(rounded(moved(prism(slot(n, 0.01, 0.02), 0.015), somewhere(3))));
  checkConsistent(m);
  EXPECT_EQ(m.circles.size(), 4u);
  EXPECT_EQ(m.edges.size(), 4u);
  EXPECT_EQ(count(m, kCylinder), 2);
  EXPECT_EQ(count(m, kPlane), 4);
  for (const ModelCircle& c : m.circles) {
    EXPECT_FALSE(c.full());
    EXPECT_NEAR(c.radius, 0.01, 1e-6);
    EXPECT_NEAR(c.sweep, kPi, 1e-3);
    EXPECT_EQ(c.start, 0);
  }
  for (const ModelEdge& e : m.edges) EXPECT_NEAR((e.q - e.p).norm(), 0.04, 1e-6);
}

TEST(Features, RoundedBoxHasQuarterArcs) {
  const ObjectModel m = build(rounded(prism(roundedRectangle(8, 0.08, 0.05, 0.01), 0.02)));
  checkConsistent(m);
  EXPECT_EQ(m.circles.size(), 8u);
  EXPECT_EQ(m.edges.size(), 8u);
  EXPECT_EQ(m.corners.size(), 0u);
  EXPECT_EQ(count(m, kCylinder), 4);
  for (const ModelCircle& c : m.circles) {
    EXPECT_NEAR(c.sweep, kPi / 2, 1e-3);
    // The arc's own parametrisation ends where it says: on the outline.
    const double end = c.start + c.sweep;
    const Eigen::Vector3d q =
        c.centre + c.radius * (std::cos(end) * c.x_axis + std::sin(end) * c.axis.cross(c.x_axis));
    EXPECT_TRUE(std::abs(std::abs(q.x()) - 0.04) < 1e-6 || std::abs(std::abs(q.y()) - 0.025) < 1e-6);
  }
}

TEST(Features, ChamferStaysTwoEdges) {
  Outline o{{0.03, -0.02}, {0.03, 0.015}, {0.025, 0.02}, {-0.03, 0.02}, {-0.03, -0.02}};
  const ObjectModel m = build(prism(o, 0.02));
  EXPECT_EQ(m.edges.size(), 15u);
  EXPECT_EQ(m.circles.size(), 0u);
}

TEST(Features, ConeAndSphereAreFreeform) {
  const ObjectModel frustum = build(rounded(cone(48, 0.03, 0.015, 0.04)));
  checkConsistent(frustum);
  EXPECT_EQ(frustum.circles.size(), 2u);
  EXPECT_EQ(count(frustum, kFreeform), 1);
  EXPECT_EQ(count(frustum, kPlane), 2);
  const ObjectModel ball = build(rounded(sphere(48, 0.03)));
  EXPECT_EQ(ball.circles.size() + ball.edges.size(), 0u);
  EXPECT_EQ(ball.surfaces.size(), 1u);
  EXPECT_TRUE(warned(ball, "no sharp edge"));
}

TEST(Features, NormalsOnCirclesFollowTheSurfaces) {
  const ObjectModel m = build(cone(60, 0.03, 0.015, 0.04));
  for (const ModelCircle& c : m.circles) {
    for (int s = 0; s < 2; ++s) {
      const bool plane = m.surfaces[c.surface[s]].kind == kPlane;
      const double slope = std::atan2(0.015, 0.04);
      const Eigen::Vector2d want =
          plane ? Eigen::Vector2d(0, 1)
                : Eigen::Vector2d(std::cos(slope), (c.axis.z() > 0 ? 1 : -1) * std::sin(slope));
      EXPECT_NEAR((c.normal[s] - want).norm(), 0, 0.01);
    }
  }
}

TEST(Features, ConcaveEdgeOfAnAngle) {
  // Not convex as a whole: its caps are cut by hand.
  Mesh m;
  const Outline o{{0, 0}, {0.04, 0}, {0.04, 0.01}, {0.01, 0.01}, {0.01, 0.03}, {0, 0.03}};
  wall(&m, o, 0, 0.02);
  for (const bool up : {false, true}) {
    cap(&m, {o[0], o[1], o[2], o[3]}, up ? 0.02 : 0, up);
    cap(&m, {o[0], o[3], o[4], o[5]}, up ? 0.02 : 0, up);
  }
  const ObjectModel part = build(m);
  checkConsistent(part);
  EXPECT_EQ(part.edges.size(), 18u);
  EXPECT_EQ(part.corners.size(), 12u);
  EXPECT_EQ(std::count_if(part.edges.begin(), part.edges.end(), [](const ModelEdge& e) { return !e.convex; }),
            1);
}

TEST(Features, ShippedModelsHaveTheirExactFeatures) {
  struct Want {
    const char* name;
    size_t edges, full, arcs, corners;
    int planes, cylinders;
  };
  for (const Want& w : {Want{"bridge", 24, 0, 0, 16, 10, 0}, Want{"frame", 24, 0, 0, 16, 10, 0},
                        Want{"flange", 0, 6, 0, 0, 3, 3}, Want{"bracket", 18, 4, 0, 12, 8, 2},
                        Want{"grenade", 34, 1, 2, 24, 14, 1}}) {
    const ObjectModel m = build(loadMesh(shippedModel(w.name), "mm"));
    checkConsistent(m);
    const size_t full =
        size_t(std::count_if(m.circles.begin(), m.circles.end(), [](auto& c) { return c.full(); }));
    EXPECT_EQ(m.edges.size(), w.edges) << w.name;
    EXPECT_EQ(full, w.full) << w.name;
    EXPECT_EQ(m.circles.size() - full, w.arcs) << w.name;
    EXPECT_EQ(m.corners.size(), w.corners) << w.name;
    EXPECT_EQ(count(m, kPlane), w.planes) << w.name;
    EXPECT_EQ(count(m, kCylinder), w.cylinders) << w.name;
    EXPECT_EQ(count(m, kFreeform), 0) << w.name;
    EXPECT_TRUE(m.closed) << w.name;
    EXPECT_TRUE(m.warnings.empty()) << w.name << ": " << m.warnings.front();
  }
}

TEST(Repair, InsideOutMeshIsTurnedWithAWarning) {
  const ObjectModel m = build(reversed(box(0.04, 0.05, 0.06)));
  EXPECT_TRUE(warned(m, "inside out"));
  checkConsistent(m);
  for (const Surface& s : m.surfaces) EXPECT_GT(s.axis.dot(s.point), 0);
}

TEST(Repair, WrongCornerOrderIsTurnedWithACount) {
  Mesh mesh = box(0.04, 0.05, 0.06);
  for (const size_t t : {2u, 7u}) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  const ObjectModel m = build(mesh);
  EXPECT_TRUE(warned(m, "2 triangles had their corners in the wrong order"));
  EXPECT_EQ(m.edges.size(), 12u);
  for (const Surface& s : m.surfaces) EXPECT_GT(s.axis.dot(s.point), 0);
}

TEST(Repair, CavityKeepsItsSide) {
  Mesh mesh = box(0.06, 0.06, 0.06);
  append(&mesh, reversed(box(0.02, 0.02, 0.02)));
  const ObjectModel m = build(mesh);
  EXPECT_FALSE(warned(m, "inside out"));
  EXPECT_EQ(m.edges.size(), 24u);
  EXPECT_EQ(std::count_if(m.edges.begin(), m.edges.end(), [](const ModelEdge& e) { return !e.convex; }), 12);
}

TEST(Repair, OpenMeshIsToldAndItsRimIsAnEdge) {
  Mesh mesh = box(0.04, 0.05, 0.06);
  mesh.triangles.resize(10);  // one side is missing
  const ObjectModel m = build(mesh);
  EXPECT_FALSE(m.closed);
  EXPECT_TRUE(warned(m, "open: 4 edges"));
  EXPECT_EQ(
      std::count_if(m.edges.begin(), m.edges.end(), [](const ModelEdge& e) { return e.surface[1] < 0; }), 4);
}

TEST(Repair, DegenerateTrianglesAndTJunctionsAreRepaired) {
  Mesh mesh = box(0.04, 0.05, 0.06);
  // One face is split at the middle of an edge that its neighbour leaves whole, and slivers are strewn in.
  const auto t = mesh.triangles.back();
  const Eigen::Vector3d a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
  mesh.triangles.pop_back();
  const Eigen::Vector3d middle = 0.5 * (a + b);
  triangle(&mesh, a, middle, c);
  triangle(&mesh, middle, b, c);
  triangle(&mesh, a, a, b);
  const ObjectModel m = build(mesh);
  EXPECT_TRUE(m.closed);
  EXPECT_TRUE(warned(m, "1 triangles without area"));
  EXPECT_EQ(m.edges.size(), 12u);
  EXPECT_EQ(m.corners.size(), 8u);
}

TEST(Repair, WeldingJoinsNearbyVerticesOnly) {
  Mesh mesh = box(0.04, 0.05, 0.06);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-2e-8, 2e-8);
  for (Eigen::Vector3d& v : mesh.vertices) v += Eigen::Vector3d(noise(random), noise(random), noise(random));
  ModelOptions options;
  options.weld_tolerance = 2e-6;
  EXPECT_EQ(build(mesh, options).mesh.vertices.size(), 8u);
  options.weld_tolerance = 0;
  EXPECT_FALSE(build(mesh, options).closed);
}

TEST(Warnings, UnitThatLooksWrong) {
  EXPECT_TRUE(warned(build(box(40, 50, 60)), "unit"));
  EXPECT_TRUE(warned(build(box(4e-5, 5e-5, 6e-5)), "unit"));
  EXPECT_FALSE(warned(build(box(0.04, 0.05, 0.06)), "unit"));
}

TEST(BadMesh, EmptyFlatOrNotFiniteIsRefused) {
  EXPECT_THROW(build({}), BadInput);
  Mesh point;
  triangle(&point, {1, 1, 1}, {1, 1, 1}, {1, 1, 1});
  EXPECT_THROW(build(point), BadInput);
  Mesh line;
  triangle(&line, {0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  EXPECT_THROW(build(line), BadInput);
  Mesh nan = box(1, 1, 1);
  nan.vertices[3].y() = std::nan("");
  EXPECT_THROW(build(nan), BadInput);
  Mesh index = box(1, 1, 1);
  index.triangles[2][1] = 999;
  EXPECT_THROW(build(index), BadInput);
}

TEST(BadOptions, AreNamed) {
  ModelOptions options;
  options.sharp_angle = 0;
  EXPECT_THAT(refusal([&] { options.check(); }), testing::HasSubstr("sharp_angle"));
  options = {};
  options.symmetry_tolerance = std::nan("");
  EXPECT_THROW(options.check(), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
