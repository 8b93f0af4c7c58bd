#include "grouping/candidates.h"

namespace monocular_eye_hand {

CandidateTable::CandidateTable(const ModelBase& models) {
  for (const KnownObject& object : models.objects) abilities_.push_back(abilitiesOf(object.model));
}

std::vector<int> CandidateTable::candidates(const Grouping& grouping) const {
  std::vector<int> result;
  for (int i = 0; i < int(abilities_.size()); ++i) {
    const Abilities& a = abilities_[i];
    if (!a.kind[int(grouping.kind)]) continue;
    if (grouping.kind == GroupingKind::kChain && grouping.shape == GroupingShape::kU && !a.u_chain) continue;
    if (grouping.kind == GroupingKind::kChain && grouping.shape == GroupingShape::kZ && !a.z_chain) continue;
    result.push_back(i);
  }
  return result;
}

}  // namespace monocular_eye_hand
