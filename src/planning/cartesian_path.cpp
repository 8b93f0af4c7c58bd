#include "monocular_eye_hand/planning/cartesian_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

std::string singularityAt(const ToolArm& arm, const JointVector& joints, double min_singularity) {
  const Singularity s = arm.arm.singularity(joints);
  if (s.wrist < min_singularity) return "the wrist is nearly straight";
  if (s.elbow < min_singularity) return "the arm is nearly stretched or folded";
  if (s.shoulder < min_singularity) return "the wrist is nearly above the shoulder";
  return "";
}

/// The solution in this configuration nearest to `current`; null when there is none.
const ArmSolution* inConfiguration(const ArmSolutions& solutions, const ArmConfiguration& configuration,
                                   const JointVector& current) {
  const ArmSolution* best = nullptr;
  double min_distance = 0;
  for (const ArmSolution& s : solutions) {
    const double distance = (s.joints - current).norm();
    if (s.configuration == configuration && (!best || distance < min_distance)) {
      best = &s;
      min_distance = distance;
    }
  }
  return best;
}

class Line {
 public:
  Line(const ToolArm& arm, const JointVector& start, const Rigid3& to, const CartesianOptions& options)
      : arm_(arm),
        options_(options),
        from_(arm.baseFromTcp(start)),
        to_(to),
        configuration_(arm.arm.configuration(start)) {
    length_ = (to_.translation - from_.translation).norm();
    path_.points.push_back(start);
  }

  CartesianPath follow() {
    if (!clearOfSingularities(path_.points[0], 0)) return path_;
    const double turn = angleBetween(from_.rotation, to_.rotation);
    const double longest =
        1 / std::max(1.0, std::ceil(std::max(length_ / options_.max_step, turn / options_.max_rotation)));
    if (length_ < 1e-12 && turn < 1e-12) {
      path_.outcome = CartesianOutcome::kFound;
      return path_;
    }

    double at = 0, step = longest;
    while (at < 1) {
      const double next =
          at + 1.5 * step >= 1 && at + step < 1 ? at + (1 - at) / 2 : std::min(1.0, at + step);
      JointVector joints;
      if (!reach(next, &joints)) return path_;
      if (!close(at, next, joints)) {
        step = (next - at) / 2;
        if (step < 1e-4) return refuse(CartesianOutcome::kJump, "a joint jumps", at);
        continue;
      }
      path_.points.push_back(joints);
      at = next;
      step = std::min(longest, 1.5 * step);
    }
    path_.outcome = CartesianOutcome::kFound;
    return path_;
  }

 private:
  CartesianPath& refuse(CartesianOutcome outcome, const std::string& why, double at) {
    path_.outcome = outcome;
    path_.reason = fmt::format("{} after {:.3g} of {:.3g} mm", why, at * length_ * 1e3, length_ * 1e3);
    return path_;
  }
  bool clearOfSingularities(const JointVector& joints, double at) {
    const std::string why = singularityAt(arm_, joints, options_.min_singularity);
    if (why.empty()) return true;
    refuse(CartesianOutcome::kSingular, why, at);
    return false;
  }
  bool reach(double at, JointVector* joints) {
    ArmSolutions solutions;
    arm_.inverse(between(from_, to_, at), path_.points.back(), &solutions);
    const ArmSolution* s = inConfiguration(solutions, configuration_, path_.points.back());
    if (!s) {
      if (solutions.empty())
        refuse(CartesianOutcome::kUnreachable, "out of reach or joint limits", at);
      else
        refuse(CartesianOutcome::kJump, "the configuration " + toString(configuration_) + " ends", at);
      return false;
    }
    *joints = s->joints;
    return clearOfSingularities(s->joints, at);
  }
  /// Whether straight joint interpolation from the last point keeps to the line.
  bool close(double at, double next, const JointVector& joints) const {
    const JointVector& last = path_.points.back();
    if ((joints - last).cwiseAbs().maxCoeff() > options_.joint_jump) return false;
    for (double f : {0.25, 0.5, 0.75}) {
      const Rigid3 meant = between(from_, to_, at + f * (next - at)),
                   is = arm_.baseFromTcp(last + f * (joints - last));
      const Eigen::Vector3d off = is.translation - meant.translation;
      // Along the line it may be early or late.
      const Eigen::Vector3d line = (to_.translation - from_.translation).stableNormalized();
      if ((off - line * line.dot(off)).norm() > options_.deviation) return false;
      if (angleBetween(meant.rotation, is.rotation) > options_.rotation_deviation) return false;
    }
    return true;
  }

  const ToolArm& arm_;
  const CartesianOptions& options_;
  Rigid3 from_, to_;
  ArmConfiguration configuration_;
  double length_ = 0;
  CartesianPath path_;
};

}  // namespace

Eigen::Vector3d ToolArm::tcpVelocity(const JointVector& joints, const JointVector& speeds) const {
  const Vector6d twist = arm.jacobian(joints) * speeds;
  const Eigen::Vector3d lever = arm.baseFromTool0(joints).rotation * tool0_from_tcp.translation;
  return twist.head<3>() + twist.tail<3>().cross(lever);
}

Rigid3 between(const Rigid3& from, const Rigid3& to, double f) {
  Rigid3 pose;
  pose.translation = from.translation + f * (to.translation - from.translation);
  pose.rotation = from.rotation * expSO3(f * logSO3(from.rotation.transpose() * to.rotation));
  return pose;
}

CartesianPath cartesianPath(const ToolArm& arm, const JointVector& start, const Rigid3& base_from_tcp,
                            const CartesianOptions& options) {
  options.check();
  if (!start.allFinite()) throw BadInput("the start joints are not finite");
  if (!arm.arm.withinLimits(start)) throw BadInput("the start joints are outside their limits");
  if (!base_from_tcp.isFinite()) throw BadInput("the pose of gripper_tcp is not finite");
  return Line(arm, start, base_from_tcp, options).follow();
}

}  // namespace monocular_eye_hand
