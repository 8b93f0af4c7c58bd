#include "monocular_eye_hand/eye_hand/frame_axes.h"

#include <gtest/gtest.h>

#include "cube_on_table.h"
#include "monocular_eye_hand/geometry/optical_axes.h"

namespace monocular_eye_hand {
namespace {

class FrameAxesTest : public testing::Test {
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

TEST_F(FrameAxesTest, AnOpticalFrameIsNone) {
  const Eigen::Matrix3d optical = Eigen::Matrix3d::Identity();
  EXPECT_EQ(axesOf(view(optical, {{0.5, 0.05, 0.3}}), models_, 0.3), FrameAxes::kOptical);
  EXPECT_EQ(axesOf(view(optical, {{0.5, 0.05, 0.4}, {0.4, 0.1, 0.3}}), models_, 0.3), FrameAxes::kOptical);
  EXPECT_EQ(axesOf(view(optical, {{0.5, 0.05, 0.4}}), models_, 0.3), FrameAxes::kUnknown);  // on another part
  EXPECT_EQ(axesOf(view(optical, {}), models_, 0.3), FrameAxes::kUnknown);
}

TEST_F(FrameAxesTest, ABodyFrameIsSeen) {
  const Eigen::Matrix3d body = bodyFromOptical().transpose();
  EXPECT_EQ(axesOf(view(body, {{0.5, 0.05, 0.3}}), models_, 0.3), FrameAxes::kBody);
  EXPECT_EQ(axesOf(view(body, {{0.5, 0.05, 0.3}, {0.4, -0.1, 0.3}}), models_, 0.3), FrameAxes::kBody);
}

}  // namespace
}  // namespace monocular_eye_hand
