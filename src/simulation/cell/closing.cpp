#include "simulation/cell/closing.h"

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

constexpr double kSkin = 2e-6;        // a face at the pad counts as touched [m]
constexpr double kReleaseGap = 1e-4;  // a wider opening than the part by this lets it fall [m]
constexpr double kSteepest = 0.35;    // z of the closing direction up to which a part slides on the table

}  // namespace

bool CellGripper::push(int object, double along_y, const Rigid3& world_from_tcp, const CellBodies& bodies,
                       Outcome* outcome) const {
  if (std::abs(along_y) < 1e-9) return true;
  Eigen::Vector3d y = world_from_tcp.rotation.col(1);
  if ((*bodies.fixed)[size_t(object)] || std::abs(y.z()) > kSteepest) return false;
  y.z() = 0;

  Rigid3& pose = (*bodies.objects)[size_t(object)].world_from_object;
  const Rigid3 before = pose;
  const std::vector<int> met = bodies.solids->objectCollisions(object);
  pose.translation += y * (along_y / y.squaredNorm());
  bodies.solids->placeObject(object, pose);

  for (int other : bodies.solids->objectCollisions(object)) {
    if (std::count(met.begin(), met.end(), other)) continue;
    outcome->jammed = object;
    outcome->against = other;
    pose = before;
    bodies.solids->placeObject(object, pose);
    return false;
  }

  outcome->pushed = true;
  return true;
}

CellGripper::Stop CellGripper::meet(int object, double next, const Rigid3& world_from_tcp,
                                    const CellBodies& bodies, Outcome* outcome) {
  const SceneObject& part = (*bodies.objects)[size_t(object)];
  Rigid3 tcp_from_object = world_from_tcp.inverse() * part.world_from_object;
  if (object == compliant_to_) tcp_from_object.translation.y() += compliance_shift_;
  const GripContact contact = gripContact(*part.mesh, tcp_from_object, pads_, width_ + kSkin);
  if (!contact.low.touched) return {0, ""};
  const double high = contact.high.y, low = contact.low.y;

  double moved = 0;
  // The part goes where the pads push it, or else the pads give way a little.
  const auto yields = [&](double along_y) {
    if (push(object, along_y, world_from_tcp, bodies, outcome)) return true;
    const double shift_before = object == compliant_to_ ? compliance_shift_ : 0;
    compliant_to_ = object;
    compliance_shift_ = std::clamp(shift_before + along_y, -compliance_, compliance_);
    moved = compliance_shift_ - shift_before;
    if (moved != along_y) return false;
    outcome->jammed = -1;
    return true;
  };

  if (contact.width() >= next) {  // both pads
    if (yields(-(high + low) / 2))
      return {std::min(width_, contact.width()), gripWeakness(contact, friction_)};
  } else if (high > next / 2) {
    if (yields(next / 2 - high)) return {0, ""};
  } else if (low < -next / 2) {
    if (yields(-next / 2 - low)) return {0, ""};
  } else {
    return {0, ""};
  }

  return {std::min(width_, 2 * std::max(high + moved, -low - moved)),
          "the part cannot move, and only one pad meets it"};
}

double CellGripper::close(double next, const Rigid3& world_from_tcp, const CellBodies& bodies,
                          Outcome* outcome) {
  int stopped_by = -1;
  Stop stop{next, ""};
  for (size_t k = 0; k < bodies.objects->size(); ++k) {
    if ((*bodies.absent)[k]) continue;
    const Stop here = meet(int(k), next, world_from_tcp, bodies, outcome);
    if (here.width > stop.width || (stopped_by < 0 && here.width >= next)) {
      stop = here;
      stopped_by = int(k);
    }
  }

  if (stopped_by < 0) {
    stalled_by_ = -1;
    return next;
  }

  if (stop.reason.empty()) {
    held_ = outcome->grasped = stopped_by;
    tcp_from_held_ = world_from_tcp.inverse() * (*bodies.objects)[size_t(stopped_by)].world_from_object;
    stalled_by_ = -1;
  } else if (stalled_by_ != stopped_by) {
    stalled_by_ = outcome->slipped = stopped_by;
    outcome->reason = stop.reason;
  }
  return stop.width;
}

void CellGripper::lose(int object) {
  if (held_ == object) held_ = -1;
  if (stalled_by_ == object) stalled_by_ = -1;
  if (compliant_to_ == object) compliant_to_ = -1;
}

CellGripper::Outcome CellGripper::step(double dt, const Rigid3& world_from_tcp, const CellBodies& bodies) {
  Outcome outcome;
  const double before = width_;

  if (target_ > width_) {
    stalled_by_ = compliant_to_ = -1;
    width_ = std::min(target_, width_ + speed_ * dt);
    if (held_ >= 0 && width_ - before > 0) {
      open_ += width_ - before;
      if (open_ > kReleaseGap) {
        outcome.released = held_;
        held_ = -1;
      }
    }
  } else if (target_ < width_ && held_ < 0) {
    width_ = close(std::max(target_, width_ - speed_ * dt), world_from_tcp, bodies, &outcome);
    open_ = 0;
  }

  velocity_ = dt > 0 ? (width_ - before) / dt : 0;
  return outcome;
}

}  // namespace monocular_eye_hand
