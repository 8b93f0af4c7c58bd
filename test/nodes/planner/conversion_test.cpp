#include <gtest/gtest.h>

#include <cmath>

#include "monocular_eye_hand/arm/load_arm_description.h"
#include "monocular_eye_hand/geometry/error.h"
#include "nodes/common/conversion.h"
#include "nodes/planner/conversion.h"

namespace monocular_eye_hand {
namespace {

const ArmDescription& arm() {
  static const ArmDescription arm =
      loadArmDescription(std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/urdf/puma560.urdf");
  return arm;
}

template <class Call>
std::string refusal(Call call) {
  try {
    call();
  } catch (const BadInput& e) {
    return e.what();
  }
  return "";
}

geometry_msgs::Pose poseAt(double x) {
  geometry_msgs::Pose pose;
  pose.position.x = x;
  pose.orientation.w = 1;
  return pose;
}

TEST(PlannerConversion, TrajectoryStartsAtItsSecondPoint) {
  Trajectory trajectory;
  trajectory.points.resize(3);
  trajectory.points[1].time_s = 0.5;
  trajectory.points[1].position[4] = 0.25;
  trajectory.points[1].velocity[4] = 1;
  trajectory.points[2].time_s = 1;
  trajectory.points[2].position[4] = 0.5;
  const trajectory_msgs::JointTrajectory message = toMessage(trajectory);
  EXPECT_EQ(message.joint_names.size(), 6u);
  EXPECT_EQ(message.joint_names[4], "joint5");
  EXPECT_TRUE(message.header.stamp.isZero()) << "at once";
  ASSERT_EQ(message.points.size(), 2u);
  EXPECT_EQ(message.points[0].time_from_start.toSec(), 0.5);
  EXPECT_EQ(message.points[0].velocities[4], 1);
  EXPECT_TRUE(message.points[0].accelerations.empty()) << "else controllers would join by quintics";
  EXPECT_EQ(message.points[1].positions[4], 0.5);
}

TEST(PlannerConversion, BrokenPosesAreNamed) {
  geometry_msgs::Pose pose = poseAt(1);
  EXPECT_EQ(poseOf(pose, "it").translation.x(), 1);
  pose.position.y = NAN;
  EXPECT_NE(refusal([&] { poseOf(pose, "it"); }).find("it is not finite"), std::string::npos);
  pose = poseAt(1);
  pose.orientation.w = 0;
  EXPECT_NE(refusal([&] { poseOf(pose, "it"); }).find("length 0"), std::string::npos);
}

TEST(PlannerConversion, PickTarget) {
  GraspTarget message;
  message.pregrasp = poseAt(1);
  message.grasp = poseAt(2);
  message.retreat = poseAt(3);
  message.width = 0.04;
  message.opening = 0.06;
  const PickTarget target = pickTargetOf(message, "bridge 3", 0.09);
  EXPECT_EQ(target.object, "bridge 3");
  EXPECT_EQ(target.base_from_grasp.translation.x(), 2);
  EXPECT_EQ(target.base_from_lift.translation.x(), 3);
  EXPECT_EQ(target.opening, 0.06);
  EXPECT_EQ(target.part_width, 0.04);
  message.opening = 0.1;
  EXPECT_NE(refusal([&] { pickTargetOf(message, "x", 0.09); }).find("opening"), std::string::npos);
  message.opening = 0.03;
  EXPECT_NE(refusal([&] { pickTargetOf(message, "x", 0.09); }).find("must not be less"), std::string::npos);
  message.opening = 0.06;
  message.width = NAN;
  EXPECT_NE(refusal([&] { pickTargetOf(message, "x", 0.09); }).find("width"), std::string::npos);
  message.width = 0.04;
  message.retreat.position.z = INFINITY;
  EXPECT_NE(refusal([&] { pickTargetOf(message, "x", 0.09); }).find("target.retreat"), std::string::npos);
}

TEST(PlannerConversion, LinksOfAMove) {
  JointVector joints;
  joints << 0.1, 1.2, -1.4, 0.3, 0.5, -0.2;
  const Rigid3 base_from_tool0 = Puma560().baseFromTool0(joints);
  const Rigid3 base_from_tcp = base_from_tool0 * arm().tool0_from_tcp;
  MoveGoal goal;
  const auto tcpOf = [&](const char* link, const Rigid3& base_from_link) {
    goal.link = link;
    goal.poses = {toPose(base_from_link)};
    return tcpPosesOf(goal, arm()).at(0);
  };
  for (const Rigid3& tcp : {tcpOf("tool0", base_from_tool0), tcpOf("gripper_tcp", base_from_tcp),
                            tcpOf("camera_optical_frame", base_from_tool0 * arm().tool0_from_camera)}) {
    EXPECT_LT((tcp.translation - base_from_tcp.translation).norm(), 1e-12);
    EXPECT_LT(angleBetween(tcp.rotation, base_from_tcp.rotation), 1e-7);
  }
  goal.link = "elbow";
  EXPECT_NE(refusal([&] { tcpPosesOf(goal, arm()); }).find("'elbow'"), std::string::npos);
  goal.link = "tool0";
  goal.poses.clear();
  EXPECT_NE(refusal([&] { tcpPosesOf(goal, arm()); }).find("where to"), std::string::npos);
}

TEST(PlannerConversion, PickOrder) {
  const std::string source = MONOCULAR_EYE_HAND_SOURCE_DIR;
  ExecutorOptions options;
  options.objects = source + "/config/objects.yaml";
  const SceneMemory scene(arm(), options);
  PickGoal goal;
  goal.place = 3;
  goal.target.header.frame_id = "/base_link";
  goal.target.name = "bridge";
  goal.target.instance = 4;
  goal.target.object.pose = poseAt(0.5);
  goal.target.pregrasp = poseAt(1);
  goal.target.grasp = poseAt(2);
  goal.target.retreat = poseAt(3);
  goal.target.width = 0.04;
  goal.target.opening = 0.06;
  const auto order = [&] { return pickOrderOf(goal, "base_link", scene, 0.09); };
  EXPECT_EQ(order().object.label(), "bridge 4");
  EXPECT_EQ(order().object.base_from_object.translation.x(), 0.5);
  EXPECT_EQ(order().target.object, "bridge 4");
  EXPECT_EQ(order().target.base_from_grasp.translation.x(), 2);
  EXPECT_EQ(order().place, 3);

  goal.target.object.pose.position.x = NAN;
  EXPECT_NE(refusal(order).find("target.object"), std::string::npos);
  goal.target.name = "teapot";
  EXPECT_NE(refusal(order).find("no object is named 'teapot'; known: "), std::string::npos);
  goal.target.header.frame_id = "map";
  EXPECT_EQ(refusal(order), "target.header.frame_id is 'map' and must be 'base_link', the arm's base");
}

TEST(PlannerConversion, MoveOrder) {
  MoveGoal goal;
  goal.link = "gripper_tcp";
  goal.open_gripper = true;
  goal.poses = {poseAt(0.5), poseAt(0.6)};
  MoveOrder order = moveOrderOf(goal, arm());
  EXPECT_TRUE(order.open_gripper);
  EXPECT_TRUE(order.joints.empty());
  ASSERT_EQ(order.base_from_tcp.size(), 2u);
  EXPECT_EQ(order.base_from_tcp[1].translation.x(), 0.6);

  goal.joints = {1, 2, 3, 4, 5, 6};
  order = moveOrderOf(goal, arm());
  EXPECT_TRUE(order.base_from_tcp.empty()) << "joints count instead of poses";
  ASSERT_EQ(order.joints.size(), 1u);
  EXPECT_EQ(order.joints[0][5], 6);

  const auto convert = [&] { moveOrderOf(goal, arm()); };
  goal.joints[2] = NAN;
  EXPECT_EQ(refusal(convert), "joints is not finite");
  goal.joints.resize(5);
  EXPECT_EQ(refusal(convert), "joints holds 5 angles: give six, or none");
}

TEST(PlannerConversion, PathMarker) {
  const ToolArm tool{Puma560(), arm().tool0_from_tcp};
  Trajectory trajectory;
  trajectory.points.resize(2);
  trajectory.points[1].time_s = 1;
  trajectory.points[1].position[0] = 1;
  ros::Time::init();
  const visualization_msgs::Marker marker = pathMarker("base_link", tool, {trajectory});
  EXPECT_EQ(marker.header.frame_id, "base_link");
  ASSERT_GE(marker.points.size(), 50u);
  const Eigen::Vector3d end = tool.baseFromTcp(trajectory.points[1].position).translation;
  EXPECT_NEAR(marker.points.back().x, end.x(), 1e-9);
  EXPECT_NEAR(marker.points.back().y, end.y(), 1e-9);
}

}  // namespace
}  // namespace monocular_eye_hand
