#include <fmt/format.h>

// Closed-form inverse after Paul & Zhang, "Computationally efficient kinematics for manipulators with
// spherical wrists based on the homogeneous transformation representation", Int. J. Robotics Research 5(2),
// 1986. Sines and cosines are carried along instead of being taken of the angles found, and each angle is
// found from what the angles before it left over, so that their errors cancel instead of adding up near a
// singularity.
#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/arm/puma560.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kTurn = 2 * M_PI;
constexpr double kLimitTolerance = 1e-9;   ///< [rad], as withinLimits()
constexpr double kReachTolerance = 5e-13;  ///< a pose this far out of reach is taken to be in reach [m]
constexpr double kStraightWrist = 1e-13;   ///< |sin q5| below which only q4 + q6 is defined
constexpr double kRotationTolerance = 1e-6;

double squared(double x) { return x * x; }

/// An angle by its sine and cosine, to be divided by their common length.
struct Direction {
  double s, c;
  double angle() const { return std::atan2(s, c); }
  Direction unit() const {
    const double scale = 1 / std::sqrt(s * s + c * c);
    return {s * scale, c * scale};
  }
};

/// The values angle + 2 pi k between the limits.
class Turns {
 public:
  Turns(double angle, const JointLimit& limit) : end_(limit.upper + kLimitTolerance) {
    const double start = limit.lower - kLimitTolerance;
    first_ = angle - kTurn * std::floor((angle - start) / kTurn);
    if (first_ < start) first_ += kTurn;  // lost to rounding
    count_ = first_ > end_ ? 0 : 1 + int((end_ - first_) / kTurn);
  }
  int count() const { return count_; }
  double operator[](int i) const { return first_ + kTurn * i; }

 private:
  double first_, end_;
  int count_;
};

