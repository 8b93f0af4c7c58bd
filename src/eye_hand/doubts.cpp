// How likely a thing is by all its views, and what becomes of candidates that recognition doubts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/eye_hand/object_map.h"

namespace monocular_eye_hand {
namespace {

// Of a probability by recognition, which is never sure.
double logOdds(double probability) {
  constexpr double kSure = 0.999;
  const double p = std::clamp(probability, 1 - kSure, kSure);
  return std::log(p / (1 - p));
}

double probabilityOf(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

}  // namespace

bool ObjectMap::doubtful(const Observation& seen) const {
  return seen.probability < options_.min_probability;
}

double ObjectMap::probability(const Track& track) const {
  const double best = track.merged.probability;
  return best >= options_.min_probability ? best : std::max(best, probabilityOf(track.evidence));
}

// From a camera place of its own: how much its agreement speaks for a thing.
double ObjectMap::support(const Observation& seen) const {
  return logOdds(seen.probability) + std::log(options_.agreement_odds);
}

// The first of them agrees with none before it.
double ObjectMap::evidenceOf(const std::vector<Observation>& agreeing) const {
  double evidence = -std::log(options_.agreement_odds);
  for (const Observation& seen : agreeing) evidence += support(seen);
  return evidence;
}

ViewDecision ObjectMap::begin(const Observation& seen, double stamp) {
  tracks_.push_back(newTrack(seen, stamp));
  Track& track = tracks_.back();
  track.object.number = next_doubtful_--;

  ViewDecision decision;
  decision.object = seen.object;
  decision.outcome = ViewOutcome::kDoubtful;
  decision.reason =
      fmt::format("probability {:.2f} is below min_probability {:g}: kept until other views agree",
                  seen.probability, options_.min_probability);
  believe(&track, &decision);
  if (track.believed) decision.reason = "no known " + track.object.name + " is there";
  return decision;
}

void ObjectMap::believe(Track* track, ViewDecision* decision) {
  if (track->believed || probability(*track) < options_.min_probability) return;
  track->believed = true;
  track->object.number = next_number_[size_t(track->object.object)]++;
  decision->outcome = ViewOutcome::kNew;
  decision->number = track->object.number;
  decision->reason =
      fmt::format("{} views together make it likely: {:.2f}", track->object.views, probability(*track));
}

// Both say that something of this name is there, and not how it lies.
ViewDecision ObjectMap::addDoubt(Track* track, const Observation& seen) const {
  ViewDecision decision;
  decision.object = seen.object;
  decision.number = track->believed ? track->object.number : -1;
  decision.outcome = ViewOutcome::kDoubtful;
  decision.reason = "it lies otherwise than in the doubtful view before";
  if (oneOf(track->base_from_cameras, seen.base_from_camera)) return decision;

  track->evidence += support(seen);
  track->base_from_cameras.push_back(seen.base_from_camera);
  if (seen.probability <= track->merged.probability) return decision;

  track->merged = seen;
  track->evidence = std::max(track->evidence, evidenceOf({seen}));  // misses were of the other pose
  return decision;
}

}  // namespace monocular_eye_hand
