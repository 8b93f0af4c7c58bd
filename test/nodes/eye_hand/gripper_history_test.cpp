#include <gtest/gtest.h>

#include "nodes/eye_hand/gripper_history.h"

namespace monocular_eye_hand {
namespace {

class History : public testing::Test {
 protected:
  void add(double stamp, double width, double now = 500) {
    GripperState state;
    state.header.stamp = ros::Time(stamp);
    state.width = width;
    history_.add(state, ros::Time(now));
  }
  double widthAt(double stamp) const {
    const std::optional<GripperState> state = history_.at(ros::Time(stamp), 1);
    return state ? state->width : -1;
  }
  GripperHistory history_{10};
};

TEST_F(History, TellsTheLastOneBefore) {
  EXPECT_EQ(widthAt(100), -1);
  add(100, 0.01);
  add(100.5, 0.02);
  EXPECT_EQ(widthAt(99.9), -1);
  EXPECT_EQ(widthAt(100), 0.01);
  EXPECT_EQ(widthAt(100.4), 0.01);
  EXPECT_EQ(widthAt(101.5), 0.02);
  EXPECT_EQ(widthAt(101.6), -1);
}

TEST_F(History, KeepsWhatMemorySays) {
  for (int k = 0; k < 1000; ++k) add(100 + k, 0.01);
  EXPECT_EQ(history_.size(), 11u);
}

TEST_F(History, WithoutStampsCountsFromWhenTheyCame) {
  add(0, 0.01, 100);
  add(0, 0.02, 101);
  EXPECT_EQ(widthAt(100.5), 0.01);
  EXPECT_EQ(widthAt(101.5), 0.02);
}

TEST_F(History, DoesNotGrowWhileTheClockStands) {
  for (int k = 0; k < 1000; ++k) add(0, 0.001 * k, 100);
  EXPECT_EQ(history_.size(), 1u);
  EXPECT_EQ(widthAt(100), 0.999);
}

TEST_F(History, BeginsAgainWhenTimeGoesBack) {
  add(100, 0.01);
  add(99.5, 0.02);  // late
  EXPECT_EQ(widthAt(100), 0.01);
  add(50, 0.03);
  EXPECT_EQ(widthAt(100), -1);
  EXPECT_EQ(widthAt(50), 0.03);
}

TEST_F(History, TakesAnyStamp) {
  add(100, 0.01);
  add(4294967295.0, 0.02);
  EXPECT_EQ(widthAt(100), -1);
  EXPECT_EQ(widthAt(4294967295.0), 0.02);
}

}  // namespace
}  // namespace monocular_eye_hand
