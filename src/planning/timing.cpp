#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/planning/trajectory.h"

namespace monocular_eye_hand {
namespace {

constexpr double kSample = 0.0375;   // of the tool's speed along the path [rad]
constexpr double kChunk = 0.15;      // longest straight piece with one speed limit [rad]
constexpr double kBlendShare = 0.3;  // of an edge that a corner at its end may use
constexpr double kSharpest = -0.5;   // cosine between edges below which the arm stops

/// Length s along the path is the Euclidean one in joint space. A straight piece keeps its direction; a blend
/// turns it evenly from `direction` to `end_direction`, |dq/ds| <= 1.
struct Piece {
  JointVector from = JointVector::Zero(), direction = JointVector::Zero(),
              end_direction = JointVector::Zero();
  double length = 0, speed = 0, acceleration = 0;  ///< limits of s along it
  bool blend = false;

  JointVector at(double s) const {
    return from + s * direction + (blend ? s * s / (2 * length) : 0) * (end_direction - direction);
  }
  JointVector tangent(double s) const { return direction + (s / length) * (end_direction - direction); }
};

class Timing {
 public:
  Timing(const ToolArm& arm, const PathTest& test, const TimingOptions& options)
      : arm_(arm), test_(test), options_(options) {
    for (int i = 0; i < 6; ++i) {
      velocity_[i] = options.speed * arm.arm.options().joints[i].velocity;
      acceleration_[i] = options.acceleration * arm.arm.options().joints[i].acceleration;
    }
  }

  Trajectory run(const std::vector<JointVector>& points) {
    layOut(points);
    findSpeeds();
    Trajectory trajectory;
    for (size_t i = 0; i < pieces_.size(); ++i) emit(pieces_[i], boundary_[i], boundary_[i + 1], &trajectory);
    trajectory.points.push_back({time_, points.back(), JointVector::Zero(), JointVector::Zero()});
    return trajectory;
  }

 private:
  void layOut(const std::vector<JointVector>& p) {
    double cut = 0;  // of the edge's beginning that belongs to the corner before
    for (size_t i = 0; i + 1 < p.size(); ++i) {
      const double length = (p[i + 1] - p[i]).norm();
      const JointVector d1 = (p[i + 1] - p[i]) / length;
      Piece corner;
      bool stop = false;
      if (i + 2 < p.size()) {
        const double next = (p[i + 2] - p[i + 1]).norm();
        corner =
            blendAt(p[i + 1], d1, (p[i + 2] - p[i + 1]) / next, kBlendShare * std::min(length, next), &stop);
      }
      addStraight(p[i] + cut * d1, d1, length - cut - corner.length / 2);
      cut = corner.length / 2;
      if (corner.length > 0) pieces_.push_back(limitBlend(corner));
      stops_.resize(pieces_.size(), false);
      stops_.back() = stop;
    }
  }

  /// A parabola that leaves the edge half its length before the corner; of length 0 when there is no need for
  /// one or no room, then with a stop.
  Piece blendAt(const JointVector& corner, const JointVector& d1, const JointVector& d2, double half,
                bool* stop) {
    const double bend = (d2 - d1).norm();
    Piece blend;
    if (bend < 1e-9) return blend;
    half = std::min(half, 4 * options_.corner / bend);
    for (int i = 0; i < 6 && half > 1e-6 && d1.dot(d2) > kSharpest; ++i, half /= 2) {
      blend.blend = true;
      blend.from = corner - half * d1;
      blend.direction = d1;
      blend.end_direction = d2;
      blend.length = 2 * half;
      if (blendFree(blend)) return blend;
    }
    *stop = true;
    return Piece();
  }

  bool blendFree(const Piece& blend) const {
    if (!test_.valid) return true;
    int steps = std::max(2, int(std::ceil(blend.length / kSample)));
    if (test_.motion && test_.padding > 0) {
      const JointVector sweep =
          blend.length * blend.direction.cwiseAbs().cwiseMax(blend.end_direction.cwiseAbs());
      steps = std::max(steps, int(std::ceil(test_.motion(sweep) / (2 * test_.padding))));
    }
    for (int k = 1; k < steps; ++k)
      if (!test_.valid(blend.at(blend.length * k / steps))) return false;
    return true;
  }

  void addStraight(const JointVector& from, const JointVector& direction, double length) {
    const int chunks = std::max(1, int(std::ceil(length / kChunk)));
    for (int k = 0; k < chunks; ++k) {
      Piece piece;
      piece.length = length / chunks;
      piece.from = from + k * piece.length * direction;
      piece.direction = piece.end_direction = direction;
      piece.speed = speedLimit(piece);
      piece.acceleration = 1e300;
      for (int i = 0; i < 6; ++i)
        if (std::abs(direction[i]) > 1e-12)
          piece.acceleration = std::min(piece.acceleration, acceleration_[i] / std::abs(direction[i]));
      pieces_.push_back(piece);
    }
  }

