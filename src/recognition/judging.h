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

/// A pose of an object that may be near a true one.
struct Start {
  int object = 0;
  Rigid3 camera_from_object;
  GroupingKind kind = GroupingKind::kEdge;  ///< of what proposed it
};

/// What came of a start.
struct Judged {
  bool aligned = false;  ///< to an admissible pose (distance, camera outside the part) that was not known yet
  std::optional<Candidate> candidate;  ///< when the image bears it out
};

/// Moves the starts onto the edges within shrinking `ranges` [px] and verifies them, with the outcome of one
/// after the other: one that comes to a pose of a candidate, `known` or from a start before it, is left out.
/// `same_start`: one that begins this near to such a pose is, too [px].
std::vector<Judged> judgeStarts(const SearchTask& task, const std::vector<Start>& starts,
                                const std::vector<double>& ranges, const std::vector<Candidate>& known,
                                double same_start, WorkBudget* budget);

/// The candidates among them; counts those that were verified.
std::vector<Candidate> borneOut(std::vector<Judged> judged, StageReport* report);

/// Takes the `count` best hypotheses of `object` out of its pool, moves them onto the edges, verifies those
/// that end in different poses, the most telling first, and gives those that the image bears out and that are
/// not `known`.
std::vector<Candidate> judgeHypotheses(const SearchTask& task, int object, HypothesisPool* pool, int count,
                                       const std::vector<Candidate>& known, WorkBudget* budget,
                                       StageLog* log);

/// Gives a verified candidate what speaks for it alone: the support's evidence and its probability.
void weighAlone(const SearchTask& task, Candidate* candidate);

/// Verifies an aligned candidate and gives it its probability; false when the image shows too little of it.
bool bearsOut(const SearchTask& task, Candidate* candidate);

/// Candidates from poses that are given, not searched for: moved onto the edges within 2.5 px and verified.
/// Those that the image does not bear out are left out. Throws BadInput on an object that is not known.
std::vector<Candidate> judgeProposals(const SearchTask& task, const std::vector<PoseProposal>& proposals,
                                      StageLog* log);

}  // namespace monocular_eye_hand
