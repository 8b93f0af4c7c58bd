#pragma once
#include <vector>

#include "monocular_eye_hand/recognition/evidence_terms.h"

namespace monocular_eye_hand {

/// What the decision weighs: an evidence term, bounded so that it means the same for every part and image.
struct DecisionTerm {
  const char* name;   ///< key in config/decision.yaml
  const char* words;  ///< for people, as the subject of a sentence
  double (*value)(const EvidenceTerms&);
};

/// The terms in the order of DecisionWeights::terms.
const std::vector<DecisionTerm>& decisionTerms();

/// One value per term.
std::vector<double> decisionValues(const EvidenceTerms& evidence);

}  // namespace monocular_eye_hand