void requireUsable(const Rigid3& pose, const JointVector& current) {
  if (!pose.isFinite()) throw BadInput("inverse kinematics: the pose is not finite");
  if (!current.allFinite()) throw BadInput("inverse kinematics: the current joint angles are not finite");
  const Matrix3d& r = pose.rotation;
  const double off = (r.transpose() * r - Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (off > kRotationTolerance || r.col(0).cross(r.col(1)).dot(r.col(2)) < 0)
    throw BadInput(
        fmt::format("inverse kinematics: the pose's rotation matrix is no rotation (R'R differs from I by "
                    "{:g}); normalise its quaternion first",
                    off));
}

class Solver {
 public:
  Solver(const Puma560Options& options, const Rigid3& tool, const JointVector& current, ArmSolutions* out)
      : o_(options), rotation_(tool.rotation), current_(current), out_(*out) {
    wrist_ = tool.translation - o_.d6 * tool.rotation.col(2);
    wrist_.z() -= o_.shoulder_height;
  }

  void solve() {
    const double r2 = squared(wrist_.x()) + squared(wrist_.y());
    const double reach2 = r2 - squared(o_.d3);
    const bool on_shoulder_plane = reach2 <= 0;
    if (on_shoulder_plane && std::abs(o_.d3) - std::sqrt(r2) > kReachTolerance) return;
    on_axis_ = r2 < squared(kReachTolerance);
    reach_ = on_shoulder_plane || on_axis_ ? 0 : std::sqrt(reach2);
    if (!bendElbow()) return;
    shoulder(Shoulder::kRight);
    if (!on_shoulder_plane || on_axis_) shoulder(Shoulder::kLeft);
  }

 private:
  /// Both elbow angles; they do not depend on the shoulder. False: out of reach.
  bool bendElbow() {
    const double rho2 = squared(o_.a3) + squared(o_.d4), rho = std::sqrt(rho2);
    const double distance2 = squared(reach_) + squared(wrist_.z()), distance = std::sqrt(distance2);
    // In the upper arm's frame the wrist centre is at (a2 + k, n), n = +-sqrt(rho^2 - k^2).
    double k = (distance2 - squared(o_.a2) - rho2) / (2 * o_.a2);
    const double beyond = std::abs(k) - rho;
    stretched_ = beyond >= 0;
    // Taking k back by `beyond` moves the wrist centre by beyond * a2 / distance.
    if (stretched_ && beyond * o_.a2 > kReachTolerance * distance) return false;
    if (stretched_) k = std::copysign(rho, k);
    along_ = o_.a2 + k;
    across_ = stretched_ ? 0 : std::sqrt((rho - k) * (rho + k));
    for (int sign : {0, 1}) {
      const double n = sign ? across_ : -across_;
      elbows_[sign] = Direction{o_.a3 * n - o_.d4 * k, o_.a3 * k + o_.d4 * n}.unit();
    }
    return true;
  }

  void shoulder(Shoulder shoulder) {
    const double reach = shoulder == Shoulder::kRight ? reach_ : -reach_;
    // The wrist centre's foot is at (reach, -d3) turned by q1.
    Direction q1{wrist_.y() * reach + wrist_.x() * o_.d3, wrist_.x() * reach - wrist_.y() * o_.d3};
    double angle = q1.angle();
    if (on_axis_) {  // joint 1 is free
      angle = current_[0] + (shoulder == Shoulder::kRight ? 0 : M_PI);
      q1 = {std::sin(angle), std::cos(angle)};
    } else {
      q1 = q1.unit();
    }
    const Turns turns(angle, o_.joints[0]);
    if (turns.count() == 0) return;
    // Up means the elbow above the line from shoulder to wrist, seen with the arm reaching forwards.
    elbow({shoulder, Elbow::kUp}, turns, q1, reach, shoulder == Shoulder::kLeft);
    if (!stretched_) elbow({shoulder, Elbow::kDown}, turns, q1, reach, shoulder == Shoulder::kRight);
  }

  void elbow(ArmConfiguration configuration, const Turns& turns1, const Direction& q1, double reach,
             int sign) {
    const Direction q3 = elbows_[sign];
    const Turns turns3(q3.angle(), o_.joints[2]);
    if (turns3.count() == 0) return;
    const double n = sign ? across_ : -across_, z = wrist_.z();
    Direction q2{along_ * z - n * reach, along_ * reach + n * z};
    double angle2 = current_[1];
    if (q2.s == 0 && q2.c == 0) {  // folded onto the shoulder: joint 2 is free
      q2 = {std::sin(angle2), std::cos(angle2)};
    } else {
      angle2 = q2.angle();
      q2 = q2.unit();
    }
    const Turns turns2(angle2, o_.joints[1]);
    if (turns2.count() == 0) return;

    const double s23 = q2.s * q3.c + q2.c * q3.s, c23 = q2.c * q3.c - q2.s * q3.s;
    Matrix3d forearm;
    forearm << q1.c * c23, -q1.s, -q1.c * s23, q1.s * c23, q1.c, -q1.s * s23, s23, 0, c23;
    joints_[1] = turns2[0];
    joints_[2] = turns3[0];
    wrist(configuration, turns1, forearm.transpose() * rotation_);
  }

  /// w = Rz(q4) Ry(-q5) Rz(q6).
  void wrist(ArmConfiguration configuration, const Turns& turns1, const Matrix3d& w) {
    const double sine5 = std::sqrt(squared(w(0, 2)) + squared(w(1, 2)));
    if (sine5 <= kStraightWrist) return straightWrist(configuration, turns1, w);
    const Direction q4{-w(1, 2) / sine5, -w(0, 2) / sine5};
    // q6 from what q4 leaves over: an error of q4, large when q5 is small, is taken back by q6.
    const Direction q6{q4.c * w(1, 0) - q4.s * w(0, 0), q4.c * w(1, 1) - q4.s * w(0, 1)};
    const double a4 = q4.angle(), a5 = std::atan2(sine5, w(2, 2)), a6 = q6.angle();
    configuration.wrist = Wrist::kPositive;
    addTurns(configuration, turns1, a4, a5, a6);
    configuration.wrist = Wrist::kNegative;
    addTurns(configuration, turns1, a4 + M_PI, -a5, a6 + M_PI);
  }

  void addTurns(const ArmConfiguration& configuration, const Turns& turns1, double a4, double a5, double a6) {
    const Turns turns5(a5, o_.joints[4]);
    if (turns5.count() == 0) return;
    joints_[4] = turns5[0];
    const Turns turns4(a4, o_.joints[3]), turns6(a6, o_.joints[5]);
    for (int i = 0; i < turns4.count(); ++i)
      for (int j = 0; j < turns6.count(); ++j) add(configuration, turns1, turns4[i], turns6[j]);
  }

  /// q5 is 0 or half a turn: only q4 + q6 or q6 - q4 is defined. Joint 4 moves as little as joint 6 allows.
  void straightWrist(ArmConfiguration configuration, const Turns& turns1, const Matrix3d& w) {
    const bool forwards = w(2, 2) > 0;
    const Turns turns5(forwards ? 0 : M_PI, o_.joints[4]);
    if (turns5.count() == 0) return;
    joints_[4] = turns5[0];
    configuration.wrist = Wrist::kPositive;

    // With q4 = 0, joint 6 does all of it; half a turn of q5 makes Rz(q4) Ry(pi) = Ry(pi) Rz(-q4).
    const double sum = std::atan2(w(1, 0), w(1, 1)), sense = forwards ? 1 : -1;
    const JointLimit &limit4 = o_.joints[3], &limit6 = o_.joints[5];
    // sum + 2 pi k = q6 + sense q4 for every k that the limits leave.
    const double low4 = forwards ? limit4.lower : -limit4.upper,
                 high4 = forwards ? limit4.upper : -limit4.lower;
    const double lowest = limit6.lower + low4 - kLimitTolerance,
                 highest = limit6.upper + high4 + kLimitTolerance;

    for (double k = std::ceil((lowest - sum) / kTurn); sum + kTurn * k <= highest; ++k) {
      const double total = sum + kTurn * k;
      const double low = std::max(low4, total - limit6.upper), high = std::min(high4, total - limit6.lower);
      const double signed4 = std::min(std::max(sense * current_[3], low), high);
      add(configuration, turns1, sense * signed4, total - signed4);
    }
  }

  void add(const ArmConfiguration& configuration, const Turns& turns1, double q4, double q6) {
    joints_[3] = q4;
    joints_[5] = q6;
    for (int i = 0; i < turns1.count(); ++i) {
      joints_[0] = turns1[i];
      out_.add({joints_, configuration});
    }
  }

  const Puma560Options& o_;
  const Matrix3d& rotation_;
  const JointVector& current_;
  ArmSolutions& out_;
  Vector3d wrist_;                 ///< from the shoulder [m]
  double reach_ = 0;               ///< of the wrist centre in the plane of the arm [m]
  double along_ = 0, across_ = 0;  ///< wrist centre in the upper arm's frame [m]
  bool on_axis_ = false;           ///< wrist centre on axis 1
  bool stretched_ = false;         ///< or folded
  Direction elbows_[2];            ///< of negative and of positive `across_`
  JointVector joints_;
};

}  // namespace

void Puma560::inverse(const Rigid3& base_from_tool0, const JointVector& current,
                      ArmSolutions* solutions) const {
  requireUsable(base_from_tool0, current);
  solutions->clear();
  Solver(options_, base_from_tool0, current, solutions).solve();
}

}  // namespace monocular_eye_hand
