#include "monocular_eye_hand/geometry/covariance.h"

#include <Eigen/Eigenvalues>
#include <string>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

Matrix6d adjointOfTranslation(const Eigen::Vector3d& offset) {
  Matrix6d motion = Matrix6d::Identity();
  motion.topRightCorner<3, 3>() = -skew(offset);
  return motion;
}

Matrix6d adjointOfRotation(const Eigen::Matrix3d& rotation) {
  Matrix6d motion = Matrix6d::Zero();
  motion.topLeftCorner<3, 3>() = rotation;
  motion.bottomRightCorner<3, 3>() = rotation;
  return motion;
}

Matrix6d propagate(const Matrix6d& motion, const Matrix6d& covariance) {
  const Matrix6d product = motion * covariance * motion.transpose();
  return 0.5 * (product + product.transpose());
}

void requireCovariance(const Matrix6d& covariance, const char* what) {
  const std::string name(what);
  if (!covariance.allFinite()) throw BadInput(name + " is not finite");
  const double largest = covariance.cwiseAbs().maxCoeff();
  if ((covariance - covariance.transpose()).cwiseAbs().maxCoeff() > 1e-6 * largest)
    throw BadInput(name + " is not symmetric");
  // Metres and radians differ widely in size: the sign is judged on the scaled matrix.
  const Vector6d scale = covariance.diagonal().cwiseMax(1e-12 * largest).cwiseMax(1e-300).cwiseSqrt();
  const Matrix6d scaled = scale.cwiseInverse().asDiagonal() * covariance * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(scaled, Eigen::EigenvaluesOnly);
  if (!(solver.eigenvalues()[0] >= -1e-6 * std::max(1e-300, solver.eigenvalues()[5])))
    throw BadInput(name + " has a negative variance in some direction");
}

}  // namespace monocular_eye_hand
