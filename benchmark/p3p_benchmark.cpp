// The three-point solver beside OpenCV's AP3P on the same problems: time of one solve, accuracy and
// completeness.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/pose/p3p.h"
#include "p3p_peer.h"
#include "p3p_reference.h"

namespace monocular_eye_hand {
namespace {

constexpr int kTimed = 4000;     // problems: branches are not learnt by heart
constexpr int kCounted = 20000;  // of each set have their solutions counted

template <class Solve>
void timeOver(benchmark::State& state, const char* set, Solve solve) {
  const std::vector<P3PProblem> problems = drawProblems(p3pSet(set), kTimed);
  size_t i = 0;
  for (auto _ : state) {
    solve(problems[i]);
    i = i + 1 < problems.size() ? i + 1 : 0;
  }
}

void BM_P3P(benchmark::State& state, const char* set) {
  timeOver(state, set, [](const P3PProblem& p) {
    const PoseSolutions found = solveP3P(p.bearings, p.points);
    benchmark::DoNotOptimize(&found);
    benchmark::ClobberMemory();
  });
}
BENCHMARK_CAPTURE(BM_P3P, general, "general");
BENCHMARK_CAPTURE(BM_P3P, far30, "far30");
BENCHMARK_CAPTURE(BM_P3P, symmetric, "symmetric");

void BM_Ap3p(benchmark::State& state, const char* set) {
  Ap3pPeer peer;
  timeOver(state, set, [&](const P3PProblem& p) { benchmark::DoNotOptimize(peer.solve(p)); });
}
BENCHMARK_CAPTURE(BM_Ap3p, general, "general");
BENCHMARK_CAPTURE(BM_Ap3p, far30, "far30");
BENCHMARK_CAPTURE(BM_Ap3p, symmetric, "symmetric");

/// What one solver's solutions of a set are like.
struct Score {
  double none = 0, over1e9 = 0, over1e6 = 0, over1e3 = 0,
         over1e1 = 0;  ///< problems, by the best pose's error
  double bogus = 0;  ///< problems with a pose that is no rotation or does not put the points on the bearings
  double duplicate = 0;        ///< problems with a pose twice
  double fewer = 0, more = 0;  ///< than the reference
  std::vector<double> errors;

  void add(const P3PProblem& problem, const std::vector<Rigid3>& poses, int reference);
  double percentile(double share) {
    const auto at = errors.begin() + long(share * double(errors.size() - 1));
    std::nth_element(errors.begin(), at, errors.end());
    return *at;
  }
};

bool sound(const P3PProblem& problem, const Rigid3& pose) {
  if (!pose.isFinite()) return false;
  if ((pose.rotation * pose.rotation.transpose() - Eigen::Matrix3d::Identity()).norm() > 1e-4) return false;
  for (int i = 0; i < 3; ++i)
    if (!(((pose * Eigen::Vector3d(problem.points.col(i))).normalized() - problem.bearings.col(i)).norm() <
          1e-5))
      return false;
  return true;
}

void Score::add(const P3PProblem& problem, const std::vector<Rigid3>& poses, int reference) {
  double best = 1e9;
  int valid = 0, bad = 0, twice = 0;
  for (size_t i = 0; i < poses.size(); ++i) {
    if (!sound(problem, poses[i])) {
      ++bad;
      continue;
    }
    best = std::min(best, poseError(poses[i], problem.truth));
    const bool known = std::any_of(poses.begin(), poses.begin() + long(i), [&](const Rigid3& other) {
      return sound(problem, other) && poseError(other, poses[i]) < 1e-7;
    });
    ++(known ? twice : valid);
  }
  errors.push_back(best);
  none += valid == 0;
  over1e9 += !(best < 1e-9);
  over1e6 += !(best < 1e-6);
  over1e3 += !(best < 1e-3);
  over1e1 += !(best < 1e-1);
  bogus += bad > 0;
  duplicate += twice > 0;
  if (reference >= 0) {
    fewer += valid < reference;
    more += valid > reference;
  }
}

void report(benchmark::State& state, const std::string& who, Score* score) {
  state.counters[who + "_none"] = score->none;
  state.counters[who + "_over1e9"] = score->over1e9;
  state.counters[who + "_over1e6"] = score->over1e6;
  state.counters[who + "_over1e3"] = score->over1e3;
  state.counters[who + "_over1e1"] = score->over1e1;
  state.counters[who + "_bogus"] = score->bogus;
  state.counters[who + "_duplicate"] = score->duplicate;
  state.counters[who + "_fewer"] = score->fewer;
  state.counters[who + "_more"] = score->more;
  state.counters[who + "_median"] = score->percentile(0.5);
  state.counters[who + "_p999"] = score->percentile(0.999);
}

void accuracy(benchmark::State& state, const P3PSet& set) {
  Score ours, peers;
  Ap3pPeer peer;
  int counted = 0;
  for (auto _ : state) {
    const std::vector<P3PProblem> problems = drawProblems(set, set.count);
    for (const P3PProblem& p : problems) {
      const PoseSolutions found = solveP3P(p.bearings, p.points);
      const int reference = counted < kCounted ? referenceCount(p) : -1;
      ++counted;
      ours.add(p, {found.camera_from_object.begin(), found.camera_from_object.begin() + found.count},
               reference);
      peer.solve(p);
      peers.add(p, peer.poses(), reference);
    }
  }
  report(state, "ours", &ours);
  report(state, "peer", &peers);
  state.counters["problems"] = set.count;
  state.counters["counted"] = std::min(set.count, kCounted);
}

const int kRegistered = [] {
  for (const P3PSet& set : p3pSets())
    benchmark::RegisterBenchmark(("BM_P3PAccuracy/" + set.name).c_str(),
                                 [&set](benchmark::State& state) { accuracy(state, set); })
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
  return 0;
}();

}  // namespace
}  // namespace monocular_eye_hand
