#include <gtest/gtest.h>

#include "nodes/common/moment.h"

namespace monocular_eye_hand {
namespace {

class MomentTest : public testing::Test {
 protected:
  void TearDown() override { ros::Time::init(); }  // the wall's clock again
};

TEST_F(MomentTest, NeverIsNoMoment) {
  ros::Time::init();
  EXPECT_TRUE(Moment().never());
  EXPECT_FALSE(Moment::now().never());
}

TEST_F(MomentTest, InRealTimeTheWallCounts) {
  ros::Time::init();
  const Moment moment = Moment::now();
  const ros::WallTime before = ros::WallTime::now();
  ros::WallDuration(0.05).sleep();
  EXPECT_GE(moment.since(), (ros::WallTime::now() - before).toSec() - 1e-3);
}

TEST_F(MomentTest, AStandingClockIsNoSilence) {
  ros::Time::setNow(ros::Time(100));
  const Moment moment = Moment::now();
  ros::WallDuration(0.05).sleep();
  EXPECT_EQ(moment.since(), 0);
  ros::Time::setNow(ros::Time(100.01));
  EXPECT_NEAR(moment.since(), 0.01, 1e-9);
}

TEST_F(MomentTest, AFastClockIsNoSilenceEither) {
  ros::Time::setNow(ros::Time(100));
  const Moment moment = Moment::now();
  ros::Time::setNow(ros::Time(1e6));
  EXPECT_LT(moment.since(), 60);  // of the wall
}

TEST_F(MomentTest, WithoutAClockTheWallCounts) {
  ros::Time::setNow(ros::Time());
  const Moment moment = Moment::now();
  ros::WallDuration(0.05).sleep();
  EXPECT_GE(moment.since(), 0.05);
}

TEST_F(MomentTest, AClockThatWasSetBackTellsNothing) {
  ros::Time::setNow(ros::Time(100));
  const Moment moment = Moment::now();
  ros::Time::setNow(ros::Time(5));
  ros::WallDuration(0.05).sleep();
  EXPECT_GE(moment.since(), 0.05);
}

}  // namespace
}  // namespace monocular_eye_hand
