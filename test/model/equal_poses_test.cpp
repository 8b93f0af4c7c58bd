#include "monocular_eye_hand/model/equal_poses.h"

#include <gtest/gtest.h>

#include "../mesh/shapes.h"
#include "model/build_model.h"
#include "monocular_eye_hand/geometry/covariance.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/model/free_turns.h"
#include "support/pose_matchers.h"

namespace monocular_eye_hand {
namespace {

using namespace shapes;

TEST(EqualPoses, TheNearestOfAGroupIsTaken) {
  const ObjectModel bridge = buildModel("bridge", loadMesh(shippedModel("bridge"), "mm"));
  const Rigid3 pose = somewhere(3);
  ASSERT_GT(bridge.symmetries.discrete.size(), 1u);
  for (const Rigid3& s : bridge.symmetries.discrete) {
    const Rigid3 wanted = pose * s;
    EXPECT_THAT(wanted, PoseNear(nearestEqualPose(bridge, pose, wanted), 1e-06, 6e-08));
  }
}

TEST(EqualPoses, FreeAxisAndSphereTurnAllTheWay) {
  const ObjectModel pipe = buildModel("tube", moved(tube(48, 0.03, 0.02, 0.05), somewhere(4)));
  ASSERT_TRUE(pipe.symmetries.axis.has_value());
  const Rigid3 pose = somewhere(5), wanted = pose * rotationAbout(*pipe.symmetries.axis, 1.1);
  EXPECT_THAT(wanted, PoseNear(nearestEqualPose(pipe, pose, wanted), 0.0001, 6e-06));
  ObjectModel ball = buildModel("ball", moved(sphere(32, 0.02), somewhere(6)));
  ball.symmetries = {};
  ball.symmetries.sphere = true;
  EXPECT_LT(angleBetween(nearestEqualPose(ball, pose, somewhere(7)).rotation, somewhere(7).rotation), 1e-7);
  EXPECT_LT((nearestEqualPose(ball, pose, somewhere(7)) * ball.centre() - pose * ball.centre()).norm(),
            1e-12);
}

TEST(FreeTurns, HeldAndFreedAreInverse) {
  ObjectModel model = buildModel("tube", moved(tube(48, 0.03, 0.02, 0.05), somewhere(4)));
  const Rigid3 pose = somewhere(8);
  Matrix6d root = Matrix6d::Identity();
  for (int k = 0; k < 36; ++k) root(k / 6, k % 6) += 0.3 * std::sin(7.0 * k);
  Matrix6d covariance = 1e-6 * root * root.transpose();
  for (const bool ball : {false, true}) {
    if (ball) {
      model.symmetries = {};
      model.symmetries.sphere = true;
    }
    const Matrix6d held = conditionedOnFreeAxis(model, pose, covariance);
    // However large the variance of the free angle is: what is held does not know it.
    const Matrix6d again = conditionedOnFreeAxis(model, pose, withFreeAxisVariance(model, pose, held));
    EXPECT_LT((again - held).cwiseAbs().maxCoeff(), 1e-14);
    const Eigen::Vector3d axis = ball ? Eigen::Vector3d(0.6, 0, 0.8)
                                      : Eigen::Vector3d(pose.rotation * model.symmetries.axis->direction);
    EXPECT_NEAR(axis.dot(held.bottomRightCorner<3, 3>() * axis), 0, 1e-18);
    const Matrix6d freed = withFreeAxisVariance(model, pose, held);
    EXPECT_NEAR(axis.dot(freed.bottomRightCorner<3, 3>() * axis), M_PI * M_PI / 3, 1e-9);
  }
  model.symmetries = {};

  EXPECT_EQ(conditionedOnFreeAxis(model, pose, covariance), covariance);
  EXPECT_EQ(withFreeAxisVariance(model, pose, covariance), covariance);
}

}  // namespace
}  // namespace monocular_eye_hand
