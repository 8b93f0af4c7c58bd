#pragma once
#include <vector>

#include "recognition/candidate.h"
#include "recognition/decision.h"
#include "recognition/search_task.h"
#include "recognition/stage_log.h"

namespace monocular_eye_hand {

/// Wong et al., 2.4: the pose of each chosen candidate that may still be reported is calculated anew from the
/// best four of its constellation of corners and aligned again; it replaces the candidate's when evidence and
/// probability gain by it. The candidates keep their order.
std::vector<Candidate> recalculateBestFour(const SearchTask& task, Explained all, StageLog* log);

}  // namespace monocular_eye_hand
