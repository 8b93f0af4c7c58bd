#include "monocular_eye_hand/model/wireframe.h"

#include <gtest/gtest.h>

#include <cmath>

namespace monocular_eye_hand {
namespace {

ObjectModel twoEdgedBox() {
  ObjectModel model;
  model.bounds = Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 2, 4));
  return model;
}

TEST(Wireframe, HasEveryEdge) {
  ObjectModel model = twoEdgedBox();
  model.edges.resize(2);
  model.edges[1].p = {1, 2, 3};
  model.edges[1].q = {4, 5, 6};
  const auto lines = wireframe(model);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[1].p, model.edges[1].p);
  EXPECT_EQ(lines[1].q, model.edges[1].q);
}

TEST(Wireframe, AnArcIsChordsFromItsStartToItsEnd) {
  ObjectModel model = twoEdgedBox();
  ModelCircle circle;
  circle.centre = {0, 0, 1};
  circle.axis = {0, 0, 1};
  circle.x_axis = {1, 0, 0};
  circle.radius = 2;
  circle.sweep = M_PI / 2;
  model.circles = {circle};

  const auto lines = wireframe(model);
  ASSERT_GE(lines.size(), 10u);
  EXPECT_LT((lines.front().p - Eigen::Vector3d(2, 0, 1)).norm(), 1e-12);
  EXPECT_LT((lines.back().q - Eigen::Vector3d(0, 2, 1)).norm(), 1e-12);
  for (size_t k = 1; k < lines.size(); ++k) EXPECT_EQ(lines[k - 1].q, lines[k].p);
}

TEST(Wireframe, WithoutEdgesItIsTheBox) {
  double length = 0;
  const auto lines = wireframe(twoEdgedBox());
  for (const WireframeLine& line : lines) length += (line.q - line.p).norm();
  EXPECT_EQ(lines.size(), 12u);
  EXPECT_EQ(length, 4 * (1 + 2 + 4));
}

}  // namespace
}  // namespace monocular_eye_hand
