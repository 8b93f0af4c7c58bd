#include "monocular_eye_hand/eye_hand/object_map.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "eye_hand/expected.h"
#include "monocular_eye_hand/geometry/covariance.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/seconds_text.h"
#include "monocular_eye_hand/model/equal_poses.h"
#include "monocular_eye_hand/model/free_turns.h"
#include "monocular_eye_hand/model/same_place.h"

namespace monocular_eye_hand {
namespace {

std::string label(const MappedObject& object) { return fmt::format("{} {}", object.name, object.number); }

void checkView(const ObjectView& view, const ModelBase& models) {
  if (!std::isfinite(view.stamp)) throw BadInput("the view's stamp is not finite");
  view.camera.check();
  requirePose(view.hand.base_from_tool0, "base_from_tool0");
  if (!view.hand.jacobian.allFinite()) throw BadInput("the arm's Jacobian is not finite");
  requirePose(view.hand_eye.tool0_from_camera, "tool0_from_camera");
  requireCovariance(view.hand_eye.covariance, "covariance of tool0_from_camera");
  for (const SeenObject& seen : view.objects) {
    if (seen.object < 0 || seen.object >= int(models.objects.size()))
      throw BadInput(fmt::format(
          "object {} is not in the model base ({}); recognition and eye-hand must load the same one",
          seen.object, models.names()));
    const std::string& name = models.objects[size_t(seen.object)].model.name;
    requirePose(seen.camera_from_object, ("camera_from_object of " + name).c_str());
    requireCovariance(seen.covariance, ("covariance of " + name).c_str());
    if (!(seen.probability >= 0 && seen.probability <= 1))
      throw BadInput(fmt::format("probability of {} = {:g} must be between 0 and 1", name, seen.probability));
  }
}

}  // namespace

ObjectMap::ObjectMap(const ModelBase* models, const ObjectMapOptions& options)
    : models_(models), options_(options) {
  options.check();
  next_number_.assign(models->objects.size(), 0);
}

ViewReport ObjectMap::add(const ObjectView& view) {
  checkView(view, *models_);
  ViewReport report;
  report.decisions.resize(view.objects.size());
  for (size_t i = 0; i < view.objects.size(); ++i) report.decisions[i].object = view.objects[i].object;
  if (any_view_ && view.stamp <= last_stamp_) {
    report.refused = "the view of " + secondsText(view.stamp) + " is not newer than the last one of " +
                     secondsText(last_stamp_) + "; clear the map when time starts again";
    for (ViewDecision& decision : report.decisions) decision.reason = report.refused;
    return report;
  }

  any_view_ = true;
  last_stamp_ = view.stamp;
  hand_eye_covariance_ = view.hand_eye.covariance.isZero(0)
                             ? handEye(view.hand_eye.tool0_from_camera, options_.hand_eye).covariance
                             : view.hand_eye.covariance;

  std::vector<Observation> observations, impossible_observations;
  std::vector<size_t> source;
  for (size_t i = 0; i < view.objects.size(); ++i) {
    if (view.objects[i].probability < options_.doubtful_probability) {
      report.decisions[i].reason = fmt::format("probability {:.2g} is below doubtful_probability {:g}",
                                               view.objects[i].probability, options_.doubtful_probability);
      continue;
    }
    const Observation seen = observationOf(view, view.objects[i]);
    if (const std::string why = impossible(seen, view.known); !why.empty()) {
      report.decisions[i].reason = why;
      report.decisions[i].impossible = true;
      if (!doubtful(seen)) impossible_observations.push_back(seen);
      continue;
    }
    observations.push_back(seen);
    source.push_back(i);
  }

  std::vector<double> chi_squares;
  const std::vector<int> track_of = associate(observations, &chi_squares);
  std::vector<char> updated(tracks_.size(), 0);
  // A known object that is located badly once is not missed.
  for (const Observation& seen : impossible_observations)
    for (size_t t = 0; t < tracks_.size(); ++t)
      if (tracks_[t].object.object == seen.object && samePlace(tracks_[t].merged, seen)) updated[t] = 1;

  for (size_t k = 0; k < observations.size(); ++k) {
    ViewDecision& decision = report.decisions[source[k]];
    if (track_of[k] < 0) {
      decision = begin(observations[k], view.stamp);
      updated.push_back(1);
      continue;
    }

    Track* track = &tracks_[size_t(track_of[k])];
    decision = update(track, observations[k], chi_squares[k], view.stamp);
    if (decision.outcome == ViewOutcome::kRefused) continue;
    updated[size_t(track_of[k])] = 1;
    believe(track, &decision);
  }

  findRivals();
  countMisses(view, updated, &report);
  for (Track& track : tracks_) publish(&track);
  resolveConflicts();

  for (ViewDecision& decision : report.decisions)
    for (const Track& track : tracks_)
      if (track.key() == Key(decision.object, decision.number) && track.suppressed_by)
        decision.reason += fmt::format("; not told, since {} {} is there",
                                       models_->objects[size_t(track.suppressed_by->first)].model.name,
                                       track.suppressed_by->second);
  return report;
}

void ObjectMap::addFloor(Matrix6d* covariance) const {
  covariance->diagonal().head<3>().array() += options_.floor_position * options_.floor_position;
  covariance->diagonal().tail<3>().array() += options_.floor_rotation * options_.floor_rotation;
}

ObjectMap::Observation ObjectMap::observationOf(const ObjectView& view, const SeenObject& seen) const {
  const Chain c = chain(view.hand.base_from_tool0, view.hand_eye.tool0_from_camera, seen.camera_from_object);
  Observation s;
  s.object = seen.object;
  s.probability = seen.probability;
  s.base_from_object = c.base_from_object;
  s.base_from_camera = view.hand.base_from_tool0 * view.hand_eye.tool0_from_camera;
  s.image = propagate(c.image, seen.covariance);
  addFloor(&s.image);
  s.image = conditionedOnFreeAxis(model(s.object), s.base_from_object, s.image);
  s.hand_eye = c.hand_eye;
  s.joints = c.arm * view.hand.jacobian;
  return s;
}

ObjectMap::Observation ObjectMap::equalObservation(const Observation& observation,
                                                   const Rigid3& wanted) const {
  Observation equal = observation;
  equal.base_from_object = nearestEqualPose(model(observation.object), observation.base_from_object, wanted);
  // A symmetry may move the object frame's origin, about which the rotations are taken.
  const Matrix6d moved =
      adjointOfTranslation(equal.base_from_object.translation - observation.base_from_object.translation);
  equal.image = propagate(moved, observation.image);
  equal.hand_eye = moved * observation.hand_eye;
  equal.joints = moved * observation.joints;
  return equal;
}

Eigen::Vector3d ObjectMap::centreOffset(const Observation& a, const Observation& b) const {
  const Rigid3 equal = equalObservation(b, a.base_from_object).base_from_object;
  return monocular_eye_hand::centreOffset(model(a.object).centre(), a.base_from_object, equal);
}

double ObjectMap::chiSquare(const Observation& a, const Observation& b) const {
  const Observation equal = equalObservation(b, a.base_from_object);
  const Vector6d gap = difference(a.base_from_object, equal.base_from_object);
  // Common errors cancel as far as both views see them alike.
  const Vector6d sigma = Eigen::Map<const Vector6d>(options_.arm.joint_sigma.data());
  Matrix6d spread = a.image + equal.image + propagate(a.hand_eye - equal.hand_eye, hand_eye_covariance_) +
                    propagate(a.joints - equal.joints, Matrix6d(sigma.cwiseAbs2().asDiagonal()));
  spread.diagonal().head<3>().array() += 2 * options_.arm.position_sigma * options_.arm.position_sigma;
  spread = withFreeAxisVariance(model(a.object), a.base_from_object, spread);
  return gap.dot(spread.ldlt().solve(gap));
}

bool ObjectMap::samePlace(const Observation& a, const Observation& b) const {
  const Rigid3 equal = equalObservation(b, a.base_from_object).base_from_object;
  const Eigen::Vector3d centre = model(a.object).centre();
  const Eigen::Vector3d reach = options_.same_place * model(a.object).bounds.sizes();
  // What things lie in is hollow: another of its size would have to go through its walls.
  if (models_->objects[size_t(a.object)].handling.obstacle)
    return monocular_eye_hand::samePlace(centre, a.base_from_object, equal, reach);
  return monocular_eye_hand::samePlace(centre, a.base_from_object, equal, reach.minCoeff());
}

std::vector<int> ObjectMap::associate(const std::vector<Observation>& observations,
                                      std::vector<double>* chi_squares) const {
  std::vector<std::tuple<bool, bool, double, size_t, size_t>>
      pairs;  // outside the gate, a doubtful track, chi square, track, observation
  for (size_t t = 0; t < tracks_.size(); ++t) {
    const Observation& known = tracks_[t].merged;
    const bool unsure = doubtful(known);
    for (size_t k = 0; k < observations.size(); ++k) {
      if (observations[k].object != known.object) continue;
      const double chi_square = chiSquare(known, observations[k]);
      const bool outside = !(chi_square <= options_.gate);
      if (samePlace(known, observations[k]) ||
          (!outside && centreOffset(known, observations[k]).norm() <= options_.max_distance))
        pairs.emplace_back(outside, unsure, chi_square, t, k);
    }
  }

  std::sort(pairs.begin(), pairs.end());
  std::vector<int> track_of(observations.size(), -1);
  std::vector<char> taken(tracks_.size(), 0);
  chi_squares->assign(observations.size(), -1);
  for (const auto& [outside, unsure, chi_square, t, k] : pairs) {
    if (taken[t] || track_of[k] >= 0) continue;
    taken[t] = 1;
    track_of[k] = int(t);
    (*chi_squares)[k] = chi_square;
  }
  return track_of;
}

ViewDecision ObjectMap::update(Track* track, const Observation& seen, double chi_square, double stamp) const {
  if (!(chi_square <= options_.gate)) return handleOutlier(track, seen, chi_square, stamp);
  ViewDecision decision;
  decision.object = seen.object;
  decision.number = track->believed ? track->object.number : -1;
  decision.chi_square = chi_square;
  track->outliers.clear();
  track->object.misses = 0;
  track->missed_from.clear();
  if (!doubtful(seen)) track->object.last_stamp = stamp;
  track->merged.probability = std::max(track->merged.probability, seen.probability);

  // So many places say all that views can say: what is left is common to them.
  const bool same_camera = int(track->base_from_cameras.size()) >= options_.max_views ||
                           oneOf(track->base_from_cameras, seen.base_from_camera);

  if (same_camera) {
    decision.outcome = ViewOutcome::kSeenAgain;
    decision.reason = "seen from this camera place already, or from enough of them: it tells nothing new";
  } else {
    merge(track, equalObservation(seen, track->merged.base_from_object));
    decision.outcome = ViewOutcome::kMerged;
    decision.reason = "agrees with " + label(track->object);
  }
  if (!track->believed) {
    decision.outcome = ViewOutcome::kDoubtful;
    decision.reason =
        fmt::format("{} views together: probability {:.2f}", track->object.views, probability(*track));
  }
  return decision;
}

ViewDecision ObjectMap::handleOutlier(Track* track, const Observation& seen, double chi_square,
                                      double stamp) const {
  ViewDecision decision;
  decision.object = seen.object;
  decision.number = track->object.number;
  decision.chi_square = chi_square;
  const std::string text = fmt::format("chi-square {:g} against {} is above the gate of {:g}", chi_square,
                                       label(track->object), options_.gate);
  if (doubtful(seen)) {
    if (doubtful(track->merged)) return addDoubt(track, seen);
    decision.reason = text + ", and recognition doubts it";
    return decision;
  }

  const auto disagrees = [&](const Observation& other) { return !(chiSquare(other, seen) <= options_.gate); };
  if (std::any_of(track->outliers.begin(), track->outliers.end(), disagrees)) track->outliers.clear();
  if (isNewEvidence(*track, seen.base_from_camera, placesOf(track->outliers)))
    track->outliers.push_back(seen);
  track->object.misses = 0;  // something of this name is there
  track->missed_from.clear();

  const bool surer = doubtful(track->merged) || evidenceOf(track->outliers) > track->evidence;
  if (int(track->outliers.size()) < options_.outliers_to_restart && !surer) {
    decision.outcome = ViewOutcome::kOutlier;
    decision.reason = text;
    return decision;
  }

  Track restarted = newTrack(seen, stamp);
  restarted.object.number = track->object.number;
  restarted.believed = track->believed;
  *track = std::move(restarted);
  decision.outcome = ViewOutcome::kRestarted;
  decision.reason = text + (surer ? "; what speaks for the new pose is more than what spoke for the old one"
                                  : "; so many views in a row agree on another pose: it was moved");
  return decision;
}

ObjectMap::Track ObjectMap::newTrack(const Observation& seen, double stamp) const {
  Track track;
  const ObjectModel& shape = model(seen.object);
  track.merged = seen;
  track.object.object = seen.object;
  track.object.name = shape.name;
  track.object.free_axis = shape.symmetries.axis.has_value() || shape.symmetries.sphere;
  track.object.views = 1;
  track.object.first_stamp = track.object.last_stamp = stamp;
  track.base_from_cameras = {seen.base_from_camera};
  track.evidence = evidenceOf({seen});
  return track;
}

void ObjectMap::merge(Track* track, const Observation& seen) const {
  const ObjectModel& shape = model(seen.object);
  Observation& merged = track->merged;
  // Free angles agree by choice of the equal pose; freed, they keep the sum invertible.
  const Matrix6d known = withFreeAxisVariance(shape, merged.base_from_object, merged.image);
  const Matrix6d sum = known + withFreeAxisVariance(shape, seen.base_from_object, seen.image);
  const Matrix6d gain = sum.ldlt().solve(known).transpose();
  const Matrix6d rest = Matrix6d::Identity() - gain;
  Rigid3& pose = merged.base_from_object;
  pose = perturbed(pose, gain * difference(pose, seen.base_from_object));
  pose.rotation = nearestRotation(pose.rotation);
  merged.image =
      conditionedOnFreeAxis(shape, pose, propagate(rest, merged.image) + propagate(gain, seen.image));
  merged.hand_eye = rest * merged.hand_eye + gain * seen.hand_eye;
  merged.joints = rest * merged.joints + gain * seen.joints;
  track->base_from_cameras.push_back(seen.base_from_camera);
  track->evidence += support(seen);
  ++track->object.views;
}

Matrix6d ObjectMap::totalCovariance(const Observation& seen) const {
  const Vector6d sigma = Eigen::Map<const Vector6d>(options_.arm.joint_sigma.data());
  Matrix6d total = seen.image + propagate(seen.hand_eye, hand_eye_covariance_) +
                   propagate(seen.joints, Matrix6d(sigma.cwiseAbs2().asDiagonal()));
  total.diagonal().head<3>().array() += options_.arm.position_sigma * options_.arm.position_sigma;
  return total;
}

std::string ObjectMap::impossible(const Observation& seen, const KnownSpace& known) {
  return reachesIntoKnown(model(seen.object), core(seen.object), seen.base_from_object, totalCovariance(seen),
                          known, {options_.known_depth, options_.known_sigmas});
}

void ObjectMap::publish(Track* track) const {
  MappedObject& object = track->object;
  const Observation& merged = track->merged;
  const ObjectModel& shape = model(object.object);
  Matrix6d total = totalCovariance(merged);
  addFloor(&total);  // what CAD and part differ by is the same in every view
  object.base_from_object = merged.base_from_object;
  object.probability = probability(*track);
  object.covariance = withFreeAxisVariance(shape, object.base_from_object, total);
  object.image_covariance = withFreeAxisVariance(shape, object.base_from_object, merged.image);
  object.outliers = int(track->outliers.size());
}

// A rival hides nothing: only one of the two is there.
bool ObjectMap::expected(const Track& track, const ObjectView& view) const {
  std::vector<PlacedModel> placed{{&model(track.object.object), track.merged.base_from_object}};
  for (const Track& other : tracks_) {
    const bool rival = std::find(track.rivals.begin(), track.rivals.end(), other.key()) != track.rivals.end();
    if (&other != &track && !rival && other.believed)
      placed.push_back({&model(other.object.object), other.merged.base_from_object});
  }
  const Rigid3 base_from_camera = view.hand.base_from_tool0 * view.hand_eye.tool0_from_camera;
  return expectedInView(placed, 0, view.camera, base_from_camera, options_);
}

bool ObjectMap::oneOf(const std::vector<Rigid3>& base_from_cameras, const Rigid3& base_from_camera) const {
  return std::any_of(base_from_cameras.begin(), base_from_cameras.end(), [&](const Rigid3& other) {
    return (other.translation - base_from_camera.translation).norm() <= options_.min_motion &&
           angleBetween(other.rotation, base_from_camera.rotation) <= options_.min_rotation;
  });
}

std::vector<Rigid3> ObjectMap::placesOf(const std::vector<Observation>& observations) {
  std::vector<Rigid3> base_from_cameras;
  for (const Observation& observation : observations)
    base_from_cameras.push_back(observation.base_from_camera);
  return base_from_cameras;
}

bool ObjectMap::isNewEvidence(const Track& track, const Rigid3& base_from_camera,
                              const std::vector<Rigid3>& counted_from) const {
  return oneOf(track.base_from_cameras, base_from_camera) || !oneOf(counted_from, base_from_camera);
}

void ObjectMap::countMisses(const ObjectView& view, const std::vector<char>& updated, ViewReport* report) {
  if (!view.complete) return;
  const Rigid3 base_from_camera = view.hand.base_from_tool0 * view.hand_eye.tool0_from_camera;
  std::vector<char> missed(tracks_.size());
  for (size_t t = 0; t < tracks_.size(); ++t) {
    const Track& track = tracks_[t];
    missed[t] =
        !updated[t] && isNewEvidence(track, base_from_camera, track.missed_from) && expected(track, view);
  }

  std::vector<Track> kept;
  for (size_t t = 0; t < tracks_.size(); ++t) {
    Track& track = tracks_[t];
    track.object.misses += missed[t];
    track.missed += missed[t];
    if (!track.believed && missed[t]) track.evidence -= std::log(options_.agreement_odds);
    if (missed[t]) track.missed_from.push_back(base_from_camera);
    if (track.object.misses >= options_.forget_after_misses) {
      publish(&track);
      if (track.told()) report->forgotten.push_back(track.object);
    } else {
      kept.push_back(std::move(track));
    }
  }
  tracks_ = std::move(kept);
}

std::vector<MappedObject> ObjectMap::objects() const {
  std::vector<MappedObject> objects;
  for (const Track& track : tracks_)
    if (track.told()) objects.push_back(track.object);
  std::sort(objects.begin(), objects.end(), [](const MappedObject& a, const MappedObject& b) {
    return std::tie(a.object, a.number) < std::tie(b.object, b.number);
  });
  return objects;
}

bool ObjectMap::forget(int object, int number) {
  const auto wanted = [&](const Track& track) {
    return track.object.object == object && track.object.number == number;
  };
  const auto it = std::find_if(tracks_.begin(), tracks_.end(), wanted);
  if (it == tracks_.end()) return false;
  tracks_.erase(it);
  // What it suppressed was never there; if it is, the next view brings it again.
  const auto suppressed = [&](const Track& track) { return track.suppressed_by == Key(object, number); };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), suppressed), tracks_.end());
  return true;
}

void ObjectMap::clear() {
  tracks_.clear();
  std::fill(next_number_.begin(), next_number_.end(), 0);
  any_view_ = false;
}

}  // namespace monocular_eye_hand
