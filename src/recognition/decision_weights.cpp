#include "monocular_eye_hand/recognition/decision_weights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "decision_yaml.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/options/options.h"
#include "recognition/logistic.h"

namespace monocular_eye_hand {
namespace {

constexpr double kMaxLogOdds = 7;  // log-odds

}  // namespace

double DecisionWeights::logOdds(const std::vector<double>& values) const {
  double log_odds = bias;
  for (size_t k = 0; k < terms.size(); ++k) log_odds += terms[k].weight * values[k];
  return log_odds;
}

double DecisionWeights::probability(const std::vector<double>& values) const {
  return logistic(logOdds(values));
}

double DecisionWeights::logOdds(double log_odds, const Lead& ahead) const {
  return lead.bias + lead.own * log_odds + lead.over_most.weight * ahead.over_most +
         lead.elsewhere.weight * ahead.elsewhere + lead.in_place.weight * ahead.in_place;
}

double DecisionWeights::probability(double log_odds, const Lead& ahead) const {
  return logistic(std::min(kMaxLogOdds, logOdds(log_odds, ahead)));
}

void DecisionWeights::check() const {
  if (!std::isfinite(bias)) throw BadInput("decision: bias is not finite");
  for (size_t k = 0; k < terms.size(); ++k)
    if (!std::isfinite(terms[k].weight) || !std::isfinite(terms[k].typical))
      throw BadInput(std::string("decision: ") + decisionTerms()[k].name + " is not finite");
  for (double value :
       {lead.bias, lead.own, lead.over_most.weight, lead.over_most.typical, lead.elsewhere.weight,
        lead.elsewhere.typical, lead.in_place.weight, lead.in_place.typical})
    if (!std::isfinite(value)) throw BadInput("decision: a weight of lead is not finite");
  for (double value :
       {contest.log_odds, contest.precise, contest.contrast, contest.strength, contest.shading})
    if (!std::isfinite(value)) throw BadInput("decision: a weight of contest is not finite");
}

std::vector<TermContribution> contributions(const std::vector<double>& values, const Lead& lead,
                                            const DecisionWeights& weights) {
  std::vector<TermContribution> all;
  const auto add = [&](const char* words, const TermWeight& term, double value) {
    all.push_back({words, term.weight * (value - term.typical), value, term.typical});
  };
  for (size_t k = 0; k < values.size(); ++k) {
    add(decisionTerms()[k].words, weights.terms[k], values[k]);
    all.back().log_odds *= weights.lead.own;
  }
  add("lead over most other poses of it in log-odds", weights.lead.over_most, lead.over_most);
  add("lead over its best other places in log-odds", weights.lead.elsewhere, lead.elsewhere);
  add("lead over its other poses here in log-odds", weights.lead.in_place, lead.in_place);
  std::stable_sort(all.begin(), all.end(), [](const TermContribution& a, const TermContribution& b) {
    return a.log_odds > b.log_odds;
  });
  return all;
}

std::string inWords(const TermContribution& c) {
  return fmt::format("{} {:.2f} (usually {:.2f})", c.words, c.value, c.typical);
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
