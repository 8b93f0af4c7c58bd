#include "monocular_eye_hand/model/free_turns.h"

#include <Eigen/LU>
#include <cmath>

namespace monocular_eye_hand {
namespace {

// Directions of the free rotations in the target frame, and the pose change that one radian about each makes.
struct FreeTurns {
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> direction;
  Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 3> motion;
};

FreeTurns freeTurns(const ObjectModel& model, const Rigid3& pose) {
  FreeTurns turns;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  if (model.symmetries.sphere) {
    turns.direction = Eigen::Matrix3d::Identity();
    point = pose * model.centre();
  } else if (model.symmetries.axis) {
    turns.direction = pose.rotation * model.symmetries.axis->direction;
    point = pose * model.symmetries.axis->point;
  } else {
    turns.direction.resize(3, 0);
  }
  turns.motion.resize(6, turns.direction.cols());
  for (int k = 0; k < turns.direction.cols(); ++k) {
    const Eigen::Vector3d d = turns.direction.col(k);
    turns.motion.col(k) << d.cross(pose.translation - point), d;
  }
  return turns;
}

}  // namespace

Matrix6d conditionedOnFreeAxis(const ObjectModel& model, const Rigid3& pose, const Matrix6d& covariance) {
  const FreeTurns turns = freeTurns(model, pose);
  if (turns.direction.cols() == 0) return covariance;
  // Conditioned on the angles about the free directions being known.
  const Eigen::MatrixXd across = covariance.rightCols<3>() * turns.direction;
  const Eigen::MatrixXd within = turns.direction.transpose() * across.bottomRows<3>();
  if (!(within.diagonal().minCoeff() > 0)) return covariance;
  const Matrix6d held = covariance - across * within.inverse() * across.transpose();
  return 0.5 * (held + held.transpose());
}

Matrix6d withFreeAxisVariance(const ObjectModel& model, const Rigid3& pose, const Matrix6d& held) {
  const FreeTurns turns = freeTurns(model, pose);
  if (turns.motion.cols() == 0) return held;
  return held + M_PI * M_PI / 3 * turns.motion * turns.motion.transpose();
}

}  // namespace monocular_eye_hand
