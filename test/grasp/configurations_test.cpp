#include "grasp/configurations.h"

#include <gtest/gtest.h>

namespace monocular_eye_hand {
namespace {

/// Of a grasp at this place whose approach is tilted about x [rad], with a lift as long [m].
GraspConfigurations configurationsAt(double x, double y, double tilt, double lift) {
  Rigid3 grasp;
  grasp.rotation = Eigen::AngleAxisd(M_PI + tilt, Eigen::Vector3d::UnitX()).toRotationMatrix();
  grasp.translation = {x, y, 0.1};
  Rigid3 pregrasp = grasp, lifted = grasp;
  pregrasp.translation -= 0.08 * grasp.rotation.col(2);
  lifted.translation.z() += lift;
  return findConfigurations(Puma560(), pregrasp, grasp, lifted, JointVector::Zero(), {});
}

TEST(GraspConfigurations, SayWhichPoseIsOutOfReach) {
  EXPECT_EQ(configurationsAt(3, 0, 0, 0.1).reason, "the grasp is out of the arm's reach or limits");
  EXPECT_EQ(configurationsAt(0.45, -0.1, 0, 2).reason,
            "the end of the lift is out of the arm's reach or limits");
}

TEST(GraspConfigurations, OfAHighLiftInAnotherConfigurationAreNone) {
  const GraspConfigurations found = configurationsAt(0.55, -0.1, -0.75, 1);
  EXPECT_TRUE(found.configurations.empty());
  EXPECT_EQ(found.refusal, GraspRefusal::kUnreachable);
  EXPECT_EQ(found.reason, "no configuration reaches pre-grasp, grasp and lift alike");
}

}  // namespace
}  // namespace monocular_eye_hand
