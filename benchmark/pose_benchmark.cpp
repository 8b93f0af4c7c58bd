// Time of the pose solvers. Seeded problems, a few hundred per case, so that branches are not learnt by
// heart.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "monocular_eye_hand/pose/circle_pose.h"
#include "monocular_eye_hand/pose/corner_pose.h"
#include "monocular_eye_hand/pose/p3p.h"
#include "monocular_eye_hand/pose/refine.h"
#include "support/camera.h"
#include "support/random.h"

namespace monocular_eye_hand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr size_t kProblems = 512;

struct ThreePoints {
  Matrix3d points, bearings;
};

std::vector<ThreePoints> threePoints(double distance) {
  Random random(1);
  std::vector<ThreePoints> problems(kProblems);
  for (ThreePoints& p : problems) {
    for (int i = 0; i < 9; ++i) p.points(i) = uniform(random, -0.5, 0.5);
    const Rigid3 pose{randomRotation(random),
                      Vector3d(uniform(random, -0.4, 0.4), uniform(random, -0.4, 0.4), 1) * distance};
    for (int i = 0; i < 3; ++i) p.bearings.col(i) = (pose * Vector3d(p.points.col(i))).normalized();
  }
  return problems;
}

void BM_P3P(benchmark::State& state) {
  const auto problems = threePoints(double(state.range(0)));
  size_t i = 0;
  int solutions = 0;
  for (auto _ : state) {
    const ThreePoints& p = problems[i++ % kProblems];
    const PoseSolutions found = solveP3P(p.bearings, p.points);
    benchmark::DoNotOptimize(found);
    solutions += found.count;
  }
  state.counters["solutions"] = double(solutions) / double(state.iterations());
}
BENCHMARK(BM_P3P)->Arg(2)->Arg(30);

void BM_TetrahedronLegs(benchmark::State& state) {
  const auto problems = threePoints(2);
  std::vector<Vector3d> sides;
  for (const ThreePoints& p : problems)
    sides.push_back({(p.points.col(1) - p.points.col(2)).norm(), (p.points.col(0) - p.points.col(2)).norm(),
                     (p.points.col(0) - p.points.col(1)).norm()});
  size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(solveTetrahedron(problems[i % kProblems].bearings, sides[i % kProblems]));
    ++i;
  }
}
BENCHMARK(BM_TetrahedronLegs);

void BM_ObjectFromCamera(benchmark::State& state) {
  const auto problems = threePoints(2);
  std::vector<Matrix3d> in_camera;
  for (const ThreePoints& p : problems) {
    const PoseSolutions s = solveP3P(p.bearings, p.points);
    in_camera.push_back((s.camera_from_object[0].rotation * p.points).colwise() +
                        s.camera_from_object[0].translation);
  }
  size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(objectFromCamera(problems[i % kProblems].points, in_camera[i % kProblems]));
    ++i;
  }
}
BENCHMARK(BM_ObjectFromCamera);

void BM_CornerRotations(benchmark::State& state) {
  Random random(2);
  std::vector<CornerObservation> seen(kProblems);
  for (CornerObservation& s : seen) {
    s.corner = Vector3d(uniform(random, -0.4, 0.4), uniform(random, -0.4, 0.4), 1).normalized();
    const Matrix3d turn = randomRotation(random);
    for (int i = 0; i < 3; ++i) s.far_points.col(i) = (5 * s.corner + turn.col(i)).normalized();
  }
  size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(cornerRotations(seen[i++ % kProblems], Matrix3d::Identity()));
}
BENCHMARK(BM_CornerRotations);

void BM_CirclePoses(benchmark::State& state) {
  Random random(3);
  const Camera camera = unevenCamera();
  std::vector<Ellipse> ellipses(kProblems);
  for (Ellipse& e : ellipses) {
    e.centre = {uniform(random, 50, 590), uniform(random, 50, 430)};
    e.a = uniform(random, 10, 80);
    e.b = e.a * uniform(random, 0.2, 0.95);
    e.angle = uniform(random, 0, 3);
  }
  size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(circlePoses(ellipses[i++ % kProblems], camera, 0.03));
}
BENCHMARK(BM_CirclePoses);

struct Refinement {
  Rigid3 start;
  std::vector<LineMatch> lines;
  std::vector<PointMatch> points;
};

std::vector<Refinement> refinements(int lines, int points, const Camera& camera) {
  Random random(4);
  std::vector<Refinement> problems(64);
  for (Refinement& p : problems) {
    const Rigid3 truth{randomRotation(random), Vector3d(0.03, -0.02, 0.6)};
    Vector6d d;
    d << 0.01 * randomDirection(random), 0.05 * randomDirection(random);
    p.start = perturbed(truth, d);
    for (int i = 0; i < lines + points; ++i) {
      const Vector3d at =
          0.1 * Vector3d(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
      const Eigen::Vector2d uv =
          camera.project(truth * at) + 0.3 * Eigen::Vector2d(normal(random), normal(random));
      const double angle = uniform(random, 0, 2 * M_PI);
      if (i < lines)
        p.lines.push_back({at, uv, {std::cos(angle), std::sin(angle)}, 0.3});
      else
        p.points.push_back({at, uv, 0.3});
    }
  }
  return problems;
}

/// Ten iterations, none saved by an early stop.
void BM_RefineTenIterations(benchmark::State& state) {
  const Camera camera = unevenCamera();
  const auto problems = refinements(int(state.range(0)), int(state.range(1)), camera);
  RefineOptions options;
  options.min_step = 0;
  size_t i = 0;
  for (auto _ : state) {
    const Refinement& p = problems[i++ % problems.size()];
    benchmark::DoNotOptimize(refinePose(p.start, camera, p.lines, p.points, options));
  }
}
BENCHMARK(BM_RefineTenIterations)->Args({60, 0})->Args({0, 8});

/// From 1 cm and 3 degrees off to convergence.
void BM_RefineToConvergence(benchmark::State& state) {
  const Camera camera = unevenCamera();
  const auto problems = refinements(int(state.range(0)), int(state.range(1)), camera);
  RefineOptions options;
  options.max_iterations = 20;
  options.robust_scale = double(state.range(2));
  size_t i = 0;
  int iterations = 0;
  for (auto _ : state) {
    const Refinement& p = problems[i++ % problems.size()];
    const RefinedPose found = refinePose(p.start, camera, p.lines, p.points, options);
    benchmark::DoNotOptimize(found);
    iterations += found.iterations;
  }
  state.counters["iterations"] = double(iterations) / double(state.iterations());
}
BENCHMARK(BM_RefineToConvergence)->Args({60, 0, 3})->Args({0, 4, 0})->Args({0, 8, 0})->Args({0, 20, 0});

void BM_BestFour(benchmark::State& state) {
  const Camera camera = unevenCamera();
  const auto problems = refinements(0, int(state.range(0)), camera);
  size_t i = 0;
  for (auto _ : state) {
    const Refinement& p = problems[i++ % problems.size()];
    benchmark::DoNotOptimize(bestFour(p.points, p.start, camera));
  }
}
BENCHMARK(BM_BestFour)->Arg(8)->Arg(40);

}  // namespace
}  // namespace monocular_eye_hand
