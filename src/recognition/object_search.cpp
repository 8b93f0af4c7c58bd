#include "recognition/object_search.h"

#include <algorithm>
#include <utility>

#include "recognition/judging.h"

namespace monocular_eye_hand {
namespace {

constexpr double kExplainedShare = 0.7;  // of a segment's points claimed: it is explained
constexpr double kSurelyRight = 0.9;     // only such objects explain features away during the search
constexpr int kAnswersFor = 3;           // edge points to either side that a claimed one answers for

// Edge points that surely right explanations claim. A contour sample answers for the points up to half a step
// to either side of it.
std::vector<char> explainedPoints(const FeatureSet& features, const std::vector<Candidate>& candidates,
                                  const std::vector<Explanation>& chosen) {
  std::vector<char> claimed(features.points.size(), 0);
  for (const Explanation& explanation : chosen) {
    const Candidate& candidate = candidates[explanation.candidate];
    if (candidate.probability < kSurelyRight) continue;
    for (int point : candidate.claimed) claimed[point] = 1;
  }

  std::vector<char> explained = claimed;
  for (const EdgeTrace& trace : features.traces) {
    const int last = trace.first + trace.count - 1;
    for (int i = trace.first; i <= last; ++i)
      if (claimed[i])
        for (int k = std::max(trace.first, i - kAnswersFor); k <= std::min(last, i + kAnswersFor); ++k)
          explained[k] = 1;
  }
  return explained;
}

// A flag per segment: not explained yet.
std::vector<char> unexplainedSegments(const FeatureSet& features, const std::vector<Candidate>& candidates,
                                      const std::vector<Explanation>& chosen) {
  const std::vector<char> explained = explainedPoints(features, candidates, chosen);

  std::vector<char> unexplained;
  for (const LineSegment& segment : features.segments) {
    int count = 0;
    for (int i = segment.first; i < segment.first + segment.count; ++i) count += explained[i];
    unexplained.push_back(count < kExplainedShare * segment.count);
  }
  return unexplained;
}

}  // namespace

SearchState searchGroupings(const SearchTask& task, WorkBudget* budget, StageLog* log) {
  SearchState state;
  for (int object : task.wanted)
    state.pools.emplace_back(task.image.camera, task.models[object], task.options);

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
