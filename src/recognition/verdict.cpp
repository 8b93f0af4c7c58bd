#include "recognition/verdict.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace monocular_eye_hand {
namespace {

constexpr double kOtherPose = 10.0;  // poses farther apart than this in the image are really different [px]
constexpr double kTwin = 0.85;  // of the better one's rank; with less, by far, a rival is but a part of it

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

std::string whyDecided(Decision decision, const Candidate& best, size_t alternatives,
                       double accept_probability) {
  std::ostringstream reason;
  switch (decision) {
    case Decision::kRejected:
      reason << "probability " << std::round(100 * best.probability) / 100 << " below " << accept_probability
             << ": " << whatSpeaksAgainst(best.terms);
      break;
    case Decision::kAmbiguous:
      reason << alternatives << " other pose(s) or object(s) explain the same part of the image as well";
      break;
    case Decision::kAccepted:
      reason << best.matched_groups << " of " << int(best.terms.groups) << " visible features found, "
             << percent(best.terms.hit_ratio) << " of the contour";
      break;
  }
  return reason.str();
}

Verdict verdictOn(const SearchTask& task, const std::vector<Candidate>& candidates,
                  const Explanation& explanation) {
  const Candidate& best = candidates[explanation.candidate];
  const SearchModel& model = task.models[best.object];

  Verdict verdict;
  bool twin = false;
  for (int r : explanation.rivals) {
    const Candidate& rival = candidates[r];
    if (rival.probability < task.options.ambiguous_ratio * best.probability) continue;
    const bool other =
        rival.object != best.object || model.poseDistance(task.image.camera, rival.pose.camera_from_object,
                                                          best.pose.camera_from_object) > kOtherPose;
    if (!other) continue;
    verdict.alternatives.push_back({rival.object, rival.pose.camera_from_object, rival.probability});
    twin = twin || rankScore(rival) > kTwin * rankScore(best);
  }

  if (best.probability < task.options.accept_probability)
    verdict.decision = Decision::kRejected;
  else
    verdict.decision = twin ? Decision::kAmbiguous : Decision::kAccepted;
  verdict.reason =
      whyDecided(verdict.decision, best, verdict.alternatives.size(), task.options.accept_probability);
  return verdict;
}

}  // namespace

std::vector<Verdict> decide(const SearchTask& task, const std::vector<Candidate>& candidates,
                            const std::vector<Explanation>& chosen, StageLog* log) {
  return log->timed("decision", [&](StageReport* report) {
    std::vector<Verdict> verdicts;
    int rejected = 0;
    for (const Explanation& explanation : chosen) {
      verdicts.push_back(verdictOn(task, candidates, explanation));
      rejected += verdicts.back().decision == Decision::kRejected;
    }
    report->counts = {{"found", double(chosen.size()) - rejected}, {"rejected", double(rejected)}};
    return verdicts;
  });
}

}  // namespace monocular_eye_hand
