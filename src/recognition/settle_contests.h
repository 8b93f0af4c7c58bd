#pragma once
#include <vector>

#include "recognition/candidate.h"
#include "recognition/decision.h"
#include "recognition/search_task.h"
#include "recognition/stage_log.h"

namespace monocular_eye_hand {

/// Poses of one part in one place that are nearly as likely as each other, a part and its half turn, are held
/// against each other in what they draw differently (PoseContest), and share the probability of the likeliest
/// accordingly. Pairs are recorded in Candidate::contests. `chosen`: the explanations among the candidates,
/// whose probabilities are those among the others of their object.
std::vector<Candidate> settleContests(const SearchTask& task, Explained all, StageLog* log);

}  // namespace monocular_eye_hand
