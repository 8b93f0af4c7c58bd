#include "recognition/decision.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace monocular_eye_hand {
namespace {

constexpr double kMaxOverlap = 0.3;  // of the smaller drawing: explanations may not share more faces
constexpr double kEvidencePower =
    0.25;  // of the evidence in the rank: it settles what the probability leaves open
constexpr double kMaxClaimed = 0.5;  // share of edge points already claimed by better explanations

int commonCount(const std::vector<int>& a, const std::vector<int>& b) {
  int n = 0;
  for (size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] < b[j])
      ++i;
    else if (b[j] < a[i])
      ++j;
    else
      ++n, ++i, ++j;
  }
  return n;
}

}  // namespace

bool conflict(const Candidate& chosen, const Candidate& other) {
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

double probability(const EvidenceTerms& terms, const DecisionWeights& weights) {
  return weights.probability(decisionValues(terms));
}

double rankScore(const Candidate& candidate) {
  return std::pow(std::max(0.0, candidate.terms.sum), kEvidencePower) * (candidate.probability + 0.05);
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

}  // namespace monocular_eye_hand
