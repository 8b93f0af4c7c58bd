#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "planning/scene.h"
#include "planning_peer.h"

namespace monocular_eye_hand {
namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return NAN;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, size_t(share * double(values.size())))];
}
Rigid3 rigid(const Eigen::Isometry3d& t) { return {t.linear(), t.translation()}; }

/// The peer's boxes as an arm; the base is at the shoulder.
ArmDescription boxArm() {
  ArmDescription arm;
  arm.links.resize(8);
  arm.links[0].name = "base_link";
  for (int i = 0; i < 6; ++i) {
    ArmLink& link = arm.links[i + 1];
    link.name = "link" + std::to_string(i + 1);
    link.parent = i;
    link.joint = i;
    if (i > 0) link.parent_from_joint = rigid(dhOffset(i - 1));
  }
  arm.links[7].name = "tool0";
  arm.links[7].parent = 6;
  for (const BenchBox& box : armBoxes()) {
    ArmShape shape;
    shape.size = box.size;
    shape.link_from_shape.translation = box.centre;
    if (box.frame >= 0) shape.link_from_shape = rigid(dhOffset(box.frame)) * shape.link_from_shape;
    arm.links[box.frame + 1].collision.push_back(shape);
  }
  return arm;
}
CollisionWorld boxWorld() {
  const ArmDescription arm = boxArm();
  CollisionWorld world(arm);
  for (int i = 0; i < 7; ++i)  // the peer tests forearm and hand against base and upper arm
    for (int j = i + 1; j < 7; ++j)
      if (!((j == 4 || j == 6) && (i == 0 || i == 2))) world.allow(arm.links[i].name, arm.links[j].name);
  for (size_t i = 0; i < worldBoxes().size(); ++i) {
    Rigid3 pose;
    pose.translation = worldBoxes()[i].centre;
    world.addBox("box_" + std::to_string(i), worldBoxes()[i].size, pose);
  }
  return world;
}

BenchJoints randomJoints(const std::array<JointLimit, 6>& limits, std::mt19937_64* random) {
  BenchJoints q;
  for (int i = 0; i < 6; ++i)
    q[i] = std::uniform_real_distribution<double>(limits[i].lower, limits[i].upper)(*random);
  return q;
}
JointVector vectorOf(const BenchJoints& q) { return Eigen::Map<const JointVector>(q.data()); }

/// Hand in the bin, looking down to about 25 degrees, free for both.
std::vector<BenchJoints> binGoals(const CollisionWorld& world, const std::array<JointLimit, 6>& limits,
                                  size_t count) {
  std::mt19937_64 random(4);
  std::vector<BenchJoints> goals;
  while (goals.size() < count) {
    const BenchJoints q = randomJoints(limits, &random);
    const Eigen::Isometry3d hand = dhFrames(q)[5];
    const Eigen::Vector3d p = hand.translation();
    if (hand.linear()(2, 2) > -0.9 || p.x() < 0.53 || p.x() > 0.71 || p.y() < -0.09 || p.y() > 0.11 ||
        p.z() < -0.12 || p.z() > 0)
      continue;
    if (peerValid(q) && world.valid(vectorOf(q))) goals.push_back(q);
  }
  return goals;
}

void BM_PathsSideBySide(benchmark::State& state) {
  const CollisionWorld world = boxWorld();
  const std::array<JointLimit, 6> limits = Puma560().options().joints;
  BenchJoints low, high;
  for (int i = 0; i < 6; ++i) {
    low[i] = limits[i].lower;
    high[i] = limits[i].upper;
  }
  const BenchJoints home{{M_PI / 2, M_PI / 2, -M_PI / 2, 0, 0.3, 0}};
  const std::vector<BenchJoints> goals = binGoals(world, limits, 20);

  std::vector<double> ours, peer, peer_plan, ours_length, peer_length;
  int missed = 0, peer_missed = 0;
  if (!peerValid(home) || !world.valid(vectorOf(home)))
    state.SkipWithError("the home configuration is not free");
  PathOptions options;
  options.resolution = 0.005 * (vectorOf(high) - vectorOf(low)).norm();  // the peer's
  PathTest test = testIn(world);

  for (auto _ : state)
    for (const BenchJoints& goal : goals)
      for (int run = 0; run < 10;
           ++run) {  // in turns, so that whatever else the machine does falls on both alike
        const PeerTimes times = peerPlan(home, goal, low, high);
        peer_missed += !times.found;
        peer.push_back(times.plan + times.simplify);
        peer_plan.push_back(times.plan);
        peer_length.push_back(times.length);
        options.seed = run + 1;
        const double begin = cpuSeconds();
        const JointPath path = planPath(limits, vectorOf(home), {vectorOf(goal)}, test, options);
        ours.push_back(cpuSeconds() - begin);
        missed += !path.found();
        double length = 0;
        for (size_t i = 0; i + 1 < path.points.size(); ++i)
          length += (path.points[i + 1] - path.points[i]).norm();
        ours_length.push_back(length);
      }

  state.counters["ours_ms"] = 1e3 * quantile(ours, 0.5);
  state.counters["ours_p99_ms"] = 1e3 * quantile(ours, 0.99);
  state.counters["peer_ms"] = 1e3 * quantile(peer, 0.5);
  state.counters["peer_plan_ms"] = 1e3 * quantile(peer_plan, 0.5);
  state.counters["ours_length"] = quantile(ours_length, 0.5);
  state.counters["peer_length"] = quantile(peer_length, 0.5);
  state.counters["runs"] = double(ours.size());
  state.counters["missed"] = missed;
  state.counters["peer_missed"] = peer_missed;
}
BENCHMARK(BM_PathsSideBySide)->Iterations(1);

