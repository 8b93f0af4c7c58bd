#pragma once
#include <vector>

#include "recognition/candidate.h"
#include "recognition/decision.h"
#include "recognition/hypotheses.h"
#include "recognition/search_task.h"
#include "recognition/stage_log.h"
#include "recognition/work_budget.h"

namespace monocular_eye_hand {

/// How far a search has come.
struct SearchState {
  std::vector<Candidate> candidates;  ///< in the order in which they were judged
  std::vector<HypothesisPool> pools;  ///< one per wanted model: hypotheses not taken yet
};

/// First round: hypotheses from pairs of image and model groupings, aligned and judged object by object.
/// `known`: candidates of other objects.
SearchState searchGroupings(const SearchTask& task, std::vector<Candidate> known, WorkBudget* budget,
                            StageLog* log);

/// Second round: hypotheses from single edges that no surely right explanation claims, with the view sphere.
/// `chosen`: the explanations among the candidates so far.
SearchState searchEdges(const SearchTask& task, SearchState state, const std::vector<Explanation>& chosen,
                        WorkBudget* budget, StageLog* log);

}  // namespace monocular_eye_hand
