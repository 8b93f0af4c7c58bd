#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "nodes/eye_hand/joint_history.h"

namespace monocular_eye_hand {
namespace {

using Match = JointHistory::Match;
using testing::HasSubstr;

const std::array<std::string, 6> kNames{{"a", "b", "c", "d", "e", "f"}};

// Joint k of the arm stands at `angle` + k; the fingers come first and the arm's joints backwards.
sensor_msgs::JointState message(double stamp, double angle) {
  sensor_msgs::JointState state;
  state.header.stamp = ros::Time(stamp);
  state.name = {"finger"};
  state.position = {7};
  for (size_t k = 6; k-- > 0;) {
    state.name.push_back(kNames[k]);
    state.position.push_back(angle + double(k));
  }
  return state;
}

class History : public testing::Test {
 protected:
  void add(double stamp, double angle) { history_.add(message(stamp, angle), ros::Time(500)); }
  Match at(double stamp, double max_gap = 0.5) { return history_.at(ros::Time(stamp), max_gap, &joints_); }
  void expectJoints(double angle) {
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(joints_[k], angle + k, 1e-9);
  }
  JointHistory history_{kNames, 10};
  JointVector joints_ = JointVector::Zero();
  ros::Time stamp_;
};

TEST_F(History, IsEmptyAtFirst) {
  EXPECT_EQ(at(100), Match::kNone);
  EXPECT_FALSE(history_.latest(&joints_, &stamp_));
  EXPECT_EQ(history_.problem(), "no message came");
}

TEST_F(History, InterpolatesBetweenTwo) {
  add(100, 0.2);
  add(100.4, 0.6);
  EXPECT_EQ(at(100.1), Match::kBetween);
  expectJoints(0.3);
  EXPECT_EQ(at(100), Match::kBetween);
  expectJoints(0.2);
  EXPECT_EQ(at(100.4), Match::kBetween);
  expectJoints(0.6);
  EXPECT_EQ(history_.problem(), "");
}

TEST_F(History, TakesTheNearestWithinTheGap) {
  add(100, 0.2);
  EXPECT_EQ(at(100.3), Match::kNear);
  expectJoints(0.2);
  EXPECT_EQ(at(99.6), Match::kNear);
  expectJoints(0.2);
  EXPECT_EQ(at(100.6), Match::kNone);
  EXPECT_EQ(at(99.4), Match::kNone);
  add(102, 0.9);
  EXPECT_EQ(at(101.7), Match::kNear);  // the gap between the two is too wide to interpolate
  expectJoints(0.9);
  EXPECT_EQ(at(101), Match::kNone);
}

TEST_F(History, LatestIsTheLast) {
  add(100, 0.2);
  add(101, 0.3);
  ASSERT_TRUE(history_.latest(&joints_, &stamp_));
  expectJoints(0.3);
  EXPECT_EQ(stamp_, ros::Time(101));
}

TEST_F(History, TellsHowFastTheFastestJointTurns) {
  const auto speed = [this](double stamp) { return history_.speedAt(ros::Time(stamp), 0.05, 0.5); };
  EXPECT_EQ(speed(100), 0);
  for (int k = 0; k <= 10; ++k) add(100 + 0.1 * k, k < 5 ? 0.2 * k : 1.0);  // it stands from 100.5 on
  EXPECT_NEAR(speed(100.25), 2, 1e-6);
  EXPECT_NEAR(speed(100.0), 2, 1e-6);  // nothing is known of before
  EXPECT_NEAR(speed(100.5), 0, 1e-6);  // it has just stopped
  EXPECT_NEAR(speed(100.8), 0, 1e-6);
  EXPECT_EQ(speed(101.2), 0);
  add(0.01, 0.2);  // the clock was set back to its begin
  add(0.03, 0.6);
  EXPECT_EQ(speed(0.02), 0);
}

TEST_F(History, WithoutStampItIsOfNow) {
  sensor_msgs::JointState state = message(0, 0.4);
  state.header.stamp = ros::Time();
  history_.add(state, ros::Time(500));
  ASSERT_TRUE(history_.latest(&joints_, &stamp_));
  EXPECT_EQ(stamp_, ros::Time(500));
}

TEST_F(History, ForgetsWhatIsOld) {
  add(100, 0.2);
  for (int k = 1; k <= 12; ++k) add(100 + k, 0.2 + k);
  EXPECT_EQ(at(100), Match::kNone);
  EXPECT_EQ(at(102), Match::kBetween);
}

TEST_F(History, TimeThatGoesBack) {
  add(100, 0.2);
  add(99.5, 0.7);  // late, and of no use
  ASSERT_TRUE(history_.latest(&joints_, &stamp_));
  EXPECT_EQ(stamp_, ros::Time(100));
  add(5, 0.7);  // the clock was set back
  ASSERT_TRUE(history_.latest(&joints_, &stamp_));
  EXPECT_EQ(stamp_, ros::Time(5));
  EXPECT_EQ(at(100), Match::kNone);
}

TEST_F(History, LeavesOutWhatIsBroken) {
  sensor_msgs::JointState state = message(100, 0.2);
  state.position[2] = std::nan("");  // of e
  history_.add(state, ros::Time(500));
  EXPECT_EQ(history_.problem(), "the position of e is not finite");
  state = message(100, 0.2);
  state.name[3] = "other";
  history_.add(state, ros::Time(500));
  EXPECT_THAT(history_.problem(), HasSubstr("no position of d"));
  state = message(100, 0.2);
  state.position.resize(3);  // shorter than the names
  history_.add(state, ros::Time(500));
  EXPECT_THAT(history_.problem(), HasSubstr("no position of a"));
  EXPECT_FALSE(history_.latest(&joints_, &stamp_));
  add(100, 0.2);
  EXPECT_EQ(history_.problem(), "");
  sensor_msgs::JointState fingers;  // a gripper that speaks for itself is no problem
  fingers.name = {"finger"};
  fingers.position = {1};
  history_.add(fingers, ros::Time(500));
  EXPECT_EQ(history_.problem(), "");
}

// Some of the joints at `angle` + k.
sensor_msgs::JointState part(double stamp, double angle, const std::vector<int>& joints) {
  sensor_msgs::JointState state;
  state.header.stamp = ros::Time(stamp);
  for (int k : joints) {
    state.name.push_back(kNames[size_t(k)]);
    state.position.push_back(angle + k);
  }
  return state;
}

TEST_F(History, JointsOfSeveralMessagesAreOneArm) {
  const ros::Time now(500);
  history_.add(part(100, 0.2, {0, 1, 2}), now);
  EXPECT_EQ(at(100), Match::kNone);
  EXPECT_FALSE(history_.latest(&joints_, &stamp_));
  EXPECT_EQ(history_.problem(), "the messages have no position of d, e, f");
  history_.add(part(100.02, 0.22, {5, 4, 3}), now);
  EXPECT_EQ(history_.problem(), "");
  ASSERT_TRUE(history_.latest(&joints_, &stamp_));
  EXPECT_EQ(stamp_, ros::Time(100));  // since then all are known
  history_.add(part(100.4, 0.6, {0, 1, 2}), now);
  history_.add(part(100.42, 0.62, {5, 4, 3}), now);
  EXPECT_EQ(at(100.2), Match::kBetween);
  expectJoints(0.4);
  EXPECT_EQ(at(100.41), Match::kNear);  // of a to c nothing is known after it
}

TEST_F(History, AJointOfItsOwnPublisherMayBeSlow) {
  const ros::Time now(500);
  for (int k = 0; k <= 10; ++k) history_.add(part(100 + 0.1 * k, 0.1 * k, {0, 1, 2, 3, 4}), now);
  history_.add(part(100, 0, {5}), now);
  EXPECT_EQ(at(100.9, 0.3), Match::kNone);  // the last of f is too old
  history_.add(part(101, 1, {5}), now);
  EXPECT_EQ(at(100.5, 0.6), Match::kBetween);
  expectJoints(0.5);
  ASSERT_TRUE(history_.latest(&joints_, &stamp_));
  EXPECT_EQ(stamp_, ros::Time(101));
}

}  // namespace
}  // namespace monocular_eye_hand
