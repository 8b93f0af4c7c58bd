#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/recognition/decision_weights.h"

namespace monocular_eye_hand {

/// A judged candidate with known truth, as `evaluate --dump` writes it.
struct JudgedSample {
  std::string image;           ///< data set, scene and image: candidates of one image compete
  std::string part;            ///< name of the object: what is left out in turn
  std::string truth;           ///< of a right one: which instance; "" of a wrong one
  std::vector<double> values;  ///< one per decisionTerms()
  bool right = false;          ///< within kRightPixels of the truth
  int index = 0;               ///< among the candidates of its image
  std::vector<int> conflicts;  ///< indices of those that suppress it when they are chosen
  double rank_base = 0;        ///< rank score over probability + 0.05, as JudgedCandidate::rank_score tells
};

constexpr double kRightPixels = 10;  ///< largest image distance (MSPD) of a right candidate [px]

struct DecisionFitOptions {
  double ridge = 2;  ///< on weights of standardised terms; the bias is free
  int folds = 10;    ///< parts are dealt out to so many folds that are left out in turn
  void check() const;
};

/// Logistic regression by Newton's method. The right candidates of one instance, and the wrong ones of one
/// object in one image, are near copies of each other: each counts 1 / sqrt(n). Throws BadInput when there
/// are no right or no wrong candidates.
DecisionWeights fitDecision(const std::vector<JudgedSample>& samples, const DecisionFitOptions& options = {});

/// Probability of every sample by weights that have not seen its part.
std::vector<double> probabilitiesLeftOut(const std::vector<JudgedSample>& samples,
                                         const DecisionFitOptions& options = {});

/// The samples that would be chosen with these probabilities: no two of an image conflict, best rank first.
std::vector<size_t> chosenSamples(const std::vector<JudgedSample>& samples,
                                  const std::vector<double>& probabilities);

/// A choice favours the likely ones: among the chosen the share right is not that among all. Stretches and
/// shifts the log-odds so that the probability of the chosen is their share right (Platt 1999).
/// `left_out`: probabilitiesLeftOut() of the samples.
DecisionWeights calibratedOnChosen(DecisionWeights weights, const std::vector<JudgedSample>& samples,
                                   const std::vector<double>& left_out);

/// Expected calibration error: mean difference of probability and share right over `bins` of equal mass.
double calibrationError(const std::vector<double>& probabilities, const std::vector<JudgedSample>& samples,
                        int bins = 10);

}  // namespace monocular_eye_hand
