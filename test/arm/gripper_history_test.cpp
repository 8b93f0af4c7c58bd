#include <gtest/gtest.h>

#include "monocular_eye_hand/arm/gripper_history.h"

namespace monocular_eye_hand {
namespace {

class GripperHistoryTest : public testing::Test {
 protected:
  void add(double stamp, double width) {
    GripperReading reading;
    reading.stamp = stamp;
    reading.width = width;
    history_.add(nanosecondsOf(stamp), reading);
  }
  double widthAt(double stamp) const {
    const std::optional<GripperReading> reading = history_.at(nanosecondsOf(stamp), 1);
    return reading ? reading->width : -1;
  }
  GripperHistory history_{10};
};

TEST_F(GripperHistoryTest, TellsTheLastOneBefore) {
  EXPECT_EQ(widthAt(100), -1);
  add(100, 0.01);
  add(100.5, 0.02);
  EXPECT_EQ(widthAt(99.9), -1);
  EXPECT_EQ(widthAt(100), 0.01);
  EXPECT_EQ(widthAt(100.4), 0.01);
  EXPECT_EQ(widthAt(101.5), 0.02);
  EXPECT_EQ(widthAt(101.6), -1);
}

TEST_F(GripperHistoryTest, KeepsWhatMemorySays) {
  for (int k = 0; k < 1000; ++k) add(100 + k, 0.01);
  EXPECT_EQ(history_.size(), 11u);
}

TEST_F(GripperHistoryTest, DoesNotGrowWhileTheClockStands) {
  for (int k = 0; k < 1000; ++k) add(100, 0.001 * k);
  EXPECT_EQ(history_.size(), 1u);
  EXPECT_EQ(widthAt(100), 0.999);
}

TEST_F(GripperHistoryTest, BeginsAgainWhenTimeGoesBack) {
  add(100, 0.01);
  add(99.5, 0.02);  // late
  EXPECT_EQ(widthAt(100), 0.01);
  add(50, 0.03);
  EXPECT_EQ(widthAt(100), -1);
  EXPECT_EQ(widthAt(50), 0.03);
}

TEST_F(GripperHistoryTest, TakesAnyStamp) {
  add(100, 0.01);
  add(4294967295.0, 0.02);
  EXPECT_EQ(widthAt(100), -1);
  EXPECT_EQ(widthAt(4294967295.0), 0.02);
}

}  // namespace
}  // namespace monocular_eye_hand
