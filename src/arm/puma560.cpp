#include "monocular_eye_hand/arm/puma560.h"

#include <cmath>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

using Eigen::Vector3d;

// One configuration name per bit: shoulder 4, elbow 2, wrist 1.
const char* const kConfigurationNames[8] = {"right-up-positive",   "right-up-negative", "right-down-positive",
                                            "right-down-negative", "left-up-positive",  "left-up-negative",
                                            "left-down-positive",  "left-down-negative"};

struct SineCosine {
  double s, c;
  explicit SineCosine(double angle) : s(std::sin(angle)), c(std::cos(angle)) {}
};

/// What the arm's first three joints do: the wrist's foot and the directions of the forearm's frame.
struct Trunk {
  SineCosine q1, q2, q3, q23;
  explicit Trunk(const JointVector& q) : q1(q[0]), q2(q[1]), q3(q[2]), q23(q[1] + q[2]) {}

  /// A vector of the plane of the arm: u along the reach, v up.
  Vector3d inPlane(double u, double v) const { return {q1.c * u, q1.s * u, v}; }
  Vector3d axis1() const { return {0, 0, 1}; }
  Vector3d axis2() const { return {q1.s, -q1.c, 0}; }
  Vector3d axis4() const { return inPlane(-q23.s, q23.c); }
  Eigen::Matrix3d rotation() const {
    Eigen::Matrix3d r;
    r << inPlane(q23.c, q23.s), -axis2(), axis4();
    return r;
  }
};

/// Reach of the wrist centre in the plane of the arm [m].
double reach(const Puma560Options& o, const Trunk& t) {
  return o.a2 * t.q2.c + o.a3 * t.q23.c - o.d4 * t.q23.s;
}

Vector3d shoulderFromWrist(const Puma560Options& o, const Trunk& t) {
  const double u = reach(o, t), v = o.a2 * t.q2.s + o.a3 * t.q23.s + o.d4 * t.q23.c;
  return t.inPlane(u, v) + o.d3 * t.axis2();
}

/// Rz(q4) Ry(-q5) Rz(q6).
Eigen::Matrix3d wristRotation(const JointVector& q) {
  const SineCosine q4(q[3]), q5(q[4]), q6(q[5]);
  Eigen::Matrix3d w;
  w << q4.c * q5.c * q6.c - q4.s * q6.s, -q4.c * q5.c * q6.s - q4.s * q6.c, -q4.c * q5.s,  //
      q4.s * q5.c * q6.c + q4.c * q6.s, -q4.s * q5.c * q6.s + q4.c * q6.c, -q4.s * q5.s,   //
      q5.s * q6.c, -q5.s * q6.s, q5.c;
  return w;
}

/// One row of the DH table (standard convention) with alpha = quarter turns * 90 degrees.
struct DhRow {
  double d, a;
  int quarter_turns;
};

Rigid3 dhTransform(const DhRow& row, double angle) {
  const SineCosine q(angle);
  Rigid3 t;
  const double k = row.quarter_turns;  // sin(alpha); cos(alpha) is 1 - |k|
  const double ca = 1 - std::abs(k);
  t.rotation << q.c, -q.s * ca, q.s * k, q.s, q.c * ca, -q.c * k, 0, k, ca;
  t.translation = {row.a * q.c, row.a * q.s, row.d};
  return t;
}

}  // namespace

std::string toString(const ArmConfiguration& configuration) {
  return kConfigurationNames[4 * (configuration.shoulder == Shoulder::kLeft) +
                             2 * (configuration.elbow == Elbow::kDown) +
                             (configuration.wrist == Wrist::kNegative)];
}

