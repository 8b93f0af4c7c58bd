#pragma once
#include <vector>

#include "recognition/candidate.h"
#include "recognition/decision.h"
#include "recognition/search_task.h"
#include "recognition/stage_log.h"

namespace monocular_eye_hand {

/// Poses that are easily taken for one another compete only when both are there: adds to the candidates the
/// twins of those that may still be reported. A twin lies where its sibling lies, turned so that the part's
/// bounding box falls on itself or its flat side tilts the other way, and is aligned and verified as any
/// other.
std::vector<Candidate> addTwins(const SearchTask& task, Explained all, StageLog* log);

}  // namespace monocular_eye_hand
