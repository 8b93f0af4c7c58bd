#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "monocular_eye_hand/geometry/optical_axes.h"
#include "nodes/common/optical_frame.h"

namespace monocular_eye_hand {
namespace {

class OpticalFrame : public testing::Test {
 protected:
  void hang(const std::string& frame, const std::string& child, const Eigen::Matrix3d& frame_from_child) {
    const Eigen::Quaterniond q(frame_from_child);
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = frame;
    transform.child_frame_id = child;
    transform.transform.rotation.x = q.x();
    transform.transform.rotation.y = q.y();
    transform.transform.rotation.z = q.z();
    transform.transform.rotation.w = q.w();
    ASSERT_TRUE(tf_.setTransform(transform, "test", true));
  }
  tf2::BufferCore tf_;
};

TEST_F(OpticalFrame, HangsInTheBodyOfTheCamera) {
  EXPECT_EQ(opticalFrameIn(tf_, "camera_link"), "");
  hang("tool0", "camera_link", Eigen::Matrix3d::Identity());
  EXPECT_EQ(opticalFrameIn(tf_, "camera_link"), "");
  hang("camera_link", "camera_optical_frame", bodyFromOptical());
  EXPECT_EQ(opticalFrameIn(tf_, "camera_link"), "camera_optical_frame");
  EXPECT_EQ(opticalFrameIn(tf_, "camera_optical_frame"), "");
  EXPECT_EQ(opticalFrameIn(tf_, "tool0"), "") << "hangs in another frame";
}

TEST_F(OpticalFrame, IsKnownByNameAndAxes) {
  hang("camera_link", "other", bodyFromOptical());
  hang("camera_link", "depth_optical_frame", Eigen::Matrix3d::Identity());
  EXPECT_EQ(opticalFrameIn(tf_, "camera_link"), "");
}

TEST_F(OpticalFrame, TurnsForwardIntoX) {
  EXPECT_TRUE((bodyFromOptical() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE((bodyFromOptical() * -Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d::UnitZ()));
}

}  // namespace
}  // namespace monocular_eye_hand
