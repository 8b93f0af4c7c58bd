#include "recognition/first_look.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "recognition/hypotheses.h"
#include "recognition/judging.h"
#include "recognition/shared_work.h"

namespace monocular_eye_hand {
namespace {

// What one model gets at a first look.
constexpr long long kHypotheses = 20000;  // from groupings
constexpr size_t kSegments = 100;         // tried as its edges
constexpr int kRefined = 60;              // hypotheses moved onto the edges
constexpr int kVerified = 6;              // of these, judged

// What a look for one model has shown.
struct Looked {
  std::vector<Candidate> candidates;

  double probability() const {
    double best = 0;
    for (const Candidate& candidate : candidates) best = std::max(best, candidate.probability);
    return best;
  }
};

Looked lookFor(const SearchTask& task, int object, const std::vector<int>& segments, WorkBudget* budget) {
  HypothesisPool pool(task, object);
  WorkBudget first = budget->upTo(kHypotheses);
  hypothesesFromGroupings(task, object, &pool, &first);
  budget->addPiece(first);

  WorkBudget second = budget->part(1);
  hypothesesFromEdges(task, object, segments, &pool, &second);
  budget->add(second);

  StageLog unread;
  return {judgeHypotheses(task, object, &pool, kRefined, {}, budget, &unread)};
}

}  // namespace

FirstLook lookFirst(const SearchTask& task, WorkBudget* budget, StageLog* log) {
  const int models = int(task.wanted.size());
  if (models <= task.options.thorough_models) return {task.wanted, {}};

  RecognitionOptions brief = task.options;
  brief.verified_per_object = std::min(brief.verified_per_object, kVerified);
  const SearchTask looking{task.image, task.models,  task.wanted,      brief,
                           nullptr,    task.support, task.largest_size};
  const int promising = (task.options.thorough_models + 1) / 2;
  std::vector<Looked> looked(size_t(models), Looked{});
  log->timed("first look", [&](StageReport* report) {
    const long long before = budget->scored();
    const std::vector<char> all(task.image.features.segments.size(), 1);
    const std::vector<int> segments = mostTellingSegments(task.image, all, kSegments);
    inParts(models, 2 * promising, budget, [&](int i, WorkBudget* part) {
      looked[size_t(i)] = lookFor(looking, task.wanted[size_t(i)], segments, part);
    });
    report->counts = {
        {"models", models}, {"promising", promising}, {"scored", double(budget->scored() - before)}};
  });

  std::vector<int> order(looked.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return looked[size_t(a)].probability() > looked[size_t(b)].probability();
  });
  std::vector<char> chosen(looked.size(), 0);
  for (int k = 0; k < promising; ++k) chosen[size_t(order[size_t(k)])] = 1;

  FirstLook first;
  for (size_t i = 0; i < looked.size(); ++i) {
    std::vector<Candidate>& candidates = looked[i].candidates;
    if (chosen[i])
      first.promising.push_back(task.wanted[i]);
    else
      std::move(candidates.begin(), candidates.end(), std::back_inserter(first.candidates));
  }
  return first;
}

}  // namespace monocular_eye_hand
