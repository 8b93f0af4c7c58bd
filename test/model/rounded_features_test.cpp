#include <gtest/gtest.h>

#include <map>

#include "../mesh/shapes.h"
#include "model_checks.h"
#include "monocular_eye_hand/model/contour.h"

namespace monocular_eye_hand {
namespace {

using namespace shapes;

const double kInset = 1 - std::sqrt(0.5);  // how far the middle of a round lies behind either surface [radii]

TEST(RoundedEdges, OfABoxAreItsTwelveEdgesAndMeetInItsEightCorners) {
  const double radius = 0.003;
  for (unsigned pose = 0; pose < 4; ++pose) {
    const Rigid3 object_from_shape = pose == 0 ? Rigid3{} : somewhere(pose);
    const ObjectModel m = build(rounded(moved(roundedBox(0.08, 0.05, 0.03, radius), object_from_shape)));
    checkConsistent(m);
    EXPECT_EQ(m.edges.size(), 12u);
    EXPECT_EQ(m.corners.size(), 8u);
    EXPECT_EQ(m.circles.size(), 0u);
    std::map<int, int> of_length;
    for (const ModelEdge& e : m.edges) {
      EXPECT_NEAR(e.rounding, radius, 1e-5);
      EXPECT_NEAR(e.dihedral, kPi / 2, 1e-3);
      EXPECT_TRUE(e.convex);
      ++of_length[int(std::lround(1e4 * ((e.q - e.p).norm() + 2 * kInset * radius)))];
    }
    EXPECT_EQ(of_length, (std::map<int, int>{{300, 4}, {500, 4}, {800, 4}}));
    for (const ModelCorner& c : m.corners) {
      const Eigen::Vector3d p_in_shape = object_from_shape.inverse() * c.p;
      const Eigen::Vector3d sharp(0.04, 0.025, 0.015);
      EXPECT_EQ(c.edges.size(), 3u);
      EXPECT_LT((p_in_shape.cwiseAbs() - sharp).cwiseAbs().maxCoeff(), kInset * radius + 1e-5);
    }
  }
}

TEST(RoundedEdges, AreNoneWhereTheRoundIsAFaceOfItsOwn) {
  EXPECT_EQ(build(roundedBox(0.08, 0.05, 0.03, 0.01)).edges.size(), 0u);
  const ObjectModel slotted = build(prism(slot(12, 0.002, 0.03), 0.03));
  for (const ModelEdge& e : slotted.edges) EXPECT_EQ(e.rounding, 0);
}

TEST(RoundedEdges, OfAnInnerCornerAreConcave) {
  Outline o{{0, 0}, {0.05, 0}, {0.05, 0.01}};
  for (const Eigen::Vector2d& p : arc({0.013, 0.013}, 0.003, -kPi / 2, -kPi)) o.push_back(p);
  o.insert(o.end(), {{0.01, 0.04}, {0, 0.04}});
  Mesh mesh;
  wall(&mesh, o, 0, 0.03);
  for (const bool up : {false, true}) {  // the outline is not convex: a fan about the middle of the round
    const double z = up ? 0.03 : 0;
    const Point hub = at({0.005, 0.005}, z);
    for (size_t k = 0; k < o.size(); ++k) {
      const Point a = at(o[k], z), b = at(o[(k + 1) % o.size()], z);
      if (up) triangle(&mesh, hub, a, b);
      if (!up) triangle(&mesh, hub, b, a);
    }
  }

  const ObjectModel m = build(rounded(mesh));
  checkConsistent(m);
  const auto concave =
      std::find_if(m.edges.begin(), m.edges.end(), [](const ModelEdge& e) { return e.rounding > 0; });
  ASSERT_NE(concave, m.edges.end());
  EXPECT_FALSE(concave->convex);
  const double place = 0.01 + kInset * 0.003;
  EXPECT_LT((concave->p.head<2>() - Eigen::Vector2d(place, place)).norm(), 1e-5);
}

const ModelCircle* circleAt(const ObjectModel& m, double radius, double z) {
  for (const ModelCircle& c : m.circles)
    if (std::abs(c.radius - radius) < 1e-5 && std::abs(c.centre.z() - z) < 1e-5) return &c;
  return nullptr;
}

// A hub on a rim, all edges rounded: seen from above a rim, a foot and a top.
TEST(RoundedCircles, OfATurnedPartLieOnTheMiddlesOfItsRounds) {
  const double r = 0.002, foot = 0.003;
  const Outline profile = joined({{{0, 0}},
                                  arc({0.043, r}, r, -kPi / 2, 0),
                                  arc({0.043, 0.01 - r}, r, 0, kPi / 2),
                                  arc({0.025, 0.01 + foot}, foot, 1.5 * kPi, kPi),
                                  arc({0.02, 0.035 - r}, r, 0, kPi / 2),
                                  {{0, 0.035}}});

  for (const int around : {36, 72}) {
    const ObjectModel m = build(rounded(revolved(profile, around)));
    checkConsistent(m);
    EXPECT_EQ(m.circles.size(), 4u);
    EXPECT_EQ(count(m, kCylinder), 2);
    EXPECT_EQ(count(m, kPlane), 3);

    const ModelCircle* low = circleAt(m, 0.045 - kInset * r, kInset * r);
    const ModelCircle* rim = circleAt(m, 0.045 - kInset * r, 0.01 - kInset * r);
    const ModelCircle* inner = circleAt(m, 0.022 + kInset * foot, 0.01 + kInset * foot);
    const ModelCircle* top = circleAt(m, 0.022 - kInset * r, 0.035 - kInset * r);
    ASSERT_TRUE(low && rim && inner && top);

    for (const ModelCircle* c : {low, rim, top}) {
      EXPECT_TRUE(c->full());
      EXPECT_TRUE(c->convex);
      EXPECT_TRUE(c->left);
      EXPECT_NEAR(c->rounding, r, 1e-5);
      EXPECT_NEAR(c->axis.z(), c == low ? -1 : 1, 1e-6);
    }
    EXPECT_FALSE(inner->convex);
    EXPECT_FALSE(inner->left);
    EXPECT_NEAR(inner->rounding, foot, 1e-5);
  }
}

TEST(RoundedCircles, OfABlockAreTheArcsAtItsCornersBetweenItsRoundedEdges) {
  const double corner = 0.01, rim = 0.003;
  const ObjectModel m = build(rounded(blockWithRoundedTop(0.08, 0.06, 0.03, corner, rim)));
  checkConsistent(m);
  const auto isRounded = [](const auto& feature) { return feature.rounding > 0; };
  EXPECT_EQ(std::count_if(m.edges.begin(), m.edges.end(), isRounded), 4);
  ASSERT_EQ(std::count_if(m.circles.begin(), m.circles.end(), isRounded), 4);
  for (const ModelCircle& c : m.circles) {
    EXPECT_NEAR(c.sweep, kPi / 2, 1e-3);
    if (!isRounded(c)) continue;
    EXPECT_NEAR(c.radius, corner - kInset * rim, 1e-5);
    EXPECT_NEAR(c.centre.z(), 0.03 - kInset * rim, 1e-5);
    // It runs along the outside of the block's corner.
    const Eigen::Vector3d y_axis = c.axis.cross(c.x_axis);
    const Eigen::Vector3d middle = c.centre + c.radius * (c.x_axis + y_axis).normalized();
    EXPECT_GT(middle.head<2>().norm(), c.centre.head<2>().norm() + 0.9 * c.radius);
  }
}

TEST(RoundedCircles, AreNoneOnASphereOrATorus) {
  EXPECT_EQ(build(rounded(sphere(64, 0.03))).circles.size(), 0u);
  Outline ring = arc({0.03, 0}, 0.008, 0, 2 * kPi, 32);
  const ObjectModel torus = build(rounded(revolved(ring, 48)));
  EXPECT_EQ(torus.circles.size(), 0u);
  EXPECT_EQ(count(torus, kCylinder), 0);
  EXPECT_EQ(count(torus, kFreeform), 1);
}

// How many samples each edge or circle has.
std::map<int, int> samplesOfFeatures(const ObjectModel& m, const Eigen::Vector3d& eye) {
  std::map<int, int> samples;
  for (const ContourSample& s : visibleContour(m, eye, {}))
    if (s.feature < m.featureOfSilhouette(0)) ++samples[s.feature];
  return samples;
}

TEST(RoundedEdges, AreSeenBetweenTwoFacesThatFaceTheEye) {
  const ObjectModel m = build(roundedBox(0.08, 0.05, 0.03, 0.003));
  EXPECT_EQ(samplesOfFeatures(m, {0.3, 0.25, 0.2}).size(), 3u);   // from a corner
  EXPECT_EQ(samplesOfFeatures(m, {0, 0.25, 0.2}).size(), 1u);     // two faces
  EXPECT_EQ(samplesOfFeatures(m, {0.02, 0.01, 0.4}).size(), 0u);  // one face: its rim is the silhouette
  // Beside the plane of a side by less than the round's middle lies behind it.
  EXPECT_EQ(samplesOfFeatures(m, {0, 0.0245, 0.4}).size(), 0u);
  EXPECT_EQ(samplesOfFeatures(m, {0, 0.0255, 0.4}).size(), 1u);
}

TEST(RoundedCircles, AreSeenWhereBothSurfacesFaceTheEye) {
  const double r = 0.002;
  const ObjectModel m = build(revolved(joined({{{0, 0}},
                                               arc({0.03 - r, r}, r, -kPi / 2, 0),
                                               arc({0.03 - r, 0.04 - r}, r, 0, kPi / 2),
                                               {{0, 0.04}}}),
                                       72));
  ASSERT_EQ(m.circles.size(), 2u);
  EXPECT_EQ(samplesOfFeatures(m, {0, 0, 0.4}).size(), 0u);  // from above: a silhouette all round
  const std::map<int, int> oblique = samplesOfFeatures(m, {0.3, 0, 0.2});
  ASSERT_EQ(oblique.size(), 1u);
  ContourOptions options;
  const double all = 2 * kPi * (0.03 - kInset * r) / options.step;
  // Its near part, where cos(angle) > radius / distance.
  EXPECT_NEAR(oblique.begin()->second / all, std::acos(0.03 / 0.3) / kPi, 0.03);
}

}  // namespace
}  // namespace monocular_eye_hand
