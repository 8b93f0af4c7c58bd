#include "monocular_eye_hand/recognition/decision_weights.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "decision_yaml.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/options/options.h"

namespace monocular_eye_hand {

double DecisionWeights::probability(const std::vector<double>& values) const {
  double log_odds = bias;
  for (size_t k = 0; k < terms.size(); ++k) log_odds += terms[k].weight * values[k];
  return 1 / (1 + std::exp(-std::clamp(log_odds, -50.0, 50.0)));
}

void DecisionWeights::check() const {
  if (!std::isfinite(bias)) throw BadInput("decision: bias is not finite");
  for (size_t k = 0; k < terms.size(); ++k)
    if (!std::isfinite(terms[k].weight) || !std::isfinite(terms[k].typical))
      throw BadInput(std::string("decision: ") + decisionTerms()[k].name + " is not finite");
}

std::vector<TermContribution> contributions(const std::vector<double>& values,
                                            const DecisionWeights& weights) {
  std::vector<TermContribution> all;
  for (size_t k = 0; k < values.size(); ++k) {
    const auto& [weight, typical] = weights.terms[k];
    all.push_back({int(k), weight * (values[k] - typical), values[k], typical});
  }
  std::stable_sort(all.begin(), all.end(), [](const TermContribution& a, const TermContribution& b) {
    return a.log_odds > b.log_odds;
  });
  return all;
}

std::string inWords(const TermContribution& c) {
  char numbers[60];
  std::snprintf(numbers, sizeof numbers, " %.2f (usually %.2f)", c.value, c.typical);
  return decisionTerms()[size_t(c.term)].words + std::string(numbers);
}

DecisionWeights fittedWeights() {
  static const DecisionWeights fitted = [] {
    DecisionWeights weights;
    readOptions(parseYaml(kDecisionYaml, "config/decision.yaml"), &weights);
    return weights;
  }();
  return fitted;
}

}  // namespace monocular_eye_hand
