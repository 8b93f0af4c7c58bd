#include "grasp/clearance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "grasp_world.h"

namespace monocular_eye_hand {
namespace {

using namespace grasp_world;

TEST(Clearance, AgreesWithMonteCarlo) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  const auto vector = [&] {
    Vector6d v;
    for (int k = 0; k < 6; ++k) v[k] = normal(generator);
    return v;
  };
  const auto pose = [&](double size) {
    const Eigen::Vector4d q = vector().head<4>().normalized();
    return Rigid3{Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix(), size * vector().head<3>()};
  };

  const GripperOptions gripper;
  GraspPlanOptions options;
  options.min_clearance = 0;
  for (int pass = 0; pass < 5; ++pass) {
    const Rigid3 object = pose(0.5), tcp = object * pose(0.05);
    Matrix6d root;
    for (int k = 0; k < 6; ++k) root.col(k) = vector() / std::sqrt(6.0);
    root.topRows<3>() *= 1e-3;
    root.bottomRows<3>() *= 1e-2;
    const ClearanceNeed need = clearanceNeed(object, root * root.transpose(), tcp, 0.04, gripper, options);

    // A point of the part at each pad corner, where it goes in the hand's y; and the hand's origin in x and
    // z.
    double corners[4] = {}, across = 0, along = 0;
    const int count = 20000;
    for (int i = 0; i < count; ++i) {
      const Rigid3 tcp_from_moved =
          tcp.inverse() * perturbed(object, root * vector()) * object.inverse() * tcp;
      for (int k = 0; k < 4; ++k) {
        const Eigen::Vector3d corner((k & 1 ? 0.5 : -0.5) * gripper.pad_width, 0,
                                     (k & 2 ? 0.5 : -0.5) * gripper.pad_length);
        corners[k] += std::pow((tcp_from_moved * corner).y(), 2) / count;
      }
      across += std::pow(tcp_from_moved.translation.x(), 2) / count;
      along += std::pow(tcp_from_moved.translation.z(), 2) / count;
    }

    EXPECT_NEAR(need.closing, 3 * std::sqrt(*std::max_element(corners, corners + 4)), 0.03 * need.closing);
    EXPECT_NEAR(need.across, 3 * std::sqrt(across), 0.03 * need.across);
    EXPECT_NEAR(need.along, 3 * std::sqrt(along), 0.03 * need.along);
  }
}

TEST(Clearance, TheWorstShortfallIsNamed) {
  const GripperOptions gripper;
  const GraspPlanOptions options;
  EXPECT_EQ(clearanceNeed({}, sigma(1e-3, 0), {}, 0.04, gripper, options).refusal, "");
  const ClearanceNeed wide = clearanceNeed({}, sigma(5e-3, 0), {}, 0.085, gripper, options);
  EXPECT_EQ(
      wide.refusal,
      "3 sigma of the pose need 16 mm on each side of the part, the gripper leaves 2.5 mm (opening 90 mm, "
      "part 85 mm)");
  EXPECT_NEAR(wide.shortfall, 0.0135, 1e-9);
}

}  // namespace
}  // namespace monocular_eye_hand
