#pragma once
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <utility>
#include <vector>

#include "recognition/work_budget.h"

namespace monocular_eye_hand {

/// How many threads work here: those of the arena that the caller runs in.
inline int threadsHere() { return tbb::this_task_arena::max_concurrency(); }

/// Runs work(0) ... work(count - 1), several at once and in any order. What one of them throws is thrown
/// here.
template <class Work>
void atOnce(int count, const Work& work) {
  tbb::parallel_for(0, count, 1, work, tbb::simple_partitioner());
}

/// Runs work(i, &budget) for `count` pieces, several at once. For work that is not counted: each piece sees
/// the time that is left.
template <class Work>
void atOnce(int count, WorkBudget* budget, const Work& work) {
  std::vector<WorkBudget> parts(size_t(count), budget->part(1));
  atOnce(count, [&](int i) { work(i, &parts[size_t(i)]); });
  for (const WorkBudget& part : parts) budget->add(part);
}

/// Runs work(i, &budget) for `count` pieces of counted work, of which `later` more will come. Several at once
/// when the work is not limited; else in turn, so that what one leaves over goes to those after it, on
/// however many threads.
template <class Work>
void inParts(int count, int later, WorkBudget* budget, const Work& work) {
  if (!budget->limited()) {
    atOnce(count, budget, work);
    return;
  }
  for (int i = 0; i < count; ++i) {
    WorkBudget part = budget->part(count - i + later);
    work(i, &part);
    budget->add(part);
  }
}

/// One of several that share some work: it takes the pieces first, first + step, first + 2 step ...
struct WorkShare {
  int first = 0, step = 1;
};

/// Shares counted work that looks for the best: work(share, &budget, &best) sees some of the pieces only, and
/// `best` takes up what they found. What Best keeps must not depend on the order in which it comes.
template <class Best, class Work>
void gather(Best* best, WorkBudget* budget, const Work& work) {
  const int shares = budget->limited() ? 1 : threadsHere();
  std::vector<Best> others(size_t(shares) - 1, best->emptied());
  inParts(shares, 0, budget, [&](int i, WorkBudget* part) {
    work(WorkShare{i, shares}, part, i == 0 ? best : &others[size_t(i) - 1]);
  });
  for (Best& other : others) best->add(std::move(other));
}

}  // namespace monocular_eye_hand
