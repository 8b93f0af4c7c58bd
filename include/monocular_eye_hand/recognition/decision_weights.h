#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/recognition/contest.h"
#include "monocular_eye_hand/recognition/decision_terms.h"
#include "monocular_eye_hand/recognition/lead.h"

namespace monocular_eye_hand {

/// How much a term of the decision counts.
struct TermWeight {
  double weight = 0;   ///< log-odds per unit of the term
  double typical = 0;  ///< mean of the term over the right candidates of the fit

  template <class Visitor>
  void visit(Visitor&& v) {
    v("weight", weight);
    v("typical", typical);
  }
};

/// How the candidate's own log-odds and its lead over the others make the log-odds in the end. The default
/// leaves them as they are.
struct LeadWeights {
  double bias = 0;
  double own = 1;  ///< on the log-odds by the candidate's evidence alone
  TermWeight over_most, elsewhere, in_place;

  template <class Visitor>
  void visit(Visitor&& v) {
    v("bias", bias);
    v("own", own);
    v("over_most", over_most);
    v("elsewhere", elsewhere);
    v("in_place", in_place);
  }
};

/// Weights of the evidence in the log-odds that a candidate is right: a logistic regression, first on what
/// speaks for the candidate alone, then on that and its lead over the others. They belong together: change
/// all of them by a new fit (tool fit_decision), or none.
struct DecisionWeights {
  std::string source;  ///< when and on what they were fitted
  double bias = 0;
  std::vector<TermWeight> terms = std::vector<TermWeight>(decisionTerms().size());  ///< as decisionTerms()

  LeadWeights lead;
  ContestWeights contest;

  /// Log-odds and probability that a candidate with these values (decisionValues) is right, looked at alone.
  double logOdds(const std::vector<double>& values) const;
  double probability(const std::vector<double>& values) const;
  /// ... looked at among the others of its object. `log_odds`: of its values alone. No probability is above
  /// 0.9991: no fit has seen enough to claim more.
  double logOdds(double log_odds, const Lead& ahead) const;
  double probability(double log_odds, const Lead& ahead) const;

  template <class Visitor>
  void visit(Visitor&& v) {
    v("source", source);
    v("bias", bias);
    for (size_t k = 0; k < terms.size(); ++k) v(decisionTerms()[k].name, terms[k]);
    v("lead", lead);
    v("contest", contest);
  }
  void check() const;  ///< throws BadInput naming a weight that is not finite
};

/// What a term adds to the log-odds of a candidate, compared with a typical right one.
struct TermContribution {
  const char* words = "";  ///< for people, as the subject of a sentence
  double log_odds = 0;
  double value = 0, typical = 0;
};

/// The contributions of all terms and of the lead, what speaks for the candidate first.
std::vector<TermContribution> contributions(const std::vector<double>& values, const Lead& lead,
                                            const DecisionWeights& weights);

/// "share of the contour with an edge under it 0.31 (usually 0.88)"
std::string inWords(const TermContribution& contribution);

/// config/decision.yaml as it was when the package was built.
DecisionWeights fittedWeights();

}  // namespace monocular_eye_hand
