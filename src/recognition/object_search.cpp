#include "recognition/object_search.h"

#include <utility>

#include "recognition/explained_features.h"
#include "recognition/judging.h"

namespace monocular_eye_hand {
namespace {

constexpr double kSurelyRight = 0.9;  // only such objects explain features away during the search

// A flag per segment: no surely right explanation claims it.
std::vector<char> unexplainedSegments(const FeatureSet& features, const std::vector<Candidate>& candidates,
                                      const std::vector<Explanation>& chosen) {
  std::vector<int> claimed;
  for (const Explanation& explanation : chosen) {
    const Candidate& candidate = candidates[explanation.candidate];
    if (candidate.probability < kSurelyRight) continue;
    claimed.insert(claimed.end(), candidate.claimed.begin(), candidate.claimed.end());
  }
  const std::vector<char> explained = explainedPoints(features, claimed);

  std::vector<char> unexplained;
  for (const LineSegment& segment : features.segments)
    unexplained.push_back(!isExplained(segment, explained));
  return unexplained;
}

}  // namespace

SearchState searchGroupings(const SearchTask& task, WorkBudget* budget, StageLog* log) {
  SearchState state;
  for (int object : task.wanted) state.pools.emplace_back(task, object);

  const int objects = int(task.wanted.size());
  for (int i = 0; i < objects; ++i) {
    const int object = task.wanted[i];
    budget->allow(objects - i + objects);  // every object has its part of the second round, too

    log->timed("hypotheses from groupings", [&](StageReport* report) {
      const long long before = budget->scored();
      hypothesesFromGroupings(task.image, object, task.models[object], &state.pools[i], budget);
      report->counts["scored"] = double(budget->scored() - before);
    });
    state.candidates = judgeHypotheses(task, object, &state.pools[i], task.options.refined_per_object / 2,
                                       std::move(state.candidates), budget, log);
  }
  return state;
}

SearchState searchEdges(const SearchTask& task, SearchState state, const std::vector<Explanation>& chosen,
                        WorkBudget* budget, StageLog* log) {
  const std::vector<char> usable = unexplainedSegments(task.image.features, state.candidates, chosen);

  const int objects = int(task.wanted.size());
  for (int i = 0; i < objects; ++i) {
    const int object = task.wanted[i];
    budget->allow(objects - i);

    log->timed("hypotheses from edges", [&](StageReport* report) {
      const long long before = budget->scored();
      hypothesesFromEdges(task.image, task.models[object], task.options, usable, &state.pools[i], budget);
      report->counts["scored"] = double(budget->scored() - before);
    });
    state.candidates = judgeHypotheses(task, object, &state.pools[i], task.options.refined_per_object,
                                       std::move(state.candidates), budget, log);
  }
  return state;
}

}  // namespace monocular_eye_hand