ArmConfiguration branchOf(const std::string& name) {
  std::string known;
  for (int i = 0; i < 8; ++i) {
    if (name == kConfigurationNames[i])
      return {i & 4 ? Shoulder::kLeft : Shoulder::kRight, i & 2 ? Elbow::kDown : Elbow::kUp,
              i & 1 ? Wrist::kNegative : Wrist::kPositive};
    known += (i ? ", " : "") + std::string(kConfigurationNames[i]);
  }
  throw BadInput("'" + name + "' is no branch of the arm; there are " + known);
}

Puma560::Puma560(const Puma560Options& options) : options_(options) { options_.check(); }

Rigid3 Puma560::baseFromTool0(const JointVector& joints) const {
  const Trunk trunk(joints);
  Rigid3 tool;
  tool.rotation = trunk.rotation() * wristRotation(joints);
  tool.translation = shoulderFromWrist(options_, trunk) + options_.d6 * tool.rotation.col(2);
  tool.translation.z() += options_.shoulder_height;
  return tool;
}

std::array<Rigid3, 7> Puma560::baseFromLinks(const JointVector& joints) const {
  const DhRow rows[6] = {{0, 0, 1},           {0, options_.a2, 0}, {options_.d3, options_.a3, -1},
                         {options_.d4, 0, 1}, {0, 0, -1},          {options_.d6, 0, 0}};
  std::array<Rigid3, 7> links;
  links[0].translation.z() = options_.shoulder_height;
  for (int i = 0; i < 6; ++i) links[size_t(i) + 1] = links[size_t(i)] * dhTransform(rows[i], joints[i]);
  return links;
}

Matrix6d Puma560::jacobian(const JointVector& joints) const {
  const Trunk trunk(joints);
  const SineCosine q4(joints[3]), q5(joints[4]);
  const Eigen::Matrix3d forearm = trunk.rotation();
  const Vector3d wrist = shoulderFromWrist(options_, trunk);
  const Vector3d axis6 = forearm * Vector3d(-q4.c * q5.s, -q4.s * q5.s, q5.c);
  const Vector3d tool = wrist + options_.d6 * axis6;
  const Vector3d elbow = options_.a2 * trunk.inPlane(trunk.q2.c, trunk.q2.s);
  const Vector3d axes[6] = {
      trunk.axis1(), trunk.axis2(), trunk.axis2(), trunk.axis4(), forearm * Vector3d(q4.s, -q4.c, 0), axis6};
  const Vector3d feet[6] = {Vector3d::Zero(), Vector3d::Zero(), elbow, wrist, wrist, wrist};
  Matrix6d jacobian;
  for (int i = 0; i < 6; ++i) jacobian.col(i) << axes[i].cross(tool - feet[i]), axes[i];
  return jacobian;
}

Singularity Puma560::singularity(const JointVector& joints) const {
  const Trunk trunk(joints);
  const double shoulder = reach(options_, trunk);
  const double elbow = options_.d4 * trunk.q3.c + options_.a3 * trunk.q3.s;
  const double wrist = std::sin(joints[4]);
  return {std::abs(shoulder), std::abs(elbow), std::abs(wrist), options_.a2 * shoulder * elbow * wrist};
}

ArmConfiguration Puma560::configuration(const JointVector& joints) const {
  const Trunk trunk(joints);
  const bool left = reach(options_, trunk) < 0;
  const double bend = options_.d4 * trunk.q3.c + options_.a3 * trunk.q3.s;
  const bool up = left ? bend >= 0 : bend <= 0;
  return {left ? Shoulder::kLeft : Shoulder::kRight, up ? Elbow::kUp : Elbow::kDown,
          std::sin(joints[4]) < 0 ? Wrist::kNegative : Wrist::kPositive};
}

bool Puma560::withinLimits(const JointVector& joints, double tolerance) const {
  for (int i = 0; i < 6; ++i) {
    const JointLimit& limit = options_.joints[size_t(i)];
    if (!(joints[i] >= limit.lower - tolerance && joints[i] <= limit.upper + tolerance)) return false;
  }
  return true;
}

}  // namespace monocular_eye_hand
