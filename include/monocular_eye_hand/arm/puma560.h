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
  double lower = 0, upper = 0;  ///< [rad]; the range is at most 2 turns
  double velocity = 1;          ///< [rad/s]
  double acceleration = 1;      ///< [rad/s^2]

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("lower", lower), v("upper", upper), v("velocity", velocity), v("acceleration", acceleration);
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
    v("shoulder_height", shoulder_height), v("a2", a2), v("a3", a3), v("d3", d3), v("d4", d4), v("d6", d6),
        v("joints", joints);
  }
};

enum class Shoulder { kRight, kLeft };
enum class Elbow { kUp, kDown };
enum class Wrist { kPositive, kNegative };  ///< sign of joint 5

/// Which of the eight postures.
struct Branch {
  Shoulder shoulder = Shoulder::kRight;
  Elbow elbow = Elbow::kUp;
  Wrist wrist = Wrist::kPositive;
};
/// "right-up-positive" and so on; used in messages.
std::string name(const Branch& branch);

struct ArmSolution {
  JointVector joints;
  Branch branch;
};

/// All ways to reach a pose; fixed capacity, no allocation.
class ArmSolutions {
 public:
  static constexpr int kCapacity = 8 * 27;  ///< 8 branches, up to 3 turns of joints 1, 4 and 6 each
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
  double shoulder = 0;     ///< wrist centre's distance from the plane of axis 1 [m]
  double elbow = 0;        ///< sine-like measure: |d4 cos q3 + a3 sin q3| [m]
  double wrist = 0;        ///< |sin q5|
  double determinant = 0;  ///< of the Jacobian [m^3]
};

/// Closed-form kinematics of the PUMA 560 (Paul & Zhang 1986). Frames: `base` is base_link on the mounting
/// surface, z up; `tool0` lies in the flange's face, z out of it (the sixth DH frame moved by d6).
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

  /// Every posture, with every whole turn inside the limits, that reaches the pose; none when it is out of
  /// reach. Where only q4 + q6 is defined (q5 = 0), joint 4 keeps `current`; where joint 1 is free it keeps
  /// `current` too.
  void inverse(const Rigid3& base_from_tool0, const JointVector& current, ArmSolutions* solutions) const;
  bool withinLimits(const JointVector& joints, double tolerance = 1e-9) const;

 private:
  Puma560Options options_;
};

}  // namespace monocular_eye_hand