template <class Valid>
void checkAll(benchmark::State& state, Valid&& valid) {
  const std::array<JointLimit, 6> limits = Puma560().options().joints;
  std::mt19937_64 random(7);
  std::vector<BenchJoints> joints(4096);
  for (BenchJoints& q : joints) q = randomJoints(limits, &random);
  size_t i = 0, free = 0;
  for (auto _ : state) free += valid(joints[i++ % joints.size()]);
  state.counters["free"] = double(free) / double(state.iterations());
}
void BM_PeerValid(benchmark::State& state) { checkAll(state, peerValid); }
BENCHMARK(BM_PeerValid);
void BM_ValidBoxes(benchmark::State& state) {
  const CollisionWorld world = boxWorld();
  checkAll(state, [&](const BenchJoints& q) { return world.valid(vectorOf(q)); });
}
BENCHMARK(BM_ValidBoxes);
void BM_ValidDemo(benchmark::State& state) {
  CollisionWorld world = demoWorld();
  world.setPadding(PlanningOptions().padding);
  checkAll(state, [&](const BenchJoints& q) { return world.valid(vectorOf(q)); });
}
BENCHMARK(BM_ValidDemo);

/// Two bridges and a grenade moved and turned at random in the frame, and how to take each from above.
std::vector<PickRequest> randomScene(CollisionWorld* world, std::mt19937_64* random) {
  const auto jitter = [&](double by) { return std::uniform_real_distribution<double>(-by, by)(*random); };
  const double fx = 0.55 + jitter(0.04), fy = jitter(0.08), yaw = jitter(0.3);
  const Rigid3 base_from_frame = at(fx, fy, kTableTop, yaw);
  world->move("frame", base_from_frame);
  std::vector<PickRequest> requests;
  const auto place = [&](const char* name, double x, double y, double height, double width) {
    const double own = yaw + jitter(0.12);
    const Eigen::Vector3d p = base_from_frame * Eigen::Vector3d(x + jitter(0.008), y + jitter(0.008), 1e-4);
    world->move(name, at(p.x(), p.y(), p.z(), own));
    PickRequest request = pickRequest(name, p.x(), p.y(), p.z() + height, own, width);
    requests.push_back(request);
  };
  place("bridge_0", -0.05, 0.042, 0.048, 0.040);
  place("bridge_1", -0.05, -0.042, 0.048, 0.040);
  place("grenade", 0.07, 0, 0.080, 0.058);
  return requests;
}

void BM_PickPlan(benchmark::State& state) {
  std::mt19937_64 random(11);
  CollisionWorld world = demoWorld();
  std::vector<double> times, durations;
  int planned = 0, penetrations = 0;

  for (auto _ : state)
    for (int scene = 0; scene < 70; ++scene)
      for (const PickRequest& request : randomScene(&world, &random)) {
        const double begin = seconds();
        const PickPlan plan = planPick(toolArm(), world, request);
        times.push_back(seconds() - begin);
        if (!plan.planned()) {
          state.SetLabel(toString(plan.outcome) + ": " + plan.reason);
          continue;
        }
        ++planned;
        durations.push_back(plan.duration());
        for (const PickMotion& motion : plan.motions)
          penetrations += !firstCollision(worldOf(motion.stage, world, request, plan), motion.trajectory,
                                          PathOptions().resolution / 10)
                               .first.empty();
      }

  state.counters["median_ms"] = 1e3 * quantile(times, 0.5);
  state.counters["p99_ms"] = 1e3 * quantile(times, 0.99);
  state.counters["plans"] = double(times.size());
  state.counters["planned"] = planned;
  state.counters["penetrations"] = penetrations;
  state.counters["motion_s"] = quantile(durations, 0.5);
}
BENCHMARK(BM_PickPlan)->Iterations(1);

}  // namespace
}  // namespace monocular_eye_hand