  Piece limitBlend(Piece blend) const {
    blend.speed = speedLimit(blend);
    const JointVector bend = (blend.end_direction - blend.direction) / blend.length;
    for (int i = 0; i < 6; ++i)
      if (std::abs(bend[i]) > 1e-12)
        blend.speed = std::min(blend.speed, std::sqrt(acceleration_[i] / std::abs(bend[i])));
    return blend;
  }

  double speedLimit(const Piece& piece) const {
    double limit = 1e300;
    const JointVector share = piece.direction.cwiseAbs().cwiseMax(piece.end_direction.cwiseAbs());
    for (int i = 0; i < 6; ++i)
      if (share[i] > 1e-12) limit = std::min(limit, velocity_[i] / share[i]);
    const int n = std::max(piece.blend ? 8 : 2, int(std::ceil(piece.length / kSample)));
    double fastest = 0;  // of gripper_tcp per ds [m/rad]
    for (int k = 0; k <= n; ++k) {
      const double s = piece.length * k / n;
      fastest = std::max(fastest, arm_.tcpVelocity(piece.at(s), piece.tangent(s)).norm());
    }
    // Between samples a vector stays within step^2 / 8 times its second derivative of the chord; that is at
    // most reach (about 1.2 m) times (sum of |dq/ds|)^3 <= 15, and in a blend 3 sum |dq/ds| sum |d2q/ds2|
    // more.
    const double step = piece.length / n,
                 bend = (piece.end_direction - piece.direction).lpNorm<1>() / piece.length;
    fastest += step * step / 8 * 1.2 * (15 + 3 * 2.45 * bend);
    return std::min(limit, options_.tool_speed / std::max(fastest, 1e-12));
  }

  /// Speeds at the joints of the pieces, by a pass forwards and one backwards.
  void findSpeeds() {
    const size_t n = pieces_.size();
    boundary_.assign(n + 1, 0);
    for (size_t k = 1; k < n; ++k)
      boundary_[k] = stops_[k - 1] ? 0 : std::min(pieces_[k - 1].speed, pieces_[k].speed);
    const auto reachable = [](const Piece& p, double v) {
      return p.blend ? v : std::sqrt(v * v + 2 * p.acceleration * p.length);
    };
    for (size_t k = 0; k < n; ++k)
      boundary_[k + 1] = std::min(boundary_[k + 1], reachable(pieces_[k], boundary_[k]));
    for (size_t k = n; k-- > 0;)
      boundary_[k] = std::min(boundary_[k], reachable(pieces_[k], boundary_[k + 1]));
  }

  void emit(const Piece& piece, double v0, double v1, Trajectory* trajectory) {
    if (piece.blend) {
      const JointVector bend = (piece.end_direction - piece.direction) / piece.length;
      trajectory->points.push_back({time_, piece.from, v0 * piece.direction, v0 * v0 * bend});
      time_ += piece.length / v0;
      return;
    }

    const double a = piece.acceleration;
    const double peak = std::min(piece.speed, std::sqrt(a * piece.length + (v0 * v0 + v1 * v1) / 2));
    const double up = std::max(0.0, (peak * peak - v0 * v0) / (2 * a));
    const double down = std::max(0.0, (peak * peak - v1 * v1) / (2 * a));

    double s = 0;
    const auto phase = [&](double v, double acceleration, double duration, double length) {
      if (duration > 1e-9)
        trajectory->points.push_back(
            {time_, piece.from + s * piece.direction, v * piece.direction, acceleration * piece.direction});
      time_ += duration > 1e-9 ? duration : 0;
      s += length;
    };
    phase(v0, a, (peak - v0) / a, up);
    phase(peak, 0, std::max(0.0, piece.length - up - down) / peak, std::max(0.0, piece.length - up - down));
    phase(peak, -a, (peak - v1) / a, down);
  }

  const ToolArm& arm_;
  const PathTest& test_;
  const TimingOptions& options_;
  JointVector velocity_, acceleration_;
  std::vector<Piece> pieces_;
  std::vector<bool> stops_;  ///< at the end of the piece
  std::vector<double> boundary_;
  double time_ = 0;
};

}  // namespace

Trajectory timeParameterise(const ToolArm& arm, const std::vector<JointVector>& path, const PathTest& test,
                            const TimingOptions& options) {
  options.check();
  if (path.empty()) throw BadInput("the path has no points");
  std::vector<JointVector> points;
  for (const JointVector& p : path) {
    if (!p.allFinite()) throw BadInput("the path has joints that are not finite");
    if (!arm.arm.withinLimits(p)) throw BadInput("the path has joints outside their limits");
    if (points.empty() || (p - points.back()).norm() > 1e-9) points.push_back(p);
  }
  if (points.size() < 2) {
    Trajectory still;
    still.points.push_back({0, points[0], JointVector::Zero(), JointVector::Zero()});
    return still;
  }
  return Timing(arm, test, options).run(points);
}

}  // namespace monocular_eye_hand
