#pragma once
#include <Eigen/Core>
#include <array>
#include <string>

#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// Angles of joint 1 to 6 [rad], Paul's zero: q = 0 is the L-shape, see docs/conventions.md.
using JointVector = Eigen::Matrix<double, 6, 1>;

/// What one joint can do.
struct JointLimit {
  double lower = 0, upper = 0;  ///< [rad]; the range is at most 2 turns, of joints 2, 3 and 5 less than one
  double velocity = 1;          ///< [rad/s]
  double acceleration = 1;      ///< [rad/s^2]

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("lower", lower);
    v("upper", upper);
    v("velocity", velocity);
    v("acceleration", acceleration);
  }
};

/// Lengths and limits of a PUMA 560. Defaults stand here and nowhere else, each with its source in
/// docs/conventions.md; they agree with urdf/puma560.urdf.
struct Puma560Options {
  double shoulder_height = 0.67183;  ///< base_link (mounting surface) to the axis of joint 2 [m]
  double a2 = 0.4318;                ///< upper arm [m]
  double a3 = 0.0203;                ///< elbow offset [m]
  double d3 = 0.15005;               ///< shoulder offset [m]
  double d4 = 0.4318;                ///< forearm [m]
  double d6 = 0.05625;               ///< wrist centre to the flange's face [m]
  std::array<JointLimit, 6> joints;  ///< set by the constructor

  Puma560Options();
  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("shoulder_height", shoulder_height);
    v("a2", a2);
    v("a3", a3);
    v("d3", d3);
    v("d4", d4);
    v("d6", d6);
    v("joints", joints);
  }
};

enum class Shoulder { kRight, kLeft };
enum class Elbow { kUp, kDown };
enum class Wrist { kPositive, kNegative };  ///< sign of joint 5

/// Which of the eight configurations (docs/conventions.md).
struct ArmConfiguration {
  Shoulder shoulder = Shoulder::kRight;
  Elbow elbow = Elbow::kUp;
  Wrist wrist = Wrist::kPositive;

  bool operator==(const ArmConfiguration& o) const {
    return shoulder == o.shoulder && elbow == o.elbow && wrist == o.wrist;
  }
  bool operator!=(const ArmConfiguration& o) const { return !(*this == o); }
};
/// "right-up-positive" and so on; used in messages.
std::string toString(const ArmConfiguration& configuration);
/// The configuration of that name. Throws BadInput naming the eight there are.
ArmConfiguration branchOf(const std::string& name);

struct ArmSolution {
  JointVector joints;
  ArmConfiguration configuration;
};

/// All ways to reach a pose; fixed capacity, no allocation.
class ArmSolutions {
 public:
  static constexpr int kCapacity = 8 * 27;  ///< 8 configurations, up to 3 turns of joints 1, 4 and 6 each
  int size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const ArmSolution& operator[](int i) const { return solutions_[i]; }
  const ArmSolution* begin() const { return solutions_.data(); }
  const ArmSolution* end() const { return solutions_.data() + size_; }
  void clear() { size_ = 0; }
  void add(const ArmSolution& solution) {
    if (size_ < kCapacity) solutions_[size_++] = solution;
  }

 private:
  int size_ = 0;
  std::array<ArmSolution, kCapacity> solutions_;
};

/// How near the three singularities are; each is 0 there (docs/conventions.md).
struct Singularity {
  double shoulder = 0;     ///< distance of the wrist centre from the plane of axis 1 across the arm [m]
  double elbow = 0;        ///< |d4 cos q3 + a3 sin q3| [m]: 0 with the arm stretched or folded
  double wrist = 0;        ///< |sin q5|
  double determinant = 0;  ///< of the Jacobian: a2 times the three, with its sign [m^3]
};

/// Closed-form kinematics of the PUMA 560. Frames: `base` is base_link on the mounting surface, z up; `tool0`
/// lies in the flange's face, z out of it (the sixth DH frame moved by d6).
class Puma560 {
 public:
  /// Throws BadInput when an option is out of range.
  explicit Puma560(const Puma560Options& options = {});
  const Puma560Options& options() const { return options_; }

  Rigid3 baseFromTool0(const JointVector& joints) const;
  /// Frames of the links: [0] = DH frame 0 (shoulder, fixed), [i] = DH frame i, [6] = tool0.
  std::array<Rigid3, 7> baseFromLinks(const JointVector& joints) const;
  /// Geometric Jacobian of tool0 in base: rows velocity [m/s], angular velocity [rad/s] per joint [rad/s].
  Matrix6d jacobian(const JointVector& joints) const;
  Singularity singularity(const JointVector& joints) const;
  /// The configuration these joints are in; at a singularity the first of the two that meet there.
  ArmConfiguration configuration(const JointVector& joints) const;

  /// Every configuration, with every whole turn inside the limits, that reaches the pose; none when it is out
  /// of reach. By Paul & Zhang (Int. J. Robotics Research 5(2), 1986); no allocation. What it returns reaches
  /// the pose to 1e-12 m and 1e-12 rad, also at and near the singularities:
  /// - wrist straight (q5 = 0): only q4 + q6 is defined. Joint 4 keeps `current`, or moves as little as the
  ///   limits of joint 6 ask; the two wrist configurations are one, kPositive.
  /// - arm stretched: the elbow configurations are one, kUp. Wrist centre on the plane of axis 1: the
  /// shoulder
  ///   configurations are one, kRight. A pose beyond these by less than 5e-13 m is taken to be on them.
  /// - wrist centre on axis 1 (only with d3 = 0): joint 1 keeps `current`, whether or not the wrist can
  /// follow. Throws BadInput when the pose or `current` is not finite or the rotation is none (orthonormal to
  /// 1e-6; beyond 1e-14 the tool is turned by as much as the matrix is off).
  void inverse(const Rigid3& base_from_tool0, const JointVector& current, ArmSolutions* solutions) const;
  /// False also for joints that are not finite.
  bool withinLimits(const JointVector& joints, double tolerance = 1e-9) const;

 private:
  Puma560Options options_;
};

}  // namespace monocular_eye_hand
