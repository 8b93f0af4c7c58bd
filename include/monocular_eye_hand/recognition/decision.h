#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/recognition/verification.h"

namespace monocular_eye_hand {

/// Weights of the evidence terms in the log-odds that a candidate is right. They were fitted by logistic
/// regression on candidates from rendered training scenes (scripts/fit_decision.py); see docs/pipeline.md.
struct DecisionWeights {
  double bias = -6.0;
  double log_sum = 1.6;
  double mean = 0.3;
  double hit_ratio = 2.0;
  double log_groups = 0.8;
  double unsupported = -2.0;
  double unsupported_length = -1.5;
  double continuation = -2.4;
  double interior = -1.5;
  double off_face = -3.0;
  double solidity = 0.5;
  double log_size = 0.0;
  double log_contrast = 0.0;
  double in_frame = 0.0;
  double rms = -0.5;

  template <class Visitor>
  void visit(Visitor&& v) {
    v("bias", bias);
    v("log_sum", log_sum);
    v("mean", mean);
    v("hit_ratio", hit_ratio);
    v("log_groups", log_groups);
    v("unsupported", unsupported);
    v("unsupported_length", unsupported_length);
    v("continuation", continuation);
    v("interior", interior);
    v("off_face", off_face);
    v("solidity", solidity);
    v("log_size", log_size);
    v("log_contrast", log_contrast);
    v("in_frame", in_frame);
    v("rms", rms);
  }
};

/// Calibrated probability that object and pose of the candidate are right.
double probability(const EvidenceTerms& terms, const DecisionWeights& weights);

/// Order among explanations of the same part of the image: total evidence, discounted by what contradicts it.
double rankScore(const EvidenceTerms& terms);

/// A chosen candidate and the others that explain the same part of the image.
struct Explanation {
  int candidate = 0;
  std::vector<int> rivals;  ///< suppressed candidates, best first
};

/// Chooses candidates so that no two explain the same part of the image: best rank first; one whose faces
/// overlap a chosen one's, or whose edge points are mostly claimed already, becomes its rival.
std::vector<Explanation> chooseExplanations(const std::vector<Candidate>& candidates);

}  // namespace monocular_eye_hand
