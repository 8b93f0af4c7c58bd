#include "recognition/decision.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "recognition/logistic.h"

namespace monocular_eye_hand {
namespace {

constexpr double kMaxOverlap = 0.3;  // of the smaller drawing: explanations may not share more faces
// Log-odds of its own below which a candidate stays improbable whatever its lead: what it conflicts with is
// not looked up.
constexpr double kHopeless = -7;
constexpr double kMaxClaimed = 0.5;  // share of edge points already claimed by better explanations

int commonCount(const std::vector<int>& a, const std::vector<int>& b) {
  int n = 0;
  for (size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] < b[j]) {
      ++i;
    } else if (b[j] < a[i]) {
      ++j;
    } else {
      ++n;
      ++i;
      ++j;
    }
  }
  return n;
}

// Whether nothing that is drawn within one box can share cells or edge points with the other: neither box is
// known to be empty, and a cell lies between them.
bool farApart(const cv::Rect& a, const cv::Rect& b) {
  if (a.area() == 0 || b.area() == 0) return false;
  const cv::Rect wider(a.x - kCoverCell, a.y - kCoverCell, a.width + 2 * kCoverCell,
                       a.height + 2 * kCoverCell);
  return (wider & b).area() == 0;
}

constexpr double kModelsOfFit = 5;  // of each search that the weights were fitted to
constexpr double kFewer = 0.5;      // log-odds that a model loses when e times as many are known

}  // namespace

DecisionWeights amongModels(DecisionWeights weights, int models) {
  weights.lead.bias -= kFewer * std::log(std::max(1.0, models / kModelsOfFit));
  return weights;
}

bool conflict(const Candidate& chosen, const Candidate& other) {
  if (farApart(chosen.bounding_box, other.bounding_box)) return false;
  const size_t smaller = std::min(chosen.covered.size(), other.covered.size());
  if (smaller > 0 && commonCount(chosen.covered, other.covered) > kMaxOverlap * double(smaller)) return true;
  return !other.claimed.empty() &&
         commonCount(chosen.claimed, other.claimed) > kMaxClaimed * double(other.claimed.size());
}

std::vector<std::vector<int>> allConflicts(const std::vector<Candidate>& candidates) {
  std::vector<std::vector<int>> conflicts(candidates.size());
  for (size_t other = 0; other < candidates.size(); ++other)
    for (size_t chosen = 0; chosen < candidates.size(); ++chosen)
      if (chosen != other && conflict(candidates[chosen], candidates[other]))
        conflicts[other].push_back(int(chosen));
  return conflicts;
}

std::vector<Standing> standings(const std::vector<Candidate>& candidates, const DecisionWeights& weights) {
  std::vector<Competitor> competitors;
  competitors.reserve(candidates.size());
  for (const Candidate& candidate : candidates)
    competitors.push_back({candidate.object, ownLogOdds(candidate, weights), {}});
  const auto hopeless = [&](size_t i) { return competitors[i].log_odds < kHopeless; };
  for (size_t i = 0; i < candidates.size(); ++i)
    for (size_t other = i + 1; other < candidates.size(); ++other) {
      if (candidates[other].object != candidates[i].object || (hopeless(i) && hopeless(other))) continue;
      if (conflict(candidates[other], candidates[i]) || conflict(candidates[i], candidates[other]))
        competitors[i].conflicts.push_back(int(other));
    }

  std::vector<Standing> standings;
  for (const Lead& lead : leadsAmong(competitors)) {
    const double own = competitors[standings.size()].log_odds;
    standings.push_back({lead, weights.probability(own, lead)});
  }
  return standings;
}

std::vector<Candidate> weighAmongOthers(std::vector<Candidate> candidates, const DecisionWeights& weights) {
  const std::vector<Standing> all = standings(candidates, weights);
  for (size_t i = 0; i < candidates.size(); ++i) {
    candidates[i].lead = all[i].lead;
    candidates[i].probability = all[i].probability;
  }
  return candidates;
}

double ownLogOdds(const Candidate& candidate, const DecisionWeights& weights) {
  return weights.logOdds(decisionValues(candidate.terms)) + candidate.support.log_odds;
}

double ownProbability(const Candidate& candidate, const DecisionWeights& weights) {
  return logistic(ownLogOdds(candidate, weights));
}

double rankScore(const Candidate& candidate) {
  return std::sqrt(std::max(0.0, candidate.terms.sum)) *
         (candidate.probability / candidate.winners_share + 0.05);
}

std::vector<Explanation> chooseExplanations(const std::vector<Candidate>& candidates) {
  std::vector<int> order(candidates.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return rankScore(candidates[a]) > rankScore(candidates[b]); });

  std::vector<Explanation> chosen;
  for (int index : order) {
    Explanation* owner = nullptr;
    for (Explanation& e : chosen)
      if (conflict(candidates[e.candidate], candidates[index])) {
        owner = &e;
        break;
      }
    if (owner)
      owner->rivals.push_back(index);
    else
      chosen.push_back({index, {}});
  }
  return chosen;
}

Explained explained(std::vector<Candidate> candidates) {
  Explained all;
  all.chosen = chooseExplanations(candidates);
  all.candidates = std::move(candidates);
  return all;
}

}  // namespace monocular_eye_hand
