#include "calibration/closed_forms.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace monocular_eye_hand {
namespace {

/// a X = X b: how arm and camera moved between two of the poses.
struct Motion {
  Rigid3 a, b;
  Eigen::Vector3d a_turn, b_turn;  ///< axis times angle
};

std::vector<Motion> motionsOf(const std::vector<HandEyePair>& pairs) {
  std::vector<Motion> motions;
  for (size_t j = 0; j < pairs.size(); ++j)
    for (size_t i = 0; i < j; ++i) {
      Motion m;
      m.a = pairs[j].arm.inverse() * pairs[i].arm;
      m.b = pairs[j].camera_from_target * pairs[i].camera_from_target.inverse();
      m.a_turn = logSO3(m.a.rotation);
      m.b_turn = logSO3(m.b.rotation);
      motions.push_back(m);
    }
  return motions;
}

/// Motions about one axis leave X open along it and about it: the second eigenvalue of the turns' scatter
/// [rad^2] tells.
bool turnsAboutSeveralAxes(const std::vector<Motion>& motions) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Motion& m : motions) scatter += m.a_turn * m.a_turn.transpose();
  if (motions.empty()) return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter / double(motions.size()));
  constexpr double kLeastTurn = 1e-4;  // of the second axis, root mean square [rad]
  return eigen.eigenvalues()[1] > kLeastTurn * kLeastTurn;
}

/// The rotation for which sum w |a - R b|^2 is least (Kabsch 1976).
template <class Weight>
Eigen::Matrix3d rotationOfTurns(const std::vector<Motion>& motions, Weight weight) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Motion& m : motions) sum += weight(m) * m.a_turn * m.b_turn.transpose();
  return nearestRotation(sum);
}

/// Tsai and Lenz: the modified Rodrigues vector P = 2 sin(angle / 2) axis; skew(Pa + Pb) P' = Pb - Pa.
Eigen::Matrix3d rotationByTsai(const std::vector<Motion>& motions) {
  const auto rodrigues = [](const Eigen::Vector3d& turn) {
    const double angle = turn.norm();
    return angle < 1e-12 ? turn : Eigen::Vector3d(2 * std::sin(angle / 2) / angle * turn);
  };
  Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  for (const Motion& m : motions) {
    const Eigen::Vector3d pa = rodrigues(m.a_turn);
    const Eigen::Vector3d pb = rodrigues(m.b_turn);
    const Eigen::Matrix3d k = skew(pa + pb);
    h += k.transpose() * k;
    g += k.transpose() * (pb - pa);
  }

  const Eigen::Vector3d half = h.ldlt().solve(g);  // tan(angle / 2) axis
  const double tangent = half.norm();
  return tangent < 1e-12 ? Eigen::Matrix3d::Identity() : expSO3(2 * std::atan(tangent) / tangent * half);
}

/// (Ra - I) t = R tb - ta of all motions by least squares.
Rigid3 withTranslation(const std::vector<Motion>& motions, const Eigen::Matrix3d& rotation) {
  Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  for (const Motion& m : motions) {
    const Eigen::Matrix3d k = m.a.rotation - Eigen::Matrix3d::Identity();
    h += k.transpose() * k;
    g += k.transpose() * (rotation * m.b.translation - m.a.translation);
  }
  return {rotation, h.ldlt().solve(g)};
}

/// Andreff et al.: rotation (row by row) and translation as twelve unknowns of linear equations.
Rigid3 byKroneckerProduct(const std::vector<Motion>& motions) {
  using Matrix12d = Eigen::Matrix<double, 12, 12>;
  Matrix12d h = Matrix12d::Zero();
  Eigen::Matrix<double, 12, 1> g = Eigen::Matrix<double, 12, 1>::Zero();
  for (const Motion& m : motions) {
    Matrix12d rows = Matrix12d::Zero();
    Eigen::Matrix<double, 12, 1> right = Eigen::Matrix<double, 12, 1>::Zero();
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {  // (X - Ra X Rb^T)_rc = 0, and row r of X tb + (I - Ra) t = ta
        rows(3 * r + c, 3 * r + c) = 1;
        for (int i = 0; i < 3; ++i)
          for (int k = 0; k < 3; ++k) rows(3 * r + c, 3 * i + k) -= m.a.rotation(r, i) * m.b.rotation(c, k);
        rows(9 + r, 3 * r + c) = m.b.translation[c];
        rows(9 + r, 9 + c) = (r == c) - m.a.rotation(r, c);
      }
    right.tail<3>() = m.a.translation;
    h += rows.transpose() * rows;
    g += rows.transpose() * right;
  }

  const Eigen::Matrix<double, 12, 1> x = h.ldlt().solve(g);
  Eigen::Matrix3d rotation;
  rotation << x.segment<3>(0).transpose(), x.segment<3>(3).transpose(), x.segment<3>(6).transpose();
  if (!(rotation.determinant() > 0)) return {Eigen::Matrix3d::Constant(NAN), x.tail<3>()};
  return withTranslation(motions, nearestRotation(rotation));
}

