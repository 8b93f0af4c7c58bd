#pragma once
#include <vector>

#include "recognition/candidate.h"
#include "recognition/decision.h"
#include "recognition/search_task.h"
#include "recognition/stage_log.h"

namespace monocular_eye_hand {

/// What surely recognised objects hide is not held against what lies behind them: candidates that such an
/// object partly covers, yet does not conflict with, are verified again without their hidden samples.
std::vector<Candidate> excuseHidden(const SearchTask& task, Explained all, StageLog* log);

}  // namespace monocular_eye_hand
