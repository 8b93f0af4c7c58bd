#include "recognition/reporting.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace monocular_eye_hand {
namespace {

constexpr double kOtherPose = 10.0;  // poses farther apart than this in the image are really different [px]

// Weights of the view's features that were found, and of those that it shows.
double matchedWeight(const SearchModel& model, const Candidate& candidate) {
  const ViewSphere& sphere = model.object().views;
  const int index = sphere.views[candidate.view].characteristic_view;
  if (index < 0) return candidate.terms.hit_ratio;
  const CharacteristicView& view = sphere.characteristic[index];
  double matched = 0, expected = 0;
  for (size_t i = 0; i < view.groups.size(); ++i) {
    int samples = 0, hits = 0;
    for (const SeenSample& s : candidate.contour)
      if (s.group == view.groups[i] && s.inside) ++samples, hits += s.edge_point >= 0;
    if (samples == 0) continue;
    expected += view.weight[i];
    matched += view.weight[i] * hits / samples;
  }
  return expected > 0 ? matched / expected : 0;
}

int matchedGroupings(const Candidate& candidate, const std::vector<Grouping>& groupings,
                     const FeatureSet& features) {
  const auto claims = [&](const LineSegment& segment) {
    const auto first = std::lower_bound(candidate.claimed.begin(), candidate.claimed.end(), segment.first);
    const auto last =
        std::lower_bound(candidate.claimed.begin(), candidate.claimed.end(), segment.first + segment.count);
    return double(last - first) * 6 > segment.count;  // samples stand every 4 px
  };
  int matched = 0;
  for (const Grouping& grouping : groupings) {
    if (grouping.segments.empty()) continue;
    matched += std::all_of(grouping.segments.begin(), grouping.segments.end(),
                           [&](int s) { return claims(features.segments[s]); });
  }
  return matched;
}

// Numbers for people: no "-0", no 7.7e-13.
double rounded(double value) { return std::round(value * 1e6) / 1e6 + 0.0; }

std::string percent(double share) { return std::to_string(int(std::lround(100 * share))) + " %"; }

std::string whatSpeaksAgainst(const EvidenceTerms& t) {
  std::vector<std::pair<double, std::string>> faults{
      {2.4 * t.continuation, "image edges run on past " + percent(t.continuation) + " of its corners"},
      {2.0 * t.unsupported, percent(t.unsupported) + " of its features have no edge under them"},
      {3.0 * t.off_face, percent(t.off_face) + " of its faces are not smoothly shaded"},
      {1.5 * t.interior, percent(t.interior) + " of its faces carry edges that it does not explain"},
      {1.5 * (1 - t.hit_ratio), "only " + percent(t.hit_ratio) + " of its contour is seen"}};
  std::stable_sort(faults.begin(), faults.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  return faults[0].second + "; " + faults[1].second;
}

}  // namespace

std::string describeSymmetry(const Symmetries& symmetries) {
  std::ostringstream text;
  if (symmetries.sphere) return "every orientation looks the same";
  if (symmetries.axis) {
    const auto& a = *symmetries.axis;
    text << "free about the axis (" << rounded(a.direction.x()) << ", " << rounded(a.direction.y()) << ", "
         << rounded(a.direction.z()) << ") through (" << rounded(a.point.x()) << ", " << rounded(a.point.y())
         << ", " << rounded(a.point.z()) << ") m";
    if (symmetries.discrete.size() > 1) text << ", ";
  }
  if (symmetries.discrete.size() > 1) text << symmetries.discrete.size() << " equal poses";
  return text.str();
}

ObjectEstimate reportObject(const std::vector<SearchModel>& models, const std::vector<Candidate>& candidates,
                            const Explanation& explanation, const RecognitionOptions& options,
                            const Camera& camera, const std::vector<Grouping>& groupings,
                            const FeatureSet& features) {
  const Candidate& best = candidates[explanation.candidate];
  const SearchModel& model = models[best.object];
  ObjectEstimate object;
  object.object = best.object;
  object.name = model.model().name;
  object.camera_from_object = best.pose.camera_from_object;
  object.covariance = best.pose.covariance;
  object.probability = best.probability;
  const double weight = matchedWeight(model, best);
  // Seed 2.4: back-projection error, matched features and their weights in one criterion.
  object.plausibility = weight * std::exp(-0.5 * best.terms.rms * best.terms.rms);
  // ... and how much of the pose's support is free of contradiction.
  object.reliability = weight * (1 - best.terms.unsupported) * (1 - 0.5 * best.terms.continuation);
  object.matched_features = best.matched_groups;
  object.expected_features = int(best.terms.groups);
  object.matched_groupings = matchedGroupings(best, groupings, features);
  object.characteristic_view = model.object().views.views[best.view].characteristic_view;
  object.bounding_box = best.bounding_box;
  object.symmetry = describeSymmetry(model.model().symmetries);
  object.free_axis = model.model().symmetries.axis.has_value() || model.model().symmetries.sphere;
  object.evidence = best.terms.named();

  bool twin = false;
  for (int r : explanation.rivals) {
    const Candidate& rival = candidates[r];
    if (rival.probability < options.ambiguous_ratio * best.probability) continue;
    const bool other =
        rival.object != best.object ||
        model.poseDistance(camera, rival.pose.camera_from_object, best.pose.camera_from_object) > kOtherPose;
    if (!other) continue;
    object.alternatives.push_back({rival.object, rival.pose.camera_from_object, rival.probability});
    // Less total evidence by far is a part of the better explanation, not a twin of it.
    twin = twin || rankScore(rival) > 0.85 * rankScore(best);
  }
  std::ostringstream reason;
  if (best.probability < options.accept_probability) {
    object.decision = Decision::kRejected;
    reason << "probability " << std::round(100 * best.probability) / 100 << " below "
           << options.accept_probability << ": " << whatSpeaksAgainst(best.terms);
  } else if (twin) {
    object.decision = Decision::kAmbiguous;
    reason << object.alternatives.size()
           << " other pose(s) or object(s) explain the same part of the image as well";
  } else {
    object.decision = Decision::kAccepted;
    reason << best.matched_groups << " of " << object.expected_features << " visible features found, "
           << percent(best.terms.hit_ratio) << " of the contour";
  }
  object.reason = reason.str();
  return object;
}

}  // namespace monocular_eye_hand
