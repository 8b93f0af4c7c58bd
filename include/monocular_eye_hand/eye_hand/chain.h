#pragma once
#include <array>

#include "monocular_eye_hand/arm/puma560.h"
#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// How well the arm knows where its hand is. Defaults stand here and nowhere else.
struct ArmErrorOptions {
  double position_sigma = 1e-4;  ///< of tool0, each axis: repeatability [m]
  /// Of each joint's zero [rad]; carried to tool0 through the Jacobian.
  std::array<double, 6> joint_sigma{{1e-4, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4}};

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("position_sigma", position_sigma);
    v("joint_sigma", joint_sigma);
  }
};

/// How well tool0_from_camera is known, when the calibration gave no covariance of its own. Defaults stand
/// here and nowhere else.
struct HandEyeErrorOptions {
  double position_sigma = 5e-4;     ///< each axis [m]
  double rotation_sigma = 8.73e-4;  ///< about each axis [rad]; 0.05 degrees

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("position_sigma", position_sigma);
    v("rotation_sigma", rotation_sigma);
  }
};

/// The hand-eye transform with its covariance (axes of tool0).
struct HandEye {
  Rigid3 tool0_from_camera;
  Matrix6d covariance = Matrix6d::Zero();
};
HandEye handEye(const Rigid3& tool0_from_camera, const HandEyeErrorOptions& options = {});

/// Where the hand was at the image's stamp.
struct HandPose {
  Rigid3 base_from_tool0;
  Matrix6d jacobian = Matrix6d::Zero();  ///< of tool0 in base (Puma560::jacobian); zero: joints not known
};
HandPose handPose(const Puma560& arm, const JointVector& joints);

/// Covariance of base_from_tool0: position_sigma^2 + J diag(joint_sigma^2) J^T.
Matrix6d armCovariance(const HandPose& hand, const ArmErrorOptions& options);

/// base_from_object = base_from_tool0 * tool0_from_camera * camera_from_object and the motions of it that a
/// small motion of each factor makes: d = image * d_image + hand_eye * d_hand_eye + arm * d_arm. All in the
/// order and the fixed axes of perturbed(). Each matrix is the adjoint of what stands left of the factor,
/// about the object's origin (Murray, Li & Sastry 1994, sec. 2.4.2).
struct Chain {
  Rigid3 base_from_object;
  Matrix6d image, hand_eye, arm;
};
Chain chain(const Rigid3& base_from_tool0, const Rigid3& tool0_from_camera, const Rigid3& camera_from_object);

/// Pose of one object seen once, and where its uncertainty comes from; base frame.
struct PoseInBase {
  Rigid3 base_from_object;
  Matrix6d image, hand_eye, arm;  ///< shares of the covariance
  Matrix6d covariance() const { return image + hand_eye + arm; }
};
/// `covariance`: of camera_from_object, camera axes. Throws BadInput on a pose or a covariance that is not
/// finite or not one.
PoseInBase poseInBase(const HandPose& hand, const HandEye& hand_eye, const Rigid3& camera_from_object,
                      const Matrix6d& covariance, const ArmErrorOptions& arm = {});

/// Throws BadInput, its message beginning with `what`, when the transform is not finite or its matrix is no
/// rotation (1e-6).
void requirePose(const Rigid3& pose, const char* what);

}  // namespace monocular_eye_hand
