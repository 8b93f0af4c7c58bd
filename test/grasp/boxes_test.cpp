#include "grasp/boxes.h"

#include <gtest/gtest.h>

#include <random>

#include "grasp_world.h"

namespace monocular_eye_hand {
namespace {

using namespace grasp_world;

TEST(Boxes, OverlapAgreesWithSampledTriangles) {
  // A triangle meets a box when one of its points lies in the box; random pairs, both answers often.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1, 1);
  const auto point = [&] { return Eigen::Vector3d(place(random), place(random), place(random)); };
  int meeting = 0, unsampled = 0;

  for (int pass = 0; pass < 3000; ++pass) {
    const Eigen::Vector3d a = point(), b = point(), c = point(), middle = 0.5 * point();
    const Eigen::Vector3d half(0.1 + 0.2 * std::abs(place(random)), 0.1, 0.15);
    const Eigen::AlignedBox3d box(middle - half, middle + half);
    double nearest = 1e9;  // of the samples to the box
    for (int i = 0; i <= 60; ++i)
      for (int k = 0; k + i <= 60; ++k)
        nearest = std::min(nearest, box.exteriorDistance(a + (b - a) * (i / 60.0) + (c - a) * (k / 60.0)));
    const bool meets = overlap(box, a, b, c);
    meeting += meets;
    if (nearest == 0) {
      EXPECT_TRUE(meets) << pass;
    }
    if (nearest > 0.05) {  // farther than the samples are apart
      EXPECT_FALSE(meets) << pass;
    }
    unsampled += nearest > 0 && nearest <= 0.05;
  }

  EXPECT_GT(meeting, 300);
  EXPECT_LT(unsampled, 900);
}

TEST(Boxes, TouchingIsNotMeeting) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 1));
  EXPECT_FALSE(overlap(box, {1, -1, -1}, {1, 1, -1}, {1, 0, 1}));
  EXPECT_TRUE(overlap(box, {0.999, -1, -1}, {0.999, 1, -1}, {0.999, 0, 1}));
  EXPECT_TRUE(overlap(box, {-9, -9, 0}, {9, -9, 0}, {0, 18, 0}));  // larger than the box on all sides
}

TEST(Boxes, ASolidAroundABoxMeetsIt) {
  const ObjectModel model = boxModel(0.2, 0.2, 0.2);
  const Boxes within{{Eigen::Vector3d(-0.01, -0.01, 0.09), Eigen::Vector3d(0.01, 0.01, 0.11)}};
  EXPECT_TRUE(MeshInHand(model, {}).meets(within));
  EXPECT_FALSE(MeshInHand(model, {Eigen::Matrix3d::Identity(), {0.3, 0, 0}}).meets(within));
}

TEST(Boxes, SweptHandHoldsThePathOfTheHand) {
  const GripperOptions gripper;
  const double width = 0.03, opening = 0.06, approach = 0.08;
  const Boxes swept = sweptBoxes(gripper, opening, width, approach);
  const auto covered = [&](const Eigen::Vector3d& p) {
    return std::any_of(swept.begin(), swept.end(),
                       [&](const Eigen::AlignedBox3d& b) { return b.exteriorDistance(p) < 1e-12; });
  };

  for (double back = 0; back <= approach; back += 0.01)
    for (const Eigen::AlignedBox3d& b : handBoxes(gripper, opening))
      for (int corner = 0; corner < 8; ++corner)
        EXPECT_TRUE(
            covered(b.corner(Eigen::AlignedBox3d::CornerType(corner)) - back * Eigen::Vector3d::UnitZ()));
  for (double w = width + 2 * gripper.compliance; w <= opening; w += 0.005)
    for (int k = 0; k < 2; ++k)  // the fingers
      for (int corner = 0; corner < 8; ++corner)
        EXPECT_TRUE(
            covered(handBoxes(gripper, w)[size_t(k)].corner(Eigen::AlignedBox3d::CornerType(corner))));
  EXPECT_FALSE(covered({0, 0, 0}));
}

}  // namespace
}  // namespace monocular_eye_hand
