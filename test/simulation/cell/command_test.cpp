#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/simulation/cell/command.h"

namespace monocular_eye_hand {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kNow = 100;

JointCommand::Point point(double time, const std::vector<double>& positions) {
  JointCommand::Point out;
  out.time = time;
  out.positions = positions;
  return out;
}

JointCommand good() {
  JointCommand out;
  out.joint_names = {"joint3", "joint1", "joint2", "joint6", "joint5", "joint4"};
  out.points = {point(1, {0.3, 0.1, 0.2, 0.6, 0.5, 0.4}), point(2, {3, 1, 2, 6, 5, 4})};
  return out;
}

std::string refusal(const JointCommand& trajectory) {
  try {
    armCommand(trajectory, kNow);
  } catch (const BadInput& e) {
    return e.what();
  }
  return "accepted";
}

TEST(CellCommand, TakesJointsInAnyOrder) {
  JointCommand trajectory = good();
  trajectory.points[1].velocities = {30, 10, 20, 60, 50, 40};
  trajectory.points[1].accelerations = {-3, -1, -2, -6, -5, -4};
  const ArmCommand command = armCommand(trajectory, kNow);
  EXPECT_EQ(command.start, kNow);
  ASSERT_EQ(command.path.size(), 2u);
  EXPECT_EQ(command.path[0].time, 1);
  for (int j = 0; j < 6; ++j)
    EXPECT_EQ(command.path[0].positions[j], (std::array<double, 6>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6}[size_t(j)]))
        << j;
  EXPECT_THAT(command.path[0].velocities, IsEmpty());
  EXPECT_THAT(command.path[1].velocities, ElementsAre(10, 20, 30, 40, 50, 60));
  EXPECT_THAT(command.path[1].accelerations, ElementsAre(-1, -2, -3, -4, -5, -6));
}

TEST(CellCommand, NoPointsStop) {
  EXPECT_THAT(armCommand({}, kNow).path, IsEmpty());
  JointCommand late;
  late.stamp = kNow - 5;
  EXPECT_EQ(armCommand(late, kNow).start, kNow);
}

TEST(CellCommand, WaitsForAStampInTheFuture) {
  JointCommand trajectory = good();
  trajectory.stamp = kNow + 2.5;
  EXPECT_EQ(armCommand(trajectory, kNow).start, kNow + 2.5);
  EXPECT_EQ(armCommand(trajectory, kNow).path[0].time, 1);
  trajectory.stamp = 1.7e9;
  EXPECT_THAT(refusal(trajectory), HasSubstr("use_sim_time"));
}

TEST(CellCommand, LeavesOutWhatIsOver) {
  JointCommand trajectory = good();
  trajectory.stamp = kNow - 1.5;
  const ArmCommand command = armCommand(trajectory, kNow);
  EXPECT_EQ(command.start, kNow);
  ASSERT_EQ(command.path.size(), 1u);
  EXPECT_NEAR(command.path[0].time, 0.5, 1e-9);
  EXPECT_EQ(command.path[0].positions[5], 6);  // the second point
  trajectory.stamp = kNow - 2.5;
  EXPECT_THAT(refusal(trajectory), HasSubstr("ended 0.5"));
}

TEST(CellCommand, RefusesOtherJoints) {
  JointCommand trajectory = good();
  trajectory.joint_names.pop_back();
  EXPECT_THAT(refusal(trajectory), HasSubstr("lacks joint4 (given: joint3, joint1, joint2, joint6, joint5)"));
  trajectory = good();
  trajectory.joint_names[0] = "elbow";
  EXPECT_THAT(refusal(trajectory), HasSubstr("lacks joint3"));
  trajectory = good();
  trajectory.joint_names.push_back("joint1");
  EXPECT_THAT(refusal(trajectory), HasSubstr("holds 7 names"));
  trajectory.joint_names.clear();
  EXPECT_THAT(refusal(trajectory), HasSubstr("lacks joint1"));
}

TEST(CellCommand, RefusesBadPoints) {
  const auto changed = [](auto change) {
    JointCommand trajectory = good();
    change(&trajectory.points[1]);
    return refusal(trajectory);
  };
  using Point = JointCommand::Point;
  EXPECT_THAT(changed([](Point* p) { p->positions.pop_back(); }),
              HasSubstr("points[1].positions holds 5 numbers"));
  EXPECT_THAT(changed([](Point* p) { p->positions[2] = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("points[1].positions is not finite"));
  EXPECT_THAT(changed([](Point* p) { p->velocities = {1}; }), HasSubstr("points[1].velocities holds 1"));
  EXPECT_THAT(changed([](Point* p) { p->accelerations = {1}; }), HasSubstr("points[1].accelerations"));
  EXPECT_THAT(changed([](Point* p) { p->time = 1; }), HasSubstr("must grow"));
  EXPECT_THAT(changed([](Point* p) { p->time = -1; }), HasSubstr("points[1]"));
  EXPECT_EQ(changed([](Point*) {}), "accepted");
}

}  // namespace
}  // namespace monocular_eye_hand
