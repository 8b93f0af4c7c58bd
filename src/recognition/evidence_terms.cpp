#include "monocular_eye_hand/recognition/evidence_terms.h"

namespace monocular_eye_hand {

std::map<std::string, double> EvidenceTerms::named() const {
  std::map<std::string, double> values;
  EvidenceTerms copy = *this;  // visit() is not const
  copy.visit([&](const char* name, double value) { values[name] = value; });
  return values;
}

EvidenceTerms evidenceTerms(const std::map<std::string, double>& named) {
  EvidenceTerms terms;
  terms.visit([&](const char* name, double& value) {
    const auto given = named.find(name);
    if (given != named.end()) value = given->second;
  });
  return terms;
}

}  // namespace monocular_eye_hand
