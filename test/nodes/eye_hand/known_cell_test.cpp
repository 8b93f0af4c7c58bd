#include <gtest/gtest.h>

#include "cube_on_table.h"
#include "monocular_eye_hand/geometry/error.h"
#include "nodes/common/optical_frame.h"
#include "nodes/eye_hand/known_cell.h"

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
  EyeHandParameters parameters;
  CellBox post;
  post.name = "post";
  post.x = 0.2;
  post.yaw = M_PI / 2;
  post.size = {{0.1, 0.2, 1}};
  parameters.boxes = {post};
  KnownSpace space = knownCell(parameters, 0.3, lookingDown(0.5, 0, 0.6), std::nullopt);
  EXPECT_EQ(space.table_height, 0.3);
  ASSERT_TRUE(has(space, "post"));
  EXPECT_NEAR(std::abs(space.boxes[0].base_from_box.rotation(1, 0)), 1, 1e-12);
  EXPECT_TRUE(has(space, "the hand"));
  EXPECT_FALSE(has(space, "the fingers of the hand"));
  EXPECT_FALSE(has(space, "what the hand holds"));

  space = knownCell(parameters, 0.3, lookingDown(0.5, 0, 0.6), state(0.05, false));
  EXPECT_TRUE(has(space, "the fingers of the hand"));
  EXPECT_FALSE(has(space, "what the hand holds"));
  space = knownCell(parameters, 0.3, lookingDown(0.5, 0, 0.6), state(0.04, true));
  ASSERT_EQ(space.boxes.back().name, "what the hand holds");
  EXPECT_EQ(space.boxes.back().size.y(), 0.04);
  EXPECT_NEAR((space.boxes.back().base_from_box.translation - Eigen::Vector3d(0.5, 0, 0.6)).norm(), 0, 1e-12);
  space = knownCell(parameters, 0.3, lookingDown(0.5, 0, 0.6), state(0.001, true));  // closed on nothing
  EXPECT_FALSE(has(space, "what the hand holds"));

  parameters.table = false;
  EXPECT_FALSE(knownCell(parameters, 0.3, lookingDown(0.5, 0, 0.6), std::nullopt).table_height);
}

TEST(KnownCell, BoxesHaveNamesOfTheirOwn) {
  EyeHandParameters parameters;
  parameters.objects = parameters.urdf = "file";
  parameters.boxes.resize(2);
  parameters.boxes[0].name = parameters.boxes[1].name = "post";
  EXPECT_THROW(parameters.check(), BadInput);
  parameters.boxes[1].name = "table";
  EXPECT_THROW(parameters.check(), BadInput);
  parameters.boxes[1].name = "wall";
  EXPECT_NO_THROW(parameters.check());
}

class BodyFrame : public testing::Test {
 protected:
  /// A view by a camera that looks down on cubes, whose frame has these axes in the optical ones.
  ObjectView view(const Eigen::Matrix3d& optical_from_frame,
                  const std::vector<Eigen::Vector3d>& in_base) const {
    const Rigid3 base_from_optical = lookingDown(0.5, 0, 0.8);
    ObjectView view;
    view.hand.base_from_tool0 = base_from_optical;
    view.hand_eye.tool0_from_camera = {optical_from_frame, Eigen::Vector3d::Zero()};
    for (const Eigen::Vector3d& foot : in_base) view.objects.push_back(seenCube(base_from_optical, foot));
    return view;
  }
  const ModelBase models_ = cube();
};

TEST_F(BodyFrame, AnOpticalFrameIsNone) {
  const Eigen::Matrix3d optical = Eigen::Matrix3d::Identity();
  EXPECT_EQ(axesOf(view(optical, {{0.5, 0.05, 0.3}}), models_, 0.3), FrameAxes::kOptical);
  EXPECT_EQ(axesOf(view(optical, {{0.5, 0.05, 0.4}, {0.4, 0.1, 0.3}}), models_, 0.3), FrameAxes::kOptical);
  EXPECT_EQ(axesOf(view(optical, {{0.5, 0.05, 0.4}}), models_, 0.3), FrameAxes::kUnknown);  // on another part
  EXPECT_EQ(axesOf(view(optical, {}), models_, 0.3), FrameAxes::kUnknown);
}

TEST_F(BodyFrame, ABodyFrameIsSeen) {
  const Eigen::Matrix3d body = bodyFromOptical().transpose();
  EXPECT_EQ(axesOf(view(body, {{0.5, 0.05, 0.3}}), models_, 0.3), FrameAxes::kBody);
  EXPECT_EQ(axesOf(view(body, {{0.5, 0.05, 0.3}, {0.4, -0.1, 0.3}}), models_, 0.3), FrameAxes::kBody);
}

}  // namespace
}  // namespace monocular_eye_hand
