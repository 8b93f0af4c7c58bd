#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/recognition/object_estimate.h"
#include "recognition/candidate.h"
#include "recognition/decision.h"
#include "recognition/search_task.h"
#include "recognition/stage_log.h"

namespace monocular_eye_hand {

/// What is decided on an explanation.
struct Verdict {
  Decision decision = Decision::kRejected;
  std::vector<Alternative> alternatives;  ///< its rivals that are really different and nearly as likely
  std::string reason;                     ///< for people
  std::vector<std::string> spoke_for, spoke_against;  ///< as ObjectEstimate's
};

/// One verdict per explanation.
std::vector<Verdict> decide(const SearchTask& task, const std::vector<Candidate>& candidates,
                            const std::vector<Explanation>& chosen, StageLog* log);

/// JudgedCandidate::strongest_against of a candidate.
std::string strongestAgainst(const SearchTask& task, const Candidate& candidate);

}  // namespace monocular_eye_hand
