#include "recognition/object_search.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "recognition/explained_features.h"
#include "recognition/judging.h"
#include "recognition/shared_work.h"

namespace monocular_eye_hand {
namespace {

constexpr size_t kMaxSegments = 600;   // tried as edges of a part
constexpr double kExplainsAway = 0.9;  // only such objects explain features away during the search

// A flag per segment: no surely right explanation claims it.
std::vector<char> unexplainedSegments(const FeatureSet& features, const std::vector<Candidate>& candidates,
                                      const std::vector<Explanation>& chosen) {
  std::vector<int> claimed;
  for (const Explanation& explanation : chosen) {
    const Candidate& candidate = candidates[explanation.candidate];
    if (candidate.probability < kExplainsAway) continue;
    claimed.insert(claimed.end(), candidate.claimed.begin(), candidate.claimed.end());
  }
  const std::vector<char> explained = explainedPoints(features, claimed);

  std::vector<char> unexplained;
  for (const LineSegment& segment : features.segments)
    unexplained.push_back(!isExplained(segment, explained));
  return unexplained;
}

struct Round {
  const char* proposing;  // name of its first stage
  int judged;             // hypotheses of each object
  int later;              // shares of the budget that are kept for what comes after it
};

// The hypotheses of every wanted object by propose(object, &pool, &budget), judged. What is found is added to
// the state's candidates in the order of the objects.
template <class Propose>
SearchState searchRound(const SearchTask& task, SearchState state, const Round& round, WorkBudget* budget,
                        StageLog* log, const Propose& propose) {
  const size_t objects = task.wanted.size();
  std::vector<std::vector<Candidate>> found(objects);
  std::vector<StageLog> logs(objects);
  inParts(int(objects), round.later, budget, [&](int i, WorkBudget* part) {
    const int object = task.wanted[size_t(i)];
    HypothesisPool* pool = &state.pools[size_t(i)];
    StageLog* own_log = &logs[size_t(i)];
    own_log->timed(round.proposing, [&](StageReport* report) {
      propose(object, pool, part);
      report->counts["scored"] = double(part->scored());
    });
    found[size_t(i)] = judgeHypotheses(task, object, pool, round.judged, state.candidates, part, own_log);
  });

  for (const StageLog& own_log : logs) log->add(own_log);
  for (std::vector<Candidate>& some : found)
    std::move(some.begin(), some.end(), std::back_inserter(state.candidates));
  return state;
}

}  // namespace

SearchState searchGroupings(const SearchTask& task, std::vector<Candidate> known, WorkBudget* budget,
                            StageLog* log) {
  SearchState state;
  state.candidates = std::move(known);
  for (int object : task.wanted) state.pools.emplace_back(task, object);

  // Every object has its part of the second round, too.
  const Round round{"hypotheses from groupings", task.options.refined_per_object / 2,
                    int(task.wanted.size())};
  return searchRound(task, std::move(state), round, budget, log,
                     [&](int object, HypothesisPool* pool, WorkBudget* part) {
                       hypothesesFromGroupings(task, object, pool, part);
                     });
}

SearchState searchEdges(const SearchTask& task, SearchState state, const std::vector<Explanation>& chosen,
                        WorkBudget* budget, StageLog* log) {
  const std::vector<char> usable = unexplainedSegments(task.image.features, state.candidates, chosen);
  const std::vector<int> segments = mostTellingSegments(task.image, usable, kMaxSegments);
  const Round round{"hypotheses from edges", task.options.refined_per_object, 0};
  return searchRound(task, std::move(state), round, budget, log,
                     [&](int object, HypothesisPool* pool, WorkBudget* part) {
                       hypothesesFromEdges(task, object, segments, pool, part);
                     });
}

}  // namespace monocular_eye_hand
