#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <set>

#include "simulation/render/rounded_edges.h"
#include "simulation/scenes/planar_faces.h"
#include "simulation/scenes/print_placing.h"

using namespace monocular_eye_hand;

namespace {

const Eigen::Vector3d kSize(0.10, 0.06, 0.02);

double distanceToBox(const Eigen::Vector3d& p) {
  const Eigen::Vector3d q = (p - Eigen::Vector3d(0, 0, 0.5 * kSize.z())).cwiseAbs() - 0.5 * kSize;
  return std::abs(q.maxCoeff());
}

}  // namespace

TEST(PlanarFaces, OfABox) {
  const PlanarFaces found = planarFaces(boxMesh(kSize), 0.01);
  ASSERT_EQ(found.faces.size(), 6u);
  EXPECT_NEAR(found.faces[0].width, 0.10, 1e-6);
  EXPECT_NEAR(found.faces[0].height, 0.06, 1e-6);
  EXPECT_NEAR(found.faces[0].area, 0.006, 1e-9);
  EXPECT_NEAR(found.faces[5].area, 0.0012, 1e-9);
  for (const PlanarFace& face : found.faces) {
    const Eigen::Vector3d outside = face.object_from_face * Eigen::Vector3d(0, 0, 0.001);
    EXPECT_NEAR(distanceToBox(face.object_from_face.translation), 0, 1e-7);
    EXPECT_NEAR(distanceToBox(outside), 0.001, 1e-7) << "z points outwards";
    EXPECT_GT((outside - Eigen::Vector3d(0, 0, 0.01)).norm(),
              (face.object_from_face.translation - Eigen::Vector3d(0, 0, 0.01)).norm());
    EXPECT_NEAR(face.object_from_face.rotation.determinant(), 1, 1e-9);
  }
  EXPECT_EQ(planarFaces(boxMesh(kSize), 0.1).faces.size(), 4u) << "the two ends are too small";
  EXPECT_EQ(planarFaces(boxMesh(kSize), 0.01, 3).faces.size(), 3u);
}

TEST(PlanarFaces, FoldsCarryOneFacesPlaneIntoTheOthers) {
  const PlanarFaces found = planarFaces(boxMesh(kSize), 0.01);
  ASSERT_EQ(found.folds.size(), 24u) << "twelve edges, both ways";
  for (const FaceFold& fold : found.folds) {
    const Rigid3& from = found.faces[size_t(fold.from)].object_from_face;
    const Rigid3& to = found.faces[size_t(fold.to)].object_from_face;
    EXPECT_TRUE((fold.turn.rotation * from.rotation.col(2)).isApprox(to.rotation.col(2), 1e-9));
    EXPECT_NEAR((to.inverse() * (fold.turn * from.translation)).z(), 0, 1e-7);
    EXPECT_TRUE((fold.turn * fold.middle).isApprox(fold.middle, 1e-7)) << "the edge stays";
  }
}

TEST(PlanarFaces, RoundThingsHaveOnlyTheirEnds) {
  EXPECT_EQ(planarFaces(cylinderMesh(0.03, 0.05)).faces.size(), 2u);
  EXPECT_TRUE(planarFaces(sphereMesh(0.03)).faces.empty());
}

TEST(PrintPlacing, PackagingCoversEveryFace) {
  Generator random(4);
  const std::vector<Print> prints = drawPrints(boxMesh(kSize), PrintPlan::kPackaging, 0.0005, 0.5, &random);
  ASSERT_EQ(prints.size(), 6u);
  for (const Print& print : prints) {
    EXPECT_NEAR(distanceToBox(print.object_from_print.translation), 0, 1e-7);
    EXPECT_NEAR(print.picture.cols * 0.0005, print.width, 0.0005);
  }
}

