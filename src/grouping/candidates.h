#pragma once
#include <vector>

#include "grouping/model_structure.h"

namespace monocular_eye_hand {

/// Which known objects can produce what kind of grouping (Wong et al., eq. 1). Structure only, no visibility,
/// so that no true candidate is ever left out.
class CandidateTable {
 public:
  explicit CandidateTable(const ModelBase& models);
  std::vector<int> candidates(const Grouping& grouping) const;  ///< ascending

 private:
  std::vector<Abilities> abilities_;
};

}  // namespace monocular_eye_hand
