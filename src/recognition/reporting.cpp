#include "recognition/reporting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace monocular_eye_hand {
namespace {

// Weights of the view's features that were found, and of those that it shows.
double matchedWeight(const SearchModel& model, const Candidate& candidate) {
  const ViewSphere& sphere = model.object().views;
  const int index = sphere.views[candidate.view].characteristic_view;
  if (index < 0) return candidate.terms.hit_ratio;
  const CharacteristicView& view = sphere.characteristic[index];
  double matched = 0, expected = 0;
  for (size_t i = 0; i < view.features.size(); ++i) {
    int samples = 0, hits = 0;
    for (const SeenSample& s : candidate.contour)
      if (s.feature == view.features[i] && s.inside) {
        ++samples;
        hits += s.edge_point >= 0;
      }
    if (samples == 0) continue;
    expected += view.weight[i];
    matched += view.weight[i] * hits / samples;
  }
  return expected > 0 ? matched / expected : 0;
}

// Wong et al., 2.4: back-projection error, matched features and their weights in one criterion.
double plausibility(double matched_weight, const EvidenceTerms& terms) {
  return matched_weight * std::exp(-0.5 * terms.rms * terms.rms);
}

// ... and how much of the pose's support is free of contradiction.
double reliability(double matched_weight, const EvidenceTerms& terms) {
  return matched_weight * (1 - terms.unsupported) * (1 - 0.5 * terms.continuation);
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

cv::Rect enlarged(const cv::Rect& box, double scale) {
  return {int(box.x * scale), int(box.y * scale), int(box.width * scale), int(box.height * scale)};
}

// Numbers for people: no "-0", no 7.7e-13.
double rounded(double value) { return std::round(value * 1e6) / 1e6 + 0.0; }

// A chosen candidate as it is reported.
ObjectEstimate reportObject(const SearchTask& task, const Candidate& candidate, const Verdict& verdict,
                            const FinePose& pose, double scale) {
  const SearchModel& model = task.models[candidate.object];
  const Symmetries& symmetries = model.model().symmetries;
  const double weight = matchedWeight(model, candidate);

  ObjectEstimate object;
  object.object = candidate.object;
  object.name = model.model().name;
  object.camera_from_object = pose.camera_from_object;
  object.covariance = pose.covariance;
  object.plausibility = plausibility(weight, candidate.terms);
  object.reliability = reliability(weight, candidate.terms);
  object.probability = candidate.probability;
  object.decision = verdict.decision;
  object.alternatives = verdict.alternatives;
  object.matched_features = candidate.matched_features;
  object.expected_features = int(candidate.terms.groups);
  object.matched_groupings = matchedGroupings(candidate, task.image.groupings, task.image.features);
  object.characteristic_view = model.object().views.views[candidate.view].characteristic_view;
  object.bounding_box = enlarged(candidate.bounding_box, scale);
  object.symmetry = describeSymmetry(symmetries);
  object.free_axis = symmetries.axis.has_value() || symmetries.sphere;
  object.reason = verdict.reason;
  object.spoke_for = verdict.spoke_for;
  object.spoke_against = verdict.spoke_against;
  object.evidence = candidate.terms.named();
  return object;
}

// A candidate as it is listed, all but its fate and its conflicts.
JudgedCandidate reportJudged(const SearchTask& task, const Candidate& candidate) {
  const SearchModel& model = task.models[candidate.object];
  const double weight = matchedWeight(model, candidate);

  JudgedCandidate judged;
  judged.object = candidate.object;
  judged.name = model.model().name;
  judged.kind = toString(candidate.kind);
  judged.camera_from_object = candidate.pose.camera_from_object;
  judged.plausibility = plausibility(weight, candidate.terms);
  judged.reliability = reliability(weight, candidate.terms);
  judged.probability = candidate.probability;
  judged.strongest_against = strongestAgainst(task, candidate);
  judged.evidence = candidate.terms.named();
  judged.rank_score = rankScore(candidate);
  judged.contests = candidate.contests;
  judged.winners_share = candidate.winners_share;
  return judged;
}

Fate fateOf(Decision decision) {
  switch (decision) {
    case Decision::kAccepted:
      return Fate::kAccepted;
    case Decision::kAmbiguous:
      return Fate::kAmbiguous;
    case Decision::kRejected:
      break;
  }
  return Fate::kRejected;
}

}  // namespace

std::string describeSymmetry(const Symmetries& symmetries) {
  if (symmetries.sphere) return "every orientation looks the same";
  std::string text;
  if (symmetries.axis) {
    const auto& a = *symmetries.axis;
    text = fmt::format("free about the axis ({:g}, {:g}, {:g}) through ({:g}, {:g}, {:g}) m",
                       rounded(a.direction.x()), rounded(a.direction.y()), rounded(a.direction.z()),
                       rounded(a.point.x()), rounded(a.point.y()), rounded(a.point.z()));
    if (symmetries.discrete.size() > 1) text += ", ";
  }
  if (symmetries.discrete.size() > 1) text += fmt::format("{} equal poses", symmetries.discrete.size());
  return text;
}

RecognitionResult reportObjects(const SearchTask& task, const SearchOutcome& outcome, double scale) {
  RecognitionResult result;
  for (size_t i = 0; i < outcome.chosen.size(); ++i) {
    const Candidate& candidate = outcome.candidates[outcome.chosen[i].candidate];
    ObjectEstimate object = reportObject(task, candidate, outcome.verdicts[i], outcome.poses[i], scale);
    (object.decision == Decision::kRejected ? result.rejected : result.objects).push_back(std::move(object));
  }

  const auto likelier = [](const ObjectEstimate& a, const ObjectEstimate& b) {
    return a.probability > b.probability;
  };
  std::stable_sort(result.objects.begin(), result.objects.end(), likelier);
  std::stable_sort(result.rejected.begin(), result.rejected.end(), likelier);
  return result;
}

std::vector<JudgedCandidate> listJudged(const SearchTask& task, const SearchOutcome& outcome) {
  std::vector<std::vector<int>> conflicts = allConflicts(outcome.candidates);
  std::vector<JudgedCandidate> judged;
  for (size_t i = 0; i < outcome.candidates.size(); ++i) {
    judged.push_back(reportJudged(task, outcome.candidates[i]));
    judged.back().conflicts = std::move(conflicts[i]);
  }

  for (size_t i = 0; i < outcome.chosen.size(); ++i) {
    const Explanation& explanation = outcome.chosen[i];
    JudgedCandidate& winner = judged[explanation.candidate];
    winner.fate = fateOf(outcome.verdicts[i].decision);
    winner.camera_from_object = outcome.poses[i].camera_from_object;
    for (int rival : explanation.rivals) judged[rival].suppressed_by = explanation.candidate;
  }
  return judged;
}

std::string whyNothing(const SearchTask& task, const SearchOutcome& outcome,
                       const RecognitionResult& result) {
  const FeatureSet& features = task.image.features;
  std::string reason;
  if (features.segments.empty() && features.ellipses.empty())
    reason = "no straight edge and no ellipse in the image: too dark, blurred or empty";
  else if (outcome.candidates.empty())
    reason = "no pose of a known object agrees with the edges of the image";
  else if (!result.rejected.empty())
    reason = "best candidate is " + result.rejected.front().name + ": " + result.rejected.front().reason;

  if (result.budget_spent)
    reason += fmt::format("; the budget of {} hypotheses was spent before all groupings were used",
                          task.options.budget);
  if (result.truncated) reason += "; the time limit cut the search";
  return reason;
}

}  // namespace monocular_eye_hand