TEST(PrintPlacing, MarksLieOnTheSurfaceAndFollowTheSeed) {
  const auto draw = [](uint32_t seed) {
    Generator random(seed);
    return drawPrints(boxMesh(kSize), PrintPlan::kMarked, 0.0005, 0.5, &random);
  };
  int count = 0;
  for (uint32_t seed = 0; seed < 30; ++seed) {
    const std::vector<Print> prints = draw(seed), again = draw(seed);
    ASSERT_EQ(prints.size(), again.size());
    for (size_t k = 0; k < prints.size(); ++k) {
      EXPECT_EQ(cv::norm(prints[k].picture, again[k].picture, cv::NORM_INF), 0);
      const bool flat = prints[k].reach < 0.001;  // others are bent around something
      EXPECT_TRUE(!flat || distanceToBox(prints[k].object_from_print.translation) < 0.06);
      ++count;
    }
  }

  EXPECT_GT(count, 40);
  Generator random(1);
  EXPECT_FALSE(drawPrints(sphereMesh(0.04), PrintPlan::kMarked, 0.0005, 0.5, &random).empty());
  EXPECT_TRUE(drawPrints(boxMesh(kSize), PrintPlan::kPackaging, 0.05, 0.5, &random).empty())
      << "too coarse to be seen";
}

TEST(PrintArt, EveryKindDrawsSomethingWithinItsRange) {
  for (const Art art :
       {Art::kText, Art::kHandwriting, Art::kLabel, Art::kBarcode, Art::kTag, Art::kLogo, Art::kPatchwork,
        Art::kBoxFront, Art::kScratches, Art::kStains, Art::kGrid, Art::kPage, Art::kRuler}) {
    Generator random(3);
    const cv::Mat_<cv::Vec2f> picture = drawArt(art, {160, 100}, 0.5, &random);
    ASSERT_EQ(picture.size(), cv::Size(160, 100));
    double covered = 0;
    for (const cv::Vec2f& value : picture) {
      ASSERT_GE(value[0], 0);
      ASSERT_LE(value[1], 1.0001f);
      ASSERT_LE(value[0], value[1] + 1e-5f) << "an albedo above 1";
      covered += value[1];
    }
    EXPECT_GT(covered, 20) << int(art);
  }
}

TEST(RoundedEdges, KnowConvexFromConcave) {
  const RoundedEdges box(boxMesh(kSize), Rigid3{}, 0.001);
  // Near the middle of a long edge of the top; the triangle that owns it is one of two.
  const Eigen::Vector3f p(0, -0.0295f, 0.02f);
  float convex = 0;
  for (uint32_t triangle = 0; triangle < 12; ++triangle)
    convex = std::max(convex, box.nearness(triangle, p, 0.001f));
  EXPECT_NEAR(convex, 0.5, 1e-3);

  // The same box as a hole: its triangles the other way round.
  Mesh inside_out = boxMesh(kSize);
  for (auto& t : inside_out.triangles) std::swap(t[1], t[2]);
  const RoundedEdges hole(inside_out, Rigid3{}, 0.001);
  for (uint32_t triangle = 0; triangle < 12; ++triangle) EXPECT_EQ(hole.nearness(triangle, p, 0.001f), 0);
}

TEST(RoundedEdges, TurnTheNormalHalfWayOnTheEdge) {
  const RoundedEdges box(boxMesh(kSize), Rigid3{}, 0.001);
  const Eigen::Vector3f up(0, 0, 1), bisector = Eigen::Vector3f(0, -1, 1).normalized();
  int found = 0;
  for (uint32_t triangle = 4; triangle < 6 && found == 0; ++triangle) {  // the top's
    const RoundedEdges::Bend on_edge = box.bend(triangle, {0, -0.03f, 0.02f}, up);
    if (!on_edge.bent) continue;
    ++found;
    EXPECT_TRUE(on_edge.normal.isApprox(bisector, 1e-3f));
    const RoundedEdges::Bend half = box.bend(triangle, {0, -0.0295f, 0.02f}, up);
    EXPECT_NEAR(std::acos(half.normal.z()), M_PI / 8, 0.03);
    EXPECT_FALSE(box.bend(triangle, {0, -0.0285f, 0.02f}, up).bent);
  }
  EXPECT_EQ(found, 1);
}