/// Vector parts of the unit dual quaternion of a motion; the scalar of its real part is not negative.
struct DualQuaternion {
  Eigen::Vector3d real, dual;
  explicit DualQuaternion(const Rigid3& motion) {
    Eigen::Quaterniond q = motion.quaternion();
    if (q.w() < 0) q.coeffs() *= -1;
    const Eigen::Vector3d& t = motion.translation;
    real = q.vec();
    dual = (Eigen::Quaterniond(0, t.x(), t.y(), t.z()) * q).vec() / 2;
  }
};

/// The combination of two vectors (q, q') that is a unit dual quaternion: q^T q = 1, q^T q' = 0. Of two the
/// one with the longer q.
std::optional<Eigen::Matrix<double, 8, 1>> unitCombination(const Eigen::Matrix<double, 8, 1>& v1,
                                                           const Eigen::Matrix<double, 8, 1>& v2) {
  const Eigen::Vector4d u1 = v1.head<4>();
  const Eigen::Vector4d u2 = v2.head<4>();
  const double a = u1.dot(v1.tail<4>());
  const double b = u1.dot(v2.tail<4>()) + u2.dot(v1.tail<4>());
  const double c = u2.dot(v2.tail<4>());
  const double root = std::sqrt(std::max(0.0, b * b - 4 * a * c));

  std::optional<Eigen::Matrix<double, 8, 1>> best;
  double longest = 0;
  for (const double sign : {1.0, -1.0}) {
    // a x^2 + b x y + c y^2 = 0, in the form that loses no digits for a near 0
    const double q = -0.5 * (b + (b >= 0 ? root : -root));
    const Eigen::Vector2d xy = sign > 0 ? Eigen::Vector2d(q, a) : Eigen::Vector2d(c, q);
    const Eigen::Matrix<double, 8, 1> sum = xy.x() * v1 + xy.y() * v2;
    const double length = sum.head<4>().norm() / std::max(xy.norm(), 1e-300);
    if (!(length > longest)) continue;
    longest = length;
    best = sum / sum.head<4>().norm();
  }
  return best;
}

/// Daniilidis: (a - b) q.w + skew(a + b) q.vec = 0 of the vector parts, and the same of the dual ones.
std::optional<Rigid3> byDualQuaternions(const std::vector<Motion>& motions) {
  Eigen::Matrix<double, 8, 8> h = Eigen::Matrix<double, 8, 8>::Zero();
  for (const Motion& m : motions) {
    const DualQuaternion a(m.a);
    const DualQuaternion b(m.b);
    Eigen::Matrix<double, 6, 8> rows = Eigen::Matrix<double, 6, 8>::Zero();
    rows.block<3, 1>(0, 0) = rows.block<3, 1>(3, 4) = a.real - b.real;
    rows.block<3, 3>(0, 1) = rows.block<3, 3>(3, 5) = skew(a.real + b.real);
    rows.block<3, 1>(3, 0) = a.dual - b.dual;
    rows.block<3, 3>(3, 1) = skew(a.dual + b.dual);
    h += rows.transpose() * rows;
  }

  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 8, 8>> eigen(h);
  const auto q = unitCombination(eigen.eigenvectors().col(0), eigen.eigenvectors().col(1));
  if (!q || !q->allFinite()) return {};
  const Eigen::Quaterniond real((*q)[0], (*q)[1], (*q)[2], (*q)[3]);
  const Eigen::Quaterniond dual((*q)[4], (*q)[5], (*q)[6], (*q)[7]);
  return Rigid3{real.normalized().toRotationMatrix(), 2 * (dual * real.conjugate()).vec()};
}

}  // namespace

std::vector<HandEyeStart> closedForms(const std::vector<HandEyePair>& pairs) {
  const std::vector<Motion> motions = motionsOf(pairs);
  std::vector<HandEyeStart> starts;
  if (pairs.size() < 3 || !turnsAboutSeveralAxes(motions)) return starts;

  const auto add = [&](const std::string& method, const Rigid3& x) {
    if (x.isFinite()) starts.push_back({method, x});
  };
  add("Park", withTranslation(motions, rotationOfTurns(motions, [](const Motion&) { return 1.0; })));
  add("Horaud", withTranslation(motions, rotationOfTurns(motions, [](const Motion& m) {
                                  return 1 / std::max(1e-12, m.a_turn.norm() * m.b_turn.norm());
                                })));
  add("Tsai", withTranslation(motions, rotationByTsai(motions)));
  add("Andreff", byKroneckerProduct(motions));
  if (const std::optional<Rigid3> x = byDualQuaternions(motions)) add("Daniilidis", *x);
  return starts;
}

Rigid3 meanTarget(const std::vector<HandEyePair>& pairs, const Rigid3& x) {
  Eigen::Matrix3d rotations = Eigen::Matrix3d::Zero();
  Eigen::Vector3d translations = Eigen::Vector3d::Zero();
  for (const HandEyePair& pair : pairs) {
    const Rigid3 target = pair.arm * x * pair.camera_from_target;
    rotations += target.rotation;
    translations += target.translation;
  }
  return {nearestRotation(rotations), translations / double(pairs.size())};
}

}  // namespace monocular_eye_hand
