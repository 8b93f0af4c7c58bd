#include "monocular_eye_hand/grasp/known_cell.h"

#include <gtest/gtest.h>

#include "../eye_hand/cube_on_table.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

GripperReading state(double width, bool stalled) {
  GripperReading gripper;
  gripper.width = width;
  gripper.stalled = stalled;
  return gripper;
}

bool has(const KnownSpace& space, const std::string& name) {
  for (const KnownBox& box : space.boxes)
    if (box.name == name) return true;
  return false;
}

TEST(KnownCell, TableBoxesHandAndWhatItHolds) {
  GraspingOptions options;
  CellBox post;
  post.name = "post";
  post.x = 0.2;
  post.yaw = M_PI / 2;
  post.size = {{0.1, 0.2, 1}};
  options.boxes = {post};
  KnownSpace space = knownCell(options, 0.3, lookingDown(0.5, 0, 0.6), std::nullopt);
  EXPECT_EQ(space.table_height, 0.3);
  ASSERT_TRUE(has(space, "post"));
  EXPECT_NEAR(std::abs(space.boxes[0].base_from_box.rotation(1, 0)), 1, 1e-12);
  EXPECT_TRUE(has(space, "the hand"));
  EXPECT_FALSE(has(space, "the fingers of the hand"));
  EXPECT_FALSE(has(space, "what the hand holds"));

  space = knownCell(options, 0.3, lookingDown(0.5, 0, 0.6), state(0.05, false));
  EXPECT_TRUE(has(space, "the fingers of the hand"));
  EXPECT_FALSE(has(space, "what the hand holds"));
  space = knownCell(options, 0.3, lookingDown(0.5, 0, 0.6), state(0.04, true));
  ASSERT_EQ(space.boxes.back().name, "what the hand holds");
  EXPECT_EQ(space.boxes.back().size.y(), 0.04);
  EXPECT_NEAR((space.boxes.back().base_from_box.translation - Eigen::Vector3d(0.5, 0, 0.6)).norm(), 0, 1e-12);
  space = knownCell(options, 0.3, lookingDown(0.5, 0, 0.6), state(0.001, true));  // closed on nothing
  EXPECT_FALSE(has(space, "what the hand holds"));

  options.table = false;
  EXPECT_FALSE(knownCell(options, 0.3, lookingDown(0.5, 0, 0.6), std::nullopt).table_height);
}

TEST(KnownCell, BoxesHaveNamesOfTheirOwn) {
  GraspingOptions options;
  options.boxes.resize(2);
  options.boxes[0].name = options.boxes[1].name = "post";
  EXPECT_THROW(options.check(), BadInput);
  options.boxes[1].name = "table";
  EXPECT_THROW(options.check(), BadInput);
  options.boxes[1].name = "wall";
  EXPECT_NO_THROW(options.check());
}

}  // namespace
}  // namespace monocular_eye_hand
