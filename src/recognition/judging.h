#pragma once
#include <optional>
#include <vector>

#include "monocular_eye_hand/recognition/object_estimate.h"
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

/// The pose moved onto the edges within shrinking `ranges` [px]; nothing when it cannot be, is not admissible
/// (distance, camera inside the part) or is that of a `known` candidate.
std::optional<Candidate> alignedCandidate(const SearchTask& task, int object, const Rigid3& start,
                                          const std::vector<double>& ranges,
                                          const std::vector<Candidate>& known);

/// Gives a verified candidate what speaks for it alone: the support's evidence and its probability.
void weighAlone(const SearchTask& task, Candidate* candidate);

/// Verifies an aligned candidate and gives it its probability; false when the image shows too little of it.
bool bearsOut(const SearchTask& task, Candidate* candidate);

/// Candidates from poses that are given, not searched for: moved onto the edges within 2.5 px and verified.
/// Those that the image does not bear out are left out. Throws BadInput on an object that is not known.
std::vector<Candidate> judgeProposals(const SearchTask& task, const std::vector<PoseProposal>& proposals,
                                      StageLog* log);

}  // namespace monocular_eye_hand
