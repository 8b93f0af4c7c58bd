#include "monocular_eye_hand/grasp/gripper.h"

#include <gtest/gtest.h>

#include "grasp/boxes.h"
#include "monocular_eye_hand/arm/load_arm_description.h"

namespace monocular_eye_hand {
namespace {

// Points that span a shape: a box's corners, a cylinder's rims.
std::vector<Eigen::Vector3d> pointsOf(const ArmShape& shape) {
  std::vector<Eigen::Vector3d> points;
  if (shape.kind == ArmShape::Kind::kBox) {
    for (int k = 0; k < 8; ++k)
      points.push_back(shape.size.cwiseProduct(
          Eigen::Vector3d(k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, k & 4 ? 0.5 : -0.5)));
  } else if (shape.kind == ArmShape::Kind::kCylinder) {
    for (int k = 0; k < 32; ++k)
      for (const double z : {-0.5, 0.5})
        points.emplace_back(shape.size.x() * std::cos(M_PI * k / 16),
                            shape.size.x() * std::sin(M_PI * k / 16), z * shape.size.z());
  } else {
    points = shape.mesh->vertices;
  }
  for (Eigen::Vector3d& p : points) p = shape.link_from_shape * p;
  return points;
}

TEST(Gripper, ItsBoxesEncloseTheUrdf) {
  const ArmDescription arm =
      loadArmDescription(std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/urdf/puma560.urdf");
  const GripperOptions gripper;
  EXPECT_EQ(gripper.opening_max, arm.gripper_width_max);
  for (const double opening : {0.0, 0.03, 0.09}) {
    const std::vector<Rigid3> base_from_links = arm.baseFromLinks(JointVector::Zero(), opening);
    const Rigid3 tcp_from_base = base_from_links[size_t(arm.link("gripper_tcp"))].inverse();
    Boxes boxes = handBoxes(gripper, opening);
    for (Eigen::AlignedBox3d& b : boxes)
      b = Eigen::AlignedBox3d(b.min().array() - 1e-6, b.max().array() + 1e-6);
    int checked = 0;
    for (const char* name : {"gripper_base", "finger_left", "finger_right", "camera_link"}) {
      const size_t link = size_t(arm.link(name));
      for (const ArmShape& shape : arm.links[link].collision) {
        for (const Eigen::Vector3d& p : pointsOf(shape)) {
          const Eigen::Vector3d p_in_tcp = tcp_from_base * (base_from_links[link] * p);
          const bool held = std::any_of(boxes.begin(), boxes.end(),
                                        [&](const Eigen::AlignedBox3d& b) { return b.contains(p_in_tcp); });
          EXPECT_TRUE(held) << name << ' ' << 1e3 * p_in_tcp.transpose() << " mm, opening " << opening;
          ++checked;
        }
      }
    }
    EXPECT_GT(checked, 100);
  }
}

TEST(Gripper, ThePadsFaceEachOtherAtTheOpening) {
  const ArmDescription arm =
      loadArmDescription(std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/urdf/puma560.urdf");
  const GripperOptions gripper;
  const std::vector<Rigid3> links = arm.baseFromLinks(JointVector::Zero(), 0.04);
  const Rigid3 tcp_from_base = links[size_t(arm.link("gripper_tcp"))].inverse();
  for (const auto& [name, side] : {std::pair("finger_left", 1.0), std::pair("finger_right", -1.0)}) {
    const size_t link = size_t(arm.link(name));
    double inner = 1, tip = -1;
    for (const ArmShape& shape : arm.links[link].collision)
      for (const Eigen::Vector3d& p : pointsOf(shape)) {
        const Eigen::Vector3d p_in_tcp = tcp_from_base * (links[link] * p);
        inner = std::min(inner, side * p_in_tcp.y());
        tip = std::max(tip, p_in_tcp.z());
      }
    EXPECT_NEAR(inner, 0.02, 1e-9);
    EXPECT_NEAR(tip, gripper.finger_tip, 1e-9);
  }
}

}  // namespace
}  // namespace monocular_eye_hand
