#pragma once
#include <vector>

#include "recognition/candidate.h"
#include "recognition/search_task.h"
#include "recognition/stage_log.h"
#include "recognition/work_budget.h"

namespace monocular_eye_hand {

/// What a first look at the image tells about the models of a large base.
struct FirstLook {
  std::vector<int> promising;  ///< of the wanted models those that the image speaks for most, ascending
  std::vector<Candidate> candidates;  ///< of the others, in the order of the models
};

/// Lays the most telling groupings and segments of the image over every wanted model, a fixed number each,
/// and judges the best of the hypotheses: what each model's likeliest candidate is worth chooses half as many
/// as `thorough_models` that are searched for to the end. Of a base of no more than `thorough_models` all
/// are, without a look.
FirstLook lookFirst(const SearchTask& task, WorkBudget* budget, StageLog* log);

}  // namespace monocular_eye_hand
