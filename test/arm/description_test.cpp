// urdf/puma560.urdf against the kinematics, and what a wrong URDF is told.
#include <gmock/gmock.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "monocular_eye_hand/arm/load_arm_description.h"
#include "monocular_eye_hand/geometry/error.h"
#include "random_arm.h"
#include "support/refusal.h"
#include "urdf_world.h"

namespace monocular_eye_hand {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

TEST(ArmDescription, ChainIsTheKinematics) {
  const Puma560 arm;
  Random random(1);
  const int tool0 = description().link("tool0");
  std::vector<Rigid3> poses;
  for (int k = 0; k < 1000; ++k) {
    const JointVector q = randomJoints(random, arm.options());
    description().baseFromLinks(q, 0.03, &poses);
    const Rigid3 expected = arm.baseFromTool0(q);
    EXPECT_LT((poses[size_t(tool0)].translation - expected.translation).norm(), 1e-12);
    EXPECT_LT(rotationError(poses[size_t(tool0)].rotation, expected.rotation), 1e-12);
    // The frame of link i lies in DH frame i - 1 and turns about its z.
    const auto links = arm.baseFromLinks(q);
    for (int i = 1; i <= 6; ++i) {
      const Rigid3& link = poses[size_t(description().link("link" + std::to_string(i)))];
      EXPECT_LT((link.translation - links[size_t(i) - 1].translation).norm(), 1e-12);
      EXPECT_LT((link.rotation.col(2) - links[size_t(i) - 1].rotation.col(2)).norm(), 1e-12);
    }
  }

  EXPECT_NO_THROW(requireSameArm(description(), arm));
}

TEST(ArmDescription, OtherLengthsAreNoticed) {
  for (int i = 0; i < 6; ++i) {
    Puma560Options options;
    double* const lengths[] = {
        &options.shoulder_height, &options.a2, &options.a3, &options.d3, &options.d4, &options.d6};
    *lengths[i] += 1e-4;
    EXPECT_THROW(requireSameArm(description(), Puma560(options)), BadInput) << i;
  }
}

TEST(ArmDescription, LimitsAreTheOptionsDefaults) {
  const Puma560Options options;
  const std::string urdf = urdfText();
  for (int i = 0; i < 6; ++i) {
    const JointLimit& limit = options.joints[size_t(i)];
    const size_t joint = urdf.find("<joint name=\"joint" + std::to_string(i + 1) + "\"");
    ASSERT_NE(joint, std::string::npos);
    const size_t at = urdf.find("<limit", joint);
    double lower = 0, upper = 0, velocity = 0;
    ASSERT_EQ(
        std::sscanf(urdf.c_str() + at, "<limit lower=\"%lf\" upper=\"%lf\" effort=\"%*f\" velocity=\"%lf\"",
                    &lower, &upper, &velocity),
        3);
    EXPECT_NEAR(lower, limit.lower, 1e-15);
    EXPECT_NEAR(upper, limit.upper, 1e-15);
    EXPECT_EQ(velocity, limit.velocity);
  }
}

TEST(ArmDescription, FixedFrames) {
  const ArmDescription& arm = description();
  EXPECT_LT((arm.tool0_from_tcp.translation - Vector3d(0, 0, 0.16)).norm(), 1e-15);
  EXPECT_LT(rotationError(arm.tool0_from_tcp.rotation, Eigen::Matrix3d::Identity()), 1e-15);
  const Rigid3& camera = arm.tool0_from_camera;
  EXPECT_LT((camera.translation - Vector3d(-0.078, 0, 0.067)).norm(), 1e-12);
  const double tilt = 10 * M_PI / 180;  // inwards, about the camera's x
  EXPECT_LT((camera.rotation.col(2) - Vector3d(std::sin(tilt), 0, std::cos(tilt))).norm(), 1e-12);
  EXPECT_LT((camera.rotation.col(0) - Vector3d(0, -1, 0)).norm(), 1e-12);
  // REP 199: x of flange is z of tool0.
  const auto poses = arm.baseFromLinks(JointVector::Zero(), 0);
  const Rigid3& flange = poses[size_t(arm.link("flange"))];
  const Rigid3& tool0 = poses[size_t(arm.link("tool0"))];
  EXPECT_LT((flange.translation - tool0.translation).norm(), 1e-15);
  EXPECT_LT((flange.rotation.col(0) - tool0.rotation.col(2)).norm(), 1e-12);
}

TEST(ArmDescription, GripperOpensBetweenThePads) {
  const ArmDescription& arm = description();
  EXPECT_NEAR(arm.gripper_width_max, 0.09, 1e-12);
  for (double width : {0.0, 0.03, arm.gripper_width_max}) {
    JointVector q;
    q << 0.3, 0.2, -1, 0.4, 0.5, -0.6;
    const auto poses = arm.baseFromLinks(q, width);
    const Rigid3 tcp_from_base = poses[size_t(arm.link("gripper_tcp"))].inverse();
    double left = 1, right = -1, tip = 0;  // nearest of each finger to the middle, farthest along z
    for (const char* name : {"finger_left", "finger_right"}) {
      const ArmLink& link = arm.links[size_t(arm.link(name))];
      const Rigid3 tcp_from_link = tcp_from_base * poses[size_t(arm.link(name))];
      for (const ArmShape& shape : link.collision) {
        const Mesh box = meshOf(shape);
        for (const Vector3d& v : box.vertices) {
          const Vector3d p = tcp_from_link * shape.link_from_shape * v;
          if (std::string(name) == "finger_left") left = std::min(left, p.y());
          if (std::string(name) == "finger_right") right = std::max(right, p.y());
          tip = std::max(tip, p.z());
        }
      }
    }
    EXPECT_NEAR(left, width / 2, 1e-9);
    EXPECT_NEAR(right, -width / 2, 1e-9);
    EXPECT_NEAR(tip, 0.009, 1e-9);  // the fingers reach a little beyond the TCP
  }
}

/// The URDF as it can be read from anywhere.
std::string besideMeshes() {
  return replaced(urdfText(), "package://monocular_eye_hand", "file://" MONOCULAR_EYE_HAND_SOURCE_DIR);
}

/// What loading says when `from` is replaced by `to` in the URDF.
std::string refusalOf(const std::string& from, const std::string& to) {
  std::string text = besideMeshes();
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const TemporaryUrdf file(text);
  const std::string message = refusal([&] { loadArmDescription(file.path()); });
  if (message != kAccepted) {
    EXPECT_THAT(message, HasSubstr(file.path()));
  }
  return message;
}

TEST(ArmDescription, UnchangedCopyLoads) { EXPECT_EQ(refusalOf("puma560", "puma560"), kAccepted); }

TEST(ArmDescription, WrongFilesAreRefusedByName) {
  EXPECT_THROW(description().link("link7"), BadInput);
  EXPECT_THAT(refusal([&] { loadArmDescription("/nowhere/arm.urdf"); }),
              HasSubstr("/nowhere/arm.urdf: cannot be read"));

  const TemporaryUrdf alone(
      replaced(urdfText(), "package://monocular_eye_hand", "package://no_such_package"));
  EXPECT_THAT(refusal([&] { loadArmDescription(alone.path()); }),
              HasSubstr("base_link.stl is neither in the folder of the URDF nor in one above it"));

  EXPECT_THAT(refusalOf("</robot>", ""), HasSubstr("is no URDF"));
  EXPECT_THAT(refusalOf("<parent link=\"link2\"/>", "<parent link=\"link22\"/>"), HasSubstr("link22"));
  EXPECT_THAT(refusalOf("<link name=\"gripper_tcp\">", "<link name=\"grip\">"), HasSubstr("gripper_tcp"));
  EXPECT_THAT(refusalOf("meshes/link3.stl", "meshes/link33.stl"), HasSubstr("link33.stl"));
  EXPECT_THAT(refusalOf("joint4\" type=\"revolute\"", "joint4\" type=\"prismatic\""),
              HasSubstr("joint4 is prismatic, it must be revolute"));
  EXPECT_THAT(refusalOf("joint name=\"joint5\"", "joint name=\"wrist\""),
              HasSubstr("wrist is revolute; only joint1"));
  EXPECT_THAT(refusalOf("joint name=\"camera_joint\" type=\"fixed\"",
                        "joint name=\"camera_joint\" type=\"floating\""),
              HasSubstr("camera_joint is floating"));
  EXPECT_THAT(refusalOf("<mimic joint=\"finger_left_joint\" multiplier=\"1\" offset=\"0\"/>", ""),
              HasSubstr("must mimic the other"));
  EXPECT_THAT(refusalOf("<axis xyz=\"0 -1 0\"/>", "<axis xyz=\"0 0 1\"/>"), HasSubstr("opposite directions"));
  EXPECT_THAT(refusalOf("<parent link=\"tool0\"/>", "<parent link=\"link5\"/>"),
              HasSubstr("not fixed to tool0"));
  EXPECT_THAT(refusalOf("<box size=\"0.1 0.14 0.143\"/>", "<sphere radius=\"0.1\"/>"),
              HasSubstr("base_link: a sphere"));
}

TEST(ArmDescription, JointsOutOfOrderAreRefused) {
  std::string text = besideMeshes();
  for (const auto& [from, to] :
       {std::pair{"\"joint4\"", "\"jointX\""}, {"\"joint5\"", "\"joint4\""}, {"\"jointX\"", "\"joint5\""}})
    text.replace(text.find(from), 8, to);
  const TemporaryUrdf file(text);
  EXPECT_THAT(refusal([&] { loadArmDescription(file.path()); }),
              HasSubstr("joint4 stands where joint5 must be"));
}

}  // namespace
}  // namespace monocular_eye_hand
