#include "monocular_eye_hand/eye_hand/chain.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "monocular_eye_hand/geometry/covariance.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {
namespace {

Matrix6d diagonal(double position_sigma, double rotation_sigma) {
  Vector6d variance;
  variance << Eigen::Vector3d::Constant(position_sigma * position_sigma),
      Eigen::Vector3d::Constant(rotation_sigma * rotation_sigma);
  return variance.asDiagonal();
}

}  // namespace

void ArmErrorOptions::check() const {
  requireNotNegative("position_sigma", position_sigma);
  for (size_t k = 0; k < joint_sigma.size(); ++k)
    requireNotNegative(fmt::format("joint_sigma[{}]", k), joint_sigma[k]);
}

void HandEyeErrorOptions::check() const {
  requireNotNegative("position_sigma", position_sigma);
  requireNotNegative("rotation_sigma", rotation_sigma);
}

void requirePose(const Rigid3& pose, const char* what) {
  if (!pose.isFinite()) throw BadInput(std::string(what) + " is not finite");
  const Eigen::Matrix3d off = pose.rotation * pose.rotation.transpose() - Eigen::Matrix3d::Identity();
  if (off.cwiseAbs().maxCoeff() > 1e-6 || pose.rotation.determinant() < 0)
    throw BadInput(std::string(what) + ": its 3x3 matrix is no rotation");
}

HandEye handEye(const Rigid3& tool0_from_camera, const HandEyeErrorOptions& options) {
  options.check();
  requirePose(tool0_from_camera, "tool0_from_camera");
  return {tool0_from_camera, diagonal(options.position_sigma, options.rotation_sigma)};
}

HandPose handPose(const Puma560& arm, const JointVector& joints) {
  if (!joints.allFinite()) throw BadInput("the joint angles are not finite; wait for a joint state");
  return {arm.baseFromTool0(joints), arm.jacobian(joints)};
}

Matrix6d armCovariance(const HandPose& hand, const ArmErrorOptions& options) {
  const Vector6d sigma = Eigen::Map<const Vector6d>(options.joint_sigma.data());
  const Matrix6d scaled = hand.jacobian * sigma.asDiagonal();
  return diagonal(options.position_sigma, 0) + scaled * scaled.transpose();
}

Chain chain(const Rigid3& base_from_tool0, const Rigid3& tool0_from_camera,
            const Rigid3& camera_from_object) {
  const Rigid3 base_from_camera = base_from_tool0 * tool0_from_camera;
  Chain result;
  result.base_from_object = base_from_camera * camera_from_object;
  const Eigen::Vector3d& object = result.base_from_object.translation;
  result.image = adjointOfRotation(base_from_camera.rotation);
  result.hand_eye = adjointOfTranslation(object - base_from_camera.translation) *
                    adjointOfRotation(base_from_tool0.rotation);
  result.arm = adjointOfTranslation(object - base_from_tool0.translation);
  return result;
}

PoseInBase poseInBase(const HandPose& hand, const HandEye& hand_eye, const Rigid3& camera_from_object,
                      const Matrix6d& covariance, const ArmErrorOptions& arm) {
  arm.check();
  requirePose(hand.base_from_tool0, "base_from_tool0");
  requirePose(hand_eye.tool0_from_camera, "tool0_from_camera");
  requirePose(camera_from_object, "camera_from_object");
  requireCovariance(covariance, "covariance of camera_from_object");
  requireCovariance(hand_eye.covariance, "covariance of tool0_from_camera");
  const Chain c = chain(hand.base_from_tool0, hand_eye.tool0_from_camera, camera_from_object);
  return {c.base_from_object, propagate(c.image, covariance), propagate(c.hand_eye, hand_eye.covariance),
          propagate(c.arm, armCovariance(hand, arm))};
}

}  // namespace monocular_eye_hand
