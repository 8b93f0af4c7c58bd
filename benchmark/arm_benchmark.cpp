// The PUMA's kinematics, with KDL's iterative inverse beside it on the same seeded poses.
#include <benchmark/benchmark.h>

#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <vector>

#include "arm/random_arm.h"

namespace monocular_eye_hand {
namespace {

constexpr size_t kPoses = 4096;

const std::vector<JointVector>& configurations() {
  static const std::vector<JointVector> all = [] {
    Random random(5);
    std::vector<JointVector> q(kPoses);
    for (JointVector& joints : q) joints = randomJoints(random, Puma560Options());
    return q;
  }();
  return all;
}

JointVector midRange() {
  JointVector middle;
  const Puma560Options options;
  for (int i = 0; i < 6; ++i)
    middle[i] = (options.joints[size_t(i)].lower + options.joints[size_t(i)].upper) / 2;
  return middle;
}

void BM_PumaForward(benchmark::State& state) {
  const Puma560 arm;
  size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(arm.baseFromTool0(configurations()[i++ % kPoses]));
}
BENCHMARK(BM_PumaForward);

void BM_PumaJacobian(benchmark::State& state) {
  const Puma560 arm;
  size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(arm.jacobian(configurations()[i++ % kPoses]));
}
BENCHMARK(BM_PumaJacobian);

/// All configurations and turns inside the limits.
void BM_PumaInverse(benchmark::State& state) {
  const Puma560 arm;
  const JointVector current = midRange();
  std::vector<Rigid3> poses;
  for (const JointVector& q : configurations()) poses.push_back(arm.baseFromTool0(q));
  ArmSolutions found;
  size_t i = 0;
  double solutions = 0;
  for (auto _ : state) {
    arm.inverse(poses[i++ % kPoses], current, &found);
    benchmark::DoNotOptimize(found);
    solutions += found.size();
  }
  state.counters["solutions"] = solutions / double(state.iterations());
}
BENCHMARK(BM_PumaInverse);

KDL::Chain kdlChain(const Puma560Options& o) {
  const double a[6] = {0, o.a2, o.a3, 0, 0, 0}, d[6] = {0, 0, o.d3, o.d4, 0, o.d6};
  const double alpha[6] = {M_PI / 2, 0, -M_PI / 2, M_PI / 2, -M_PI / 2, 0};
  KDL::Chain chain;
  chain.addSegment(
      KDL::Segment(KDL::Joint(KDL::Joint::None), KDL::Frame(KDL::Vector(0, 0, o.shoulder_height))));
  for (int i = 0; i < 6; ++i)
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ), KDL::Frame::DH(a[i], alpha[i], d[i], 0)));
  return chain;
}

/// One configuration from the middle of the ranges, limits not looked at.
void BM_KdlLma(benchmark::State& state) {
  const Puma560 arm;
  const KDL::Chain chain = kdlChain(arm.options());
  KDL::ChainFkSolverPos_recursive forward(chain);
  std::vector<KDL::Frame> poses(kPoses);
  double worst = 0;
  for (size_t i = 0; i < kPoses; ++i) {
    KDL::JntArray q(6);
    q.data = configurations()[i];
    forward.JntToCart(q, poses[i]);
    const Eigen::Vector3d t = arm.baseFromTool0(configurations()[i]).translation;
    for (int k = 0; k < 3; ++k) worst = std::max(worst, std::abs(t[k] - poses[i].p[k]));
  }
  if (worst > 1e-12) return state.SkipWithError("the two chains differ");
  Vector6d weights;
  weights << 1, 1, 1, 0.01, 0.01, 0.01;
  KDL::ChainIkSolverPos_LMA solver(chain, weights, 1e-8, 500, 1e-12);
  KDL::JntArray seed(6), found(6);
  seed.data = midRange();
  size_t i = 0;
  double converged = 0;
  for (auto _ : state) {
    converged += solver.CartToJnt(seed, poses[i++ % kPoses], found) >= 0;
    benchmark::DoNotOptimize(found);
  }
  state.counters["converged"] = converged / double(state.iterations());
}
BENCHMARK(BM_KdlLma);

/// The worst residual of all solutions of a million poses: half anywhere, half near or on the singularities.
void BM_PumaResidual(benchmark::State& state) {
  const Puma560 arm;
  Random random(6);
  ArmSolutions found;
  double metres = 0, radians = 0, missed = 0, drawn = 0;
  for (auto _ : state) {
    while (drawn < 1e6) {
      const JointVector q = nearSingular(random, arm.options(), std::max(0, int(random() % 14) - 6));
      if (!arm.withinLimits(q, 0)) continue;
      ++drawn;
      const Rigid3 pose = arm.baseFromTool0(q);
      arm.inverse(pose, q, &found);
      missed += found.empty();
      for (const ArmSolution& s : found) {
        const Rigid3 reached = arm.baseFromTool0(s.joints);
        metres = std::max(metres, (reached.translation - pose.translation).norm());
        radians = std::max(radians, rotationError(reached.rotation, pose.rotation));
      }
    }
  }
  state.counters["metres"] = metres;
  state.counters["radians"] = radians;
  state.counters["missed"] = missed;
  state.counters["poses"] = drawn;
}
BENCHMARK(BM_PumaResidual)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace monocular_eye_hand
