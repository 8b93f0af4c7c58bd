#include "monocular_eye_hand/eye_hand/chain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monocular_eye_hand/geometry/covariance.h"
#include "monocular_eye_hand/options/options.h"
#include "support/pose_matchers.h"
#include "support/random.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

Vector6d randomVector6(Random& random) {
  Vector6d v;
  for (int k = 0; k < 6; ++k) v[k] = normal(random);
  return v;
}

Rigid3 randomPose(Random& random, double size) {
  const Eigen::Matrix3d rotation = randomRotation(random);
  return {rotation, size * randomVector(random)};
}

/// A covariance with about these sigmas and correlations between all of its components.
Matrix6d randomCovariance(Random& random, double metres, double radians) {
  Matrix6d root;
  for (int k = 0; k < 6; ++k) root.col(k) = randomVector6(random) / std::sqrt(6.0);
  root.topRows<3>() *= metres;
  root.bottomRows<3>() *= radians;
  return root * root.transpose();
}

JointVector bentJoints() { return (JointVector() << 0.3, 0.6, -1.9, 0.4, -0.8, 0.2).finished(); }

TEST(Chain, DerivativesAgreeWithDifferences) {
  Random random(1);
  for (int pass = 0; pass < 20; ++pass) {
    const Rigid3 arm = randomPose(random, 0.5), hand_eye = randomPose(random, 0.1),
                 object = randomPose(random, 0.4);
    const Chain c = chain(arm, hand_eye, object);
    const double step = 1e-6;
    for (int k = 0; k < 6; ++k) {
      const Vector6d d = step * Vector6d::Unit(k);
      const auto slope = [&](const Rigid3& plus, const Rigid3& minus) -> Vector6d {
        return difference(minus, plus) / (2 * step);
      };
      const Vector6d by_arm =
          slope(perturbed(arm, d) * hand_eye * object, perturbed(arm, -d) * hand_eye * object);
      const Vector6d by_eye =
          slope(arm * perturbed(hand_eye, d) * object, arm * perturbed(hand_eye, -d) * object);
      const Vector6d by_image =
          slope(arm * hand_eye * perturbed(object, d), arm * hand_eye * perturbed(object, -d));
      EXPECT_LT((by_arm - c.arm.col(k)).norm(), 1e-8);
      EXPECT_LT((by_eye - c.hand_eye.col(k)).norm(), 1e-8);
      EXPECT_LT((by_image - c.image.col(k)).norm(), 1e-8);
    }
    EXPECT_THAT(arm * hand_eye * object, PoseNear(c.base_from_object, 1e-11, 6e-13));
  }
}

TEST(Chain, ArmMotionAgreesWithTheJoints) {
  const Puma560 arm;
  const JointVector joints = bentJoints();
  const HandPose hand = handPose(arm, joints);
  Random random(2);
  const Rigid3 hand_eye = randomPose(random, 0.1), object = randomPose(random, 0.4);
  const Chain c = chain(hand.base_from_tool0, hand_eye, object);
  for (int k = 0; k < 6; ++k) {
    const JointVector d = 1e-6 * JointVector::Unit(k);
    const Vector6d slope = difference(arm.baseFromTool0(joints - d) * hand_eye * object,
                                      arm.baseFromTool0(joints + d) * hand_eye * object) /
                           2e-6;
    EXPECT_LT((slope - c.arm * hand.jacobian.col(k)).norm(), 1e-8);
  }
}

