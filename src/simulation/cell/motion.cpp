#include "monocular_eye_hand/simulation/cell/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

constexpr double kSlack = 1e-6;  // a planner that uses a limit fully is not reported for rounding

struct Place {
  double p, v;
};

Place linear(double p0, double p1, double T, double t) { return {p0 + (p1 - p0) * t / T, (p1 - p0) / T}; }

Place cubic(double p0, double v0, double p1, double v1, double T, double t) {
  const double c2 = (3 * (p1 - p0) / T - 2 * v0 - v1) / T, c3 = (v0 + v1 - 2 * (p1 - p0) / T) / (T * T);
  return {p0 + t * (v0 + t * (c2 + t * c3)), v0 + t * (2 * c2 + 3 * t * c3)};
}

Place quintic(double p0, double v0, double a0, double p1, double v1, double a1, double T, double t) {
  const double h = p1 - p0, T2 = T * T;
  const double c3 = (20 * h - (8 * v1 + 12 * v0) * T - (3 * a0 - a1) * T2) / (2 * T2 * T);
  const double c4 = (-30 * h + (14 * v1 + 16 * v0) * T + (3 * a0 - 2 * a1) * T2) / (2 * T2 * T2);
  const double c5 = (12 * h - 6 * (v1 + v0) * T + (a1 - a0) * T2) / (2 * T2 * T2 * T);
  return {p0 + t * (v0 + t * (a0 / 2 + t * (c3 + t * (c4 + t * c5)))),
          v0 + t * (a0 + t * (3 * c3 + t * (4 * c4 + t * 5 * c5)))};
}

void checkNumbers(const std::vector<double>& values, size_t point, const char* field) {
  const std::string where = fmt::format("joint path: point {}: ", point);
  if (!values.empty() && values.size() != 6)
    throw BadInput(fmt::format("{}{} {}; give 6 or none", where, values.size(), field));
  for (double v : values)
    if (!std::isfinite(v)) throw BadInput(where + field + " must be finite");
}

void checkPath(const std::vector<CellPathPoint>& path) {
  double before = -1;
  for (size_t k = 0; k < path.size(); ++k) {
    const std::string where = fmt::format("joint path: point {}: ", k);
    if (!std::isfinite(path[k].time) || path[k].time < 0 || path[k].time <= before)
      throw BadInput(fmt::format("{}time = {:g} s must not be negative and must grow", where, path[k].time));
    if (!path[k].positions.allFinite()) throw BadInput(where + "positions must be finite");
    checkNumbers(path[k].velocities, k, "velocities");
    checkNumbers(path[k].accelerations, k, "accelerations");
    if (!path[k].accelerations.empty() && path[k].velocities.empty())
      throw BadInput(where + "accelerations need velocities");
    before = path[k].time;
  }
}

}  // namespace

void evaluatePath(const std::vector<CellPathPoint>& path, double time, JointVector* positions,
                  JointVector* velocities) {
  velocities->setZero();
  if (path.empty()) throw BadInput("joint path: empty, there is nothing to evaluate");
  if (time <= path.front().time || time >= path.back().time) {
    *positions = time >= path.back().time ? path.back().positions : path.front().positions;
    return;
  }

  const auto after = std::upper_bound(path.begin(), path.end(), time,
                                      [](double t, const CellPathPoint& point) { return t < point.time; });
  const CellPathPoint &b = *after, &a = *(after - 1);
  const double T = b.time - a.time, t = time - a.time;

  for (int j = 0; j < 6; ++j) {
    Place place;
    if (a.velocities.empty() || b.velocities.empty())
      place = linear(a.positions[j], b.positions[j], T, t);
    else if (a.accelerations.empty() || b.accelerations.empty())
      place = cubic(a.positions[j], a.velocities[j], b.positions[j], b.velocities[j], T, t);
    else
      place = quintic(a.positions[j], a.velocities[j], a.accelerations[j], b.positions[j], b.velocities[j],
                      b.accelerations[j], T, t);
    (*positions)[j] = place.p;
    (*velocities)[j] = place.v;
  }
}

