#pragma once
#include <vector>

#include "recognition/candidate.h"
#include "recognition/hypotheses.h"
#include "recognition/search_task.h"
#include "recognition/stage_log.h"
#include "recognition/work_budget.h"

namespace monocular_eye_hand {

/// Takes the `count` best hypotheses of `object` out of its pool, moves them onto the edges, verifies those
/// that end in different poses, the most telling first, and appends to `known` those that the image bears
/// out.
std::vector<Candidate> judgeHypotheses(const SearchTask& task, int object, HypothesisPool* pool, int count,
                                       std::vector<Candidate> known, WorkBudget* budget, StageLog* log);

}  // namespace monocular_eye_hand
