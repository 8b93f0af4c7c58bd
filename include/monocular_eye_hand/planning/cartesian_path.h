#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/puma560.h"
#include "monocular_eye_hand/planning/options.h"

namespace monocular_eye_hand {

/// The arm's kinematics with gripper_tcp at its end.
struct ToolArm {
  Puma560 arm;
  Rigid3 tool0_from_tcp;

  Rigid3 baseFromTcp(const JointVector& joints) const { return arm.baseFromTool0(joints) * tool0_from_tcp; }
  void inverse(const Rigid3& base_from_tcp, const JointVector& current, ArmSolutions* solutions) const {
    arm.inverse(base_from_tcp * tool0_from_tcp.inverse(), current, solutions);
  }
  /// Velocity of gripper_tcp [m/s] at these joint speeds [rad/s].
  Eigen::Vector3d tcpVelocity(const JointVector& joints, const JointVector& speeds) const;
};

enum class CartesianOutcome {
  kFound,
  kUnreachable,  ///< out of reach or outside the joint limits
  kSingular,     ///< too near a singularity
  kJump,         ///< the configuration is lost or a joint jumps
};

struct CartesianPath {
  CartesianOutcome outcome = CartesianOutcome::kUnreachable;
  std::string reason;               ///< empty when found
  std::vector<JointVector> points;  ///< from the start; as far as it went
  bool found() const { return outcome == CartesianOutcome::kFound; }
};

/// Pose at share f of the straight line: translation linear, rotation about one axis.
Rigid3 between(const Rigid3& from, const Rigid3& to, double f);

/// Straight line of gripper_tcp from where `start` has it to `base_from_tcp`, in the configuration of
/// `start`. Steps are as short as the deviation of straight joint interpolation asks. Throws BadInput on
/// joints or a pose that are not finite, joints outside the limits, or options out of range.
CartesianPath cartesianPath(const ToolArm& arm, const JointVector& start, const Rigid3& base_from_tcp,
                            const CartesianOptions& options = {});

}  // namespace monocular_eye_hand
