// Refinement of a pose on 4, 8 and 20 points beside Ceres on the same problems: time and where they end.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/pose/refine.h"
#include "refine_peer.h"
#include "support/random.h"

namespace monocular_eye_hand {
namespace {

constexpr int kProblems = 400;

struct Problem {
  std::vector<PointMatch> points;
  Rigid3 truth, start;
};

Camera camera() {
  Camera c;
  c.width = 640;
  c.height = 480;
  c.fx = c.fy = 600;
  c.cx = 320;
  c.cy = 240;
  return c;
}

/// Points in a cube of 1 m at 4-6 m with 0.5 px of noise; the start 3 degrees about any axis and 3 % off.
std::vector<Problem> drawProblems(int points) {
  Random random(3);
  std::vector<Problem> problems(kProblems);
  for (Problem& p : problems) {
    p.truth.rotation = randomRotation(random);
    for (int i = 0; i < 3; ++i) p.truth.translation[i] = uniform(random, -0.5, 0.5);
    p.truth.translation.z() = 5 + 2 * p.truth.translation.z();
    for (int i = 0; i < points; ++i) {
      PointMatch m;
      for (int k = 0; k < 3; ++k) m.p_in_object[k] = uniform(random, -0.5, 0.5);
      const double du = normal(random), dv = normal(random);
      m.uv = camera().project(p.truth * m.p_in_object) + 0.5 * Eigen::Vector2d(du, dv);
      p.points.push_back(m);
    }
    p.start.rotation = expSO3(3 * M_PI / 180 * randomDirection(random)) * p.truth.rotation;
    p.start.translation = 1.03 * p.truth.translation;
  }
  return problems;
}

RefinedPose refineOurs(const Problem& p, const Camera& c) {
  RefineOptions options;
  options.robust_scale = 0;
  options.max_iterations = 20;
  return refinePose(p.start, c, {}, p.points, options);
}

double rms(const Problem& p, const Camera& c, const Rigid3& pose) {
  double sum = 0;
  for (const PointMatch& m : p.points) sum += (c.project(pose * m.p_in_object) - m.uv).squaredNorm();
  return std::sqrt(sum / double(p.points.size()));
}

template <class Refine>
void timeOver(benchmark::State& state, Refine refine) {
  const Camera c = camera();
  const std::vector<Problem> problems = drawProblems(int(state.range(0)));
  size_t i = 0;
  for (auto _ : state) {
    refine(problems[i], c);
    i = i + 1 < problems.size() ? i + 1 : 0;
  }
}

void BM_Refine(benchmark::State& state) {
  timeOver(state, [](const Problem& p, const Camera& c) { benchmark::DoNotOptimize(refineOurs(p, c)); });
}
BENCHMARK(BM_Refine)->Arg(4)->Arg(8)->Arg(20);

void BM_Ceres(benchmark::State& state) {
  timeOver(state, [](const Problem& p, const Camera& c) {
    benchmark::DoNotOptimize(refineByCeres(p.start, c, p.points));
  });
}
BENCHMARK(BM_Ceres)->Arg(4)->Arg(8)->Arg(20);

/// Where both end: the largest excess of one's rms over the other's, and our iterations.
void BM_Optimum(benchmark::State& state) {
  const Camera c = camera();
  double excess = 0, peer_excess = 0, iterations = 0, unconverged = 0;
  std::vector<double> all;
  for (auto _ : state) {
    for (const Problem& p : drawProblems(int(state.range(0)))) {
      const RefinedPose ours = refineOurs(p, c);
      const double our_rms = rms(p, c, ours.camera_from_object),
                   peer_rms = rms(p, c, refineByCeres(p.start, c, p.points));
      excess = std::max(excess, our_rms - peer_rms);
      peer_excess = std::max(peer_excess, peer_rms - our_rms);
      iterations += ours.iterations;
      unconverged += !ours.converged;
      all.push_back(our_rms);
    }
  }
  std::nth_element(all.begin(), all.begin() + kProblems / 2, all.end());
  state.counters["median_rms"] = all[kProblems / 2];
  state.counters["excess"] = excess;
  state.counters["peer_excess"] = peer_excess;
  state.counters["iterations"] = iterations / kProblems;
  state.counters["unconverged"] = unconverged;
}
BENCHMARK(BM_Optimum)->Arg(4)->Arg(8)->Arg(20)->Iterations(1);

}  // namespace
}  // namespace monocular_eye_hand