JointMotion::JointMotion(const Puma560Options& arm, const JointVector& start)
    : limits_(arm.joints), positions_(start), velocities_(JointVector::Zero()) {
  arm.check();
  for (int j = 0; j < 6; ++j)
    if (!(start[j] >= limits_[j].lower - 1e-9 && start[j] <= limits_[j].upper + 1e-9))
      throw BadInput(fmt::format("start_joints: joint {} = {:.3f} rad must be within {:.3f}..{:.3f}", j + 1,
                                 start[j], limits_[j].lower, limits_[j].upper));
}

void JointMotion::command(const std::vector<CellPathPoint>& path) {
  checkPath(path);
  path_.clear();
  time_ = 0;
  mode_ = path.empty() ? Mode::kStopping : Mode::kFollowing;
  if (path.empty()) return;
  if (path.front().time > 0) {
    CellPathPoint here;
    here.positions = positions_;
    here.velocities.assign(velocities_.data(), velocities_.data() + 6);
    if (!path.front().accelerations.empty()) here.accelerations.assign(6, 0.0);
    path_.push_back(here);
  }
  path_.insert(path_.end(), path.begin(), path.end());
}

void JointMotion::clipPosition(int j, std::vector<LimitViolation>* violations) {
  const double lower = limits_[j].lower, upper = limits_[j].upper, wanted = positions_[j];
  positions_[j] = std::clamp(wanted, lower, upper);
  if (positions_[j] == wanted) return;
  velocities_[j] = 0;
  if (std::abs(positions_[j] - wanted) > kSlack)
    violations->push_back({j, LimitViolation::Kind::kPosition, wanted, positions_[j]});
}

void JointMotion::follow(double dt, std::vector<LimitViolation>* violations) {
  time_ += dt;
  JointVector wanted, speed;
  evaluatePath(path_, time_, &wanted, &speed);
  bool arrived = time_ >= path_.back().time;

  for (int j = 0; j < 6; ++j) {
    const double max_velocity = limits_[j].velocity, needed = (wanted[j] - positions_[j]) / dt;
    if (std::abs(needed) > max_velocity * (1 + kSlack)) {
      violations->push_back({j, LimitViolation::Kind::kVelocity, needed, max_velocity});
      velocities_[j] = std::copysign(max_velocity, needed);
      positions_[j] += velocities_[j] * dt;
    } else {
      velocities_[j] = speed[j];
      positions_[j] = wanted[j];
    }
    clipPosition(j, violations);
    const double within = std::clamp(wanted[j], limits_[j].lower, limits_[j].upper);
    arrived = arrived && std::abs(positions_[j] - within) < 1e-12;
  }

  if (!arrived) return;
  mode_ = Mode::kStanding;
  velocities_.setZero();
}

void JointMotion::stop(double dt, std::vector<LimitViolation>* violations) {
  bool standing = true;
  for (int j = 0; j < 6; ++j) {
    const double speed = std::abs(velocities_[j]), brake = limits_[j].acceleration;
    const double moving = std::min(dt, speed / brake);  // time until this joint stands
    positions_[j] += std::copysign(speed * moving - brake * moving * moving / 2, velocities_[j]);
    velocities_[j] = moving < dt ? 0 : std::copysign(speed - brake * dt, velocities_[j]);
    clipPosition(j, violations);
    standing = standing && velocities_[j] == 0;
  }
  if (standing) mode_ = Mode::kStanding;
}

std::vector<LimitViolation> JointMotion::advance(double dt) {
  std::vector<LimitViolation> violations;
  if (dt <= 0) return violations;
  if (mode_ == Mode::kFollowing) follow(dt, &violations);
  if (mode_ == Mode::kStopping) stop(dt, &violations);
  return violations;
}

}  // namespace monocular_eye_hand
