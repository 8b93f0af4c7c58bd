#include "recognition/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace monocular_eye_hand {
namespace {

constexpr double kOtherPose = 10.0;  // poses farther apart than this in the image are really different [px]
// Of the better one's evidence and probability together; with less, by far, a rival is but a part of it.
constexpr double kTwin = 0.85;

constexpr size_t kWords = 3;            // terms told for and against
constexpr double kWorthTelling = 0.15;  // log-odds

std::string percent(double share) { return fmt::format("{} %", int(std::lround(100 * share))); }

std::vector<TermContribution> weighed(const SearchTask& task, const Candidate& candidate) {
  std::vector<TermContribution> terms =
      contributions(decisionValues(candidate.terms), candidate.lead, task.options.decision);
  if (candidate.support.log_odds == 0) return terms;

  const TermContribution support{"share of a rest on the support plane",
                                 task.options.decision.lead.own * candidate.support.log_odds,
                                 candidate.support.rests, 0};
  const auto weaker = [](const TermContribution& a, const TermContribution& b) {
    return a.log_odds > b.log_odds;
  };
  terms.insert(std::upper_bound(terms.begin(), terms.end(), support, weaker), support);
  return terms;
}

// The strongest terms for (or against) the candidate, in words.
std::vector<std::string> strongest(std::vector<TermContribution> contributions, bool against) {
  if (against) std::reverse(contributions.begin(), contributions.end());
  std::vector<std::string> words;
  for (const TermContribution& c : contributions) {
    const double strength = against ? -c.log_odds : c.log_odds;
    if (words.size() == kWords || strength < kWorthTelling) break;
    words.push_back(inWords(c));
  }
  return words;
}

std::string whyDecided(const Verdict& verdict, const Candidate& best, double accept_probability) {
  switch (verdict.decision) {
    case Decision::kRejected: {
      if (!best.support.refused.empty()) return best.support.refused;

      std::string reason = fmt::format("probability {:g} below {:g}",
                                       std::round(100 * best.probability) / 100, accept_probability);
      const char* separator = ": ";
      for (const std::string& words : verdict.spoke_against) {
        reason += separator + words;
        separator = "; ";
      }
      return reason;
    }
    case Decision::kAmbiguous:
      return fmt::format("{} other pose(s) or object(s) explain the same part of the image as well",
                         verdict.alternatives.size());
    case Decision::kAccepted:
      break;
  }
  return fmt::format("{} of {} visible features found, {} of the contour", best.matched_features,
                     int(best.terms.groups), percent(best.terms.hit_ratio));
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
    twin = twin || rival.terms.sum * rival.probability > kTwin * best.terms.sum * best.probability;
  }

  if (best.probability < task.options.accept_probability)
    verdict.decision = Decision::kRejected;
  else
    verdict.decision = twin ? Decision::kAmbiguous : Decision::kAccepted;
  const std::vector<TermContribution> terms = weighed(task, best);
  verdict.spoke_for = strongest(terms, false);
  verdict.spoke_against = strongest(terms, true);
  verdict.reason = whyDecided(verdict, best, task.options.accept_probability);
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

std::string strongestAgainst(const SearchTask& task, const Candidate& candidate) {
  const TermContribution last = weighed(task, candidate).back();
  return -last.log_odds < kWorthTelling ? "" : last.words;
}

}  // namespace monocular_eye_hand
