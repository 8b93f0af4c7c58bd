#include <gtest/gtest.h>

#include "nodes/common/camera_info.h"

namespace monocular_eye_hand {
namespace {

TEST(CameraInfo, EveryFieldArrives) {
  sensor_msgs::CameraInfo message;
  message.width = 640;
  message.height = 480;
  message.distortion_model = "plumb_bob";
  message.D = {-0.28, 0.08, 0.001, -0.0005, 0.01};
  message.K = {700, 0, 320.5, 0, 710, 240.25, 0, 0, 1};
  message.R = {1, 0, 0, 0, 0, 1, 0, -1, 0};
  message.P = {650, 0, 315, 0, 0, 660, 235, 0, 0, 0, 1, 0};
  message.binning_x = 2;
  message.binning_y = 4;
  message.roi.x_offset = 10;
  message.roi.y_offset = 20;
  message.roi.width = 400;
  message.roi.height = 300;
  message.roi.do_rectify = true;

  const ImageCalibration calibration = fromMessage(message);
  EXPECT_EQ(calibration.binning_x, 2);
  EXPECT_EQ(calibration.binning_y, 4);
  EXPECT_EQ(calibration.region.x, 10);
  EXPECT_EQ(calibration.region.y, 20);
  EXPECT_EQ(calibration.region.width, 400);
  EXPECT_EQ(calibration.region.height, 300);
  EXPECT_TRUE(calibration.region.do_rectify);

  const sensor_msgs::CameraInfo back = toMessage(calibration);
  EXPECT_EQ(back.width, message.width);
  EXPECT_EQ(back.height, message.height);
  EXPECT_EQ(back.distortion_model, message.distortion_model);
  EXPECT_EQ(back.D, message.D);
  EXPECT_EQ(back.K, message.K);
  EXPECT_EQ(back.R, message.R);
  EXPECT_EQ(back.P, message.P);
}

}  // namespace
}  // namespace monocular_eye_hand
