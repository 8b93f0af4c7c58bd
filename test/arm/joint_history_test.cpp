#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "monocular_eye_hand/arm/joint_history.h"

namespace monocular_eye_hand {
namespace {

using Match = JointHistory::Match;
using testing::HasSubstr;

const std::array<std::string, 6> kNames{{"a", "b", "c", "d", "e", "f"}};

// Joint k of the arm stands at `angle` + k; the fingers come first and the arm's joints backwards.
JointSample sample(double stamp, double angle) {
  JointSample joints;
  joints.stamp = nanosecondsOf(stamp);
  joints.names = {"finger"};
  joints.positions = {7};
  for (size_t k = 6; k-- > 0;) {
    joints.names.push_back(kNames[k]);
    joints.positions.push_back(angle + double(k));
  }
  return joints;
}

class JointHistoryTest : public testing::Test {
 protected:
  void add(double stamp, double angle) { history_.add(sample(stamp, angle)); }
  Match at(double stamp, double max_gap = 0.5) {
    const JointHistory::Found found = history_.at(nanosecondsOf(stamp), max_gap);
    joints_ = found.joints;
    return found.match;
  }
  bool knowsLatest() {
    const std::optional<JointHistory::Latest> latest = history_.latest();
    if (latest) joints_ = latest->joints;
    stamp_ = latest ? latest->stamp : 0;
    return bool(latest);
  }
  void expectJoints(double angle) {
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(joints_[k], angle + k, 1e-9);
  }
  JointHistory history_{kNames, 10};
  JointVector joints_ = JointVector::Zero();
  Nanoseconds stamp_ = 0;
};

TEST_F(JointHistoryTest, IsEmptyAtFirst) {
  EXPECT_EQ(at(100), Match::kNone);
  EXPECT_FALSE(knowsLatest());
  EXPECT_EQ(history_.problem(), "no message came");
}

TEST_F(JointHistoryTest, InterpolatesBetweenTwo) {
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

TEST_F(JointHistoryTest, TakesTheNearestWithinTheGap) {
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

TEST_F(JointHistoryTest, LatestIsTheLast) {
  add(100, 0.2);
  add(101, 0.3);
  ASSERT_TRUE(knowsLatest());
  expectJoints(0.3);
  EXPECT_EQ(stamp_, nanosecondsOf(101));
}

TEST_F(JointHistoryTest, TellsHowFastTheFastestJointTurns) {
  const auto speed = [this](double stamp) { return history_.speedAt(nanosecondsOf(stamp), 0.05, 0.5); };
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

TEST_F(JointHistoryTest, ForgetsWhatIsOld) {
  add(100, 0.2);
  for (int k = 1; k <= 12; ++k) add(100 + k, 0.2 + k);
  EXPECT_EQ(at(100), Match::kNone);
  EXPECT_EQ(at(102), Match::kBetween);
}

TEST_F(JointHistoryTest, TimeThatGoesBack) {
  add(100, 0.2);
  add(99.5, 0.7);  // late, and of no use
  ASSERT_TRUE(knowsLatest());
  EXPECT_EQ(stamp_, nanosecondsOf(100));
  add(5, 0.7);  // the clock was set back
  ASSERT_TRUE(knowsLatest());
  EXPECT_EQ(stamp_, nanosecondsOf(5));
  EXPECT_EQ(at(100), Match::kNone);
}

TEST_F(JointHistoryTest, LeavesOutWhatIsBroken) {
  JointSample joints = sample(100, 0.2);
  joints.positions[2] = std::nan("");  // of e
  history_.add(joints);
  EXPECT_EQ(history_.problem(), "the position of e is not finite");
  joints = sample(100, 0.2);
  joints.names[3] = "other";
  history_.add(joints);
  EXPECT_THAT(history_.problem(), HasSubstr("no position of d"));

  joints = sample(100, 0.2);
  joints.positions.resize(3);  // shorter than the names
  history_.add(joints);
  EXPECT_THAT(history_.problem(), HasSubstr("no position of a"));
  EXPECT_FALSE(knowsLatest());
  add(100, 0.2);
  EXPECT_EQ(history_.problem(), "");
  JointSample fingers;  // a gripper that speaks for itself is no problem
  fingers.names = {"finger"};
  fingers.positions = {1};
  history_.add(fingers);
  EXPECT_EQ(history_.problem(), "");
}

// Some of the joints at `angle` + k.
JointSample part(double stamp, double angle, const std::vector<int>& joints) {
  JointSample out;
  out.stamp = nanosecondsOf(stamp);
  for (int k : joints) {
    out.names.push_back(kNames[size_t(k)]);
    out.positions.push_back(angle + k);
  }
  return out;
}

TEST_F(JointHistoryTest, JointsOfSeveralMessagesAreOneArm) {
  history_.add(part(100, 0.2, {0, 1, 2}));
  EXPECT_EQ(at(100), Match::kNone);
  EXPECT_FALSE(knowsLatest());
  EXPECT_EQ(history_.problem(), "the messages have no position of d, e, f");
  history_.add(part(100.02, 0.22, {5, 4, 3}));
  EXPECT_EQ(history_.problem(), "");
  ASSERT_TRUE(knowsLatest());
  EXPECT_EQ(stamp_, nanosecondsOf(100));  // since then all are known
  history_.add(part(100.4, 0.6, {0, 1, 2}));
  history_.add(part(100.42, 0.62, {5, 4, 3}));
  EXPECT_EQ(at(100.2), Match::kBetween);
  expectJoints(0.4);
  EXPECT_EQ(at(100.41), Match::kNear);  // of a to c nothing is known after it
}

TEST_F(JointHistoryTest, AJointOfItsOwnPublisherMayBeSlow) {
  for (int k = 0; k <= 10; ++k) history_.add(part(100 + 0.1 * k, 0.1 * k, {0, 1, 2, 3, 4}));
  history_.add(part(100, 0, {5}));
  EXPECT_EQ(at(100.9, 0.3), Match::kNone);  // the last of f is too old
  history_.add(part(101, 1, {5}));
  EXPECT_EQ(at(100.5, 0.6), Match::kBetween);
  expectJoints(0.5);
  ASSERT_TRUE(knowsLatest());
  EXPECT_EQ(stamp_, nanosecondsOf(101));
}

}  // namespace
}  // namespace monocular_eye_hand
