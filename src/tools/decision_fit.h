#pragma once
#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/recognition/decision_weights.h"

namespace monocular_eye_hand {

/// A judged candidate with known truth, as `evaluate --dump` writes it.
struct JudgedSample {
  std::string image;           ///< data set, scene and image: candidates of one image compete
  std::string part;            ///< name of the object: what is left out in turn
  std::string truth;           ///< of a right one: which instance; "" of a wrong one
  std::vector<double> values;  ///< one per decisionTerms()
  bool right = false;          ///< within kRightError (evaluation/outcomes.h) of the truth
  bool undecidable = false;    ///< wrong, but no image tells it from the truth: competes, but teaches nothing
  int index = 0;               ///< among the candidates of its image
  std::vector<int> conflicts;  ///< indices of those that suppress it when they are chosen
  std::vector<std::pair<int, PoseContest>> contests;  ///< as JudgedCandidate::contests
  double rank_base = 0;  ///< rank score over probability + 0.05, see JudgedCandidate::rank_score
};

struct DecisionFitOptions {
  double ridge = 6;  ///< on weights of standardised terms; the bias is free
  int folds = 10;    ///< parts are dealt out to so many folds that are left out in turn
  void check() const;
};

/// Logistic regression by Newton's method on what speaks for the candidates alone. The right candidates of
/// one instance, and the wrong ones of one object in one image, are near copies of each other: each counts 1
/// / sqrt(n). Throws BadInput when there are no right or no wrong candidates.
DecisionWeights fitDecision(const std::vector<JudgedSample>& samples, const DecisionFitOptions& options = {});

/// Log-odds of every sample by weights that have not seen its part.
std::vector<double> logOddsLeftOut(const std::vector<JudgedSample>& samples,
                                   const DecisionFitOptions& options = {});

/// The samples that would be chosen with these log-odds: no two of an image conflict, best rank first.
std::vector<size_t> chosenSamples(const std::vector<JudgedSample>& samples,
                                  const std::vector<double>& log_odds);

/// Lead of every sample over the others of its part in its image.
std::vector<Lead> leadsOf(const std::vector<JudgedSample>& samples, const std::vector<double>& log_odds);

/// How own log-odds and lead make the probability of the chosen: a choice favours the likely ones, so among
/// the chosen the share right is not that among all (Platt 1999, with the lead beside the log-odds).
/// `left_out`: logOddsLeftOut() of the samples.
LeadWeights fitLead(const std::vector<JudgedSample>& samples, const std::vector<double>& left_out);

/// A contest of a right pose with a wrong one, from the side of the right one.
struct DecidedContest {
  std::string part;
  PoseContest contest;
};
std::vector<DecidedContest> decidedContests(const std::vector<JudgedSample>& samples);

/// How what two poses draw differently tells which is right: logistic regression without a bias. The default
/// weights of no contests.
ContestWeights fitContest(const std::vector<DecidedContest>& contests);

}  // namespace monocular_eye_hand
