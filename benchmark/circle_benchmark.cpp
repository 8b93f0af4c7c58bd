// Pose from a circle and a point: error without noise by tilt, how often the evidence puts the right one
// first, time.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "monocular_eye_hand/pose/circle_pose.h"
#include "p3p_problems.h"
#include "pose/circle_image.h"
#include "support/camera.h"

namespace monocular_eye_hand {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kProblems = 20000;

struct Problem {
  CircleAndPoint object;
  Rigid3 truth;
  Ellipse ellipse;
  Vector2d uv;
};

Problem draw(Random& random, const Camera& camera, double tilt) {
  Problem p;
  p.object.radius = uniform(random, 0.005, 0.1);
  p.object.axis = randomDirection(random);
  for (int i = 0; i < 3; ++i) {
    p.object.centre[i] = uniform(random, -0.1, 0.1);
    p.object.point[i] = uniform(random, -1, 1);
  }
  // anywhere round the axis, one to three radii from it, up to two above or below
  const Vector3d across = p.object.axis.cross(p.object.point).normalized();
  p.object.point = p.object.centre + p.object.radius * (uniform(random, 1, 3) * across +
                                                        uniform(random, -2, 2) * p.object.axis);
  const double x = uniform(random, -0.35, 0.35), y = uniform(random, -0.35, 0.35);
  const Vector3d sight = Vector3d(x, y, 1).normalized();
  const Vector3d turn = sight.cross(randomDirection(random)).normalized();
  const Vector3d normal = Eigen::AngleAxisd(tilt, turn) * Vector3d(-sight);
  p.truth.rotation = Eigen::Quaterniond::FromTwoVectors(p.object.axis, normal).toRotationMatrix();
  p.truth.rotation =
      (Eigen::AngleAxisd(uniform(random, 0, 2 * M_PI), normal).toRotationMatrix() * p.truth.rotation).eval();
  p.truth.translation =
      sight * (p.object.radius * uniform(random, 5, 40)) - p.truth.rotation * p.object.centre;
  p.ellipse =
      imageOfCircle(p.truth * p.object.centre, p.truth.rotation * p.object.axis, p.object.radius, camera);
  p.uv = camera.project(p.truth * p.object.point);
  return p;
}

/// Errors of the better of the two poses, as a share of the distance and in radians, at tilts of one range.
void errors(benchmark::State& state, double low, double high) {
  const Camera camera = unevenCamera();
  Random random(31);
  double missing = 0, wrong_first = 0;
  std::vector<double> all;
  for (auto _ : state) {
    for (int i = 0; i < kProblems; ++i) {
      const Problem p = draw(random, camera, uniform(random, low, high) * M_PI / 180);
      const CirclePointPoses found = circlePointPoses(p.ellipse, camera, p.object, p.uv);
      missing += found.count != 2;
      double error[2] = {10, 10};
      for (int k = 0; k < found.count; ++k)
        error[k] = poseError(found.pose[size_t(k)].camera_from_object, p.truth);
      all.push_back(std::min(error[0], error[1]));
      wrong_first += error[1] < error[0];
    }
  }
  std::sort(all.begin(), all.end());
  state.counters["median"] = all[all.size() / 2];
  state.counters["worst"] = all.back();
  state.counters["missing"] = missing;
  state.counters["wrong_first"] = wrong_first;
  state.counters["problems"] = kProblems;
}

const int kRegistered = [] {
  const double tilts[] = {0, 0.01, 0.1, 1, 5, 20, 60, 85};
  for (size_t i = 0; i + 1 < sizeof tilts / sizeof *tilts; ++i) {
    const double low = tilts[i], high = tilts[i + 1];
    std::string name = std::to_string(low);
    name.erase(name.find_last_not_of('0') + 1);
    if (name.back() == '.') name.pop_back();
    benchmark::RegisterBenchmark(("BM_CircleError/" + name).c_str(),
                                 [low, high](benchmark::State& state) { errors(state, low, high); })
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
  }
  return 0;
}();

void BM_CirclePointPoses(benchmark::State& state) {
  const Camera camera = unevenCamera();
  Random random(32);
  std::vector<Problem> problems;
  for (int i = 0; i < 512; ++i) problems.push_back(draw(random, camera, uniform(random, 0.1, 1.4)));
  size_t i = 0;
  for (auto _ : state) {
    const Problem& p = problems[i++ % problems.size()];
    benchmark::DoNotOptimize(circlePointPoses(p.ellipse, camera, p.object, p.uv));
  }
}
BENCHMARK(BM_CirclePointPoses);

}  // namespace
}  // namespace monocular_eye_hand