TEST(Chain, CovarianceAgreesWithMonteCarlo) {
  Random random(3);
  const Puma560 arm;
  const JointVector joints = bentJoints();
  HandEye hand_eye = handEye(randomPose(random, 0.1));
  hand_eye.covariance = randomCovariance(random, 1e-3, 2e-3);
  const Rigid3 object = randomPose(random, 0.4);
  const Matrix6d image = randomCovariance(random, 2e-3, 5e-3);
  ArmErrorOptions errors;
  errors.position_sigma = 5e-4;
  errors.joint_sigma = {1e-3, 2e-3, 5e-4, 1e-3, 3e-3, 2e-3};
  const PoseInBase pose = poseInBase(handPose(arm, joints), hand_eye, object, image, errors);

  const Eigen::LLT<Matrix6d> eye_root(hand_eye.covariance), image_root(image);
  Matrix6d sampled = Matrix6d::Zero();
  const int count = 40000;
  for (int i = 0; i < count; ++i) {
    JointVector q = joints;
    for (int k = 0; k < 6; ++k) q[k] += errors.joint_sigma[size_t(k)] * normal(random);
    Rigid3 tool0 = arm.baseFromTool0(q);
    tool0.translation += errors.position_sigma * randomVector6(random).head<3>();
    const Rigid3 actual = tool0 *
                          perturbed(hand_eye.tool0_from_camera, eye_root.matrixL() * randomVector6(random)) *
                          perturbed(object, image_root.matrixL() * randomVector6(random));
    const Vector6d d = difference(pose.base_from_object, actual);
    sampled += d * d.transpose() / count;
  }
  const Vector6d scale = pose.covariance().diagonal().cwiseSqrt().cwiseInverse();
  const Matrix6d gap = scale.asDiagonal() * (sampled - pose.covariance()) * scale.asDiagonal();
  EXPECT_LT(gap.cwiseAbs().maxCoeff(), 0.04);  // 4 sigma of the sampling plus second order
  for (const Matrix6d* share : {&pose.image, &pose.hand_eye, &pose.arm})
    EXPECT_GT(share->diagonal().minCoeff(), 0);
}

TEST(Chain, UnknownJointsLeaveTheRepeatability) {
  HandPose hand;
  const PoseInBase pose = poseInBase(hand, handEye({}), {}, Matrix6d::Zero());
  EXPECT_NEAR(pose.arm(0, 0), 1e-8, 1e-20);
  EXPECT_EQ(pose.arm(5, 5), 0);
  EXPECT_NEAR(std::sqrt(pose.hand_eye(0, 0)), 5e-4, 1e-12);
  EXPECT_NEAR(std::sqrt(pose.hand_eye(5, 5)) * 180 / M_PI, 0.05, 1e-4);
}

TEST(Chain, BadInputIsNamed) {
  Rigid3 sheared;
  sheared.rotation(0, 1) = 0.1;
  Rigid3 lost;
  lost.translation.x() = NAN;
  Matrix6d negative = Matrix6d::Identity();
  negative(3, 3) = -1;
  Matrix6d lopsided = Matrix6d::Identity();
  lopsided(0, 1) = 0.5;
  const HandPose hand;
  const HandEye eye = handEye({});
  EXPECT_THAT(refusal([&] { handEye(sheared); }),
              HasSubstr("tool0_from_camera: its 3x3 matrix is no rotation"));
  EXPECT_THAT(refusal([&] { poseInBase(hand, eye, lost, Matrix6d::Zero()); }),
              HasSubstr("camera_from_object is not finite"));
  EXPECT_THAT(refusal([&] { poseInBase(hand, eye, {}, negative); }), HasSubstr("negative variance"));
  EXPECT_THAT(refusal([&] { poseInBase(hand, eye, {}, lopsided); }), HasSubstr("not symmetric"));
  EXPECT_THAT(refusal([&] { handPose(Puma560(), JointVector::Constant(NAN)); }), HasSubstr("not finite"));

  HandEyeErrorOptions eye_options;
  eye_options.rotation_sigma = -1;
  EXPECT_THAT(refusal([&] { handEye({}, eye_options); }), HasSubstr("rotation_sigma = -1"));
  ArmErrorOptions arm;
  EXPECT_THAT(refusal([&] { readOptions(parseYaml("joint_sigma: [0, 0, 0, 0, 0, -2]"), &arm); }),
              HasSubstr("joint_sigma[5] = -2 must be 0 or more"));
  EXPECT_THAT(refusal([&] { readOptions(parseYaml("position: 1"), &arm); }), HasSubstr("position_sigma"));
}

}  // namespace
}  // namespace monocular_eye_hand
