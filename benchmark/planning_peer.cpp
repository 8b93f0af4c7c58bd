#include "planning_peer.h"

#include <fcl/fcl.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <ctime>
#include <memory>

namespace monocular_eye_hand {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Object = fcl::CollisionObjectd;

std::unique_ptr<Object> objectOf(const BenchBox& box) {
  auto object = std::make_unique<Object>(std::make_shared<fcl::Boxd>(box.size));
  object->setTranslation(box.centre);
  object->computeAABB();
  return object;
}

std::vector<std::unique_ptr<Object>> objectsOf(const std::vector<BenchBox>& boxes) {
  std::vector<std::unique_ptr<Object>> objects;
  for (const BenchBox& box : boxes) objects.push_back(objectOf(box));
  return objects;
}

bool meet(Object& a, Object& b) {
  if (!a.getAABB().overlap(b.getAABB())) return false;
  fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(&a, &b, request, result) > 0;
}

}  // namespace

double cpuSeconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

const std::vector<BenchBox>& armBoxes() {
  static const std::vector<BenchBox> boxes{
      {-1, {0, 0, -.33}, {.25, .25, .5}}, {1, {-.21, 0, .02}, {.56, .12, .10}},
      {0, {0, 0, .03}, {.18, .18, .22}},  {2, {0, 0, 0}, {.12, .12, .14}},
      {3, {0, -.18, 0}, {.10, .36, .10}}, {5, {0, 0, .06}, {.08, .08, .10}},
      {5, {0, 0, .17}, {.14, .05, .12}}};
  return boxes;
}
const std::vector<BenchBox>& worldBoxes() {  // floor, table, four walls of a bin, two posts, two blocks
  static const std::vector<BenchBox> boxes{
      {-1, {0, 0, -.75}, {3, 3, .1}},           {-1, {.75, 0, -.33}, {.7, 1.0, .06}},
      {-1, {.62, -.17, -.22}, {.30, .02, .14}}, {-1, {.62, .19, -.22}, {.30, .02, .14}},
      {-1, {.46, .01, -.22}, {.02, .36, .14}},  {-1, {.78, .01, -.22}, {.02, .36, .14}},
      {-1, {.5, -.36, -.05}, {.10, .10, .50}},  {-1, {.5, .36, -.05}, {.10, .10, .50}},
      {-1, {0, -.75, .1}, {.3, .1, .8}},        {-1, {.95, 0, .1}, {.1, .5, .8}}};
  return boxes;
}

Eigen::Isometry3d dhOffset(int i) {
  Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
  t.translate(Eigen::Vector3d(kA[i], 0, kD[i]));
  t.rotate(Eigen::AngleAxisd(kAlpha[i], Eigen::Vector3d::UnitX()));
  return t;
}

std::array<Eigen::Isometry3d, 6> dhFrames(const BenchJoints& q) {
  std::array<Eigen::Isometry3d, 6> frames;
  Eigen::Matrix4d t = Eigen::Matrix4d::Identity();
  for (int i = 0; i < 6; ++i) {
    const double c = std::cos(q[i]), s = std::sin(q[i]), ca = std::cos(kAlpha[i]), sa = std::sin(kAlpha[i]);
    Eigen::Matrix4d step;
    step << c, -s * ca, s * sa, kA[i] * c, s, c * ca, -c * sa, kA[i] * s, 0, sa, ca, kD[i], 0, 0, 0, 1;
    t = t * step;
    frames[i].matrix() = t;
  }
  return frames;
}

bool peerValid(const BenchJoints& q) {
  static const auto arm = objectsOf(armBoxes()), world = objectsOf(worldBoxes());
  const std::array<Eigen::Isometry3d, 6> frames = dhFrames(q);
  for (size_t i = 0; i < arm.size(); ++i) {
    const BenchBox& box = armBoxes()[i];
    if (box.frame < 0) continue;
    arm[i]->setTransform(frames[box.frame].linear(), frames[box.frame] * box.centre);
    arm[i]->computeAABB();
  }
  for (size_t i = 0; i < arm.size(); ++i) {
    if (armBoxes()[i].frame < 0) continue;
    for (const auto& object : world)
      if (meet(*arm[i], *object)) return false;
  }
  for (size_t i = 4; i < arm.size(); ++i)
    for (size_t j = 0; j < 2; ++j)
      if (meet(*arm[i], *arm[j])) return false;
  return true;
}

PeerTimes peerPlan(const BenchJoints& start, const BenchJoints& goal, const BenchJoints& low,
                   const BenchJoints& high) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  const auto space = std::make_shared<ob::RealVectorStateSpace>(6);
  ob::RealVectorBounds bounds(6);
  bounds.low.assign(low.begin(), low.end());
  bounds.high.assign(high.begin(), high.end());
  space->setBounds(bounds);

  og::SimpleSetup setup(space);
  setup.setStateValidityChecker([](const ob::State* s) {
    BenchJoints q;
    std::copy_n(s->as<ob::RealVectorStateSpace::StateType>()->values, 6, q.begin());
    return peerValid(q);
  });
  setup.getSpaceInformation()->setStateValidityCheckingResolution(0.005);

  ob::ScopedState<> from(space), to(space);
  for (int i = 0; i < 6; ++i) {
    from[i] = start[i];
    to[i] = goal[i];
  }
  setup.setStartAndGoalStates(from, to);
  setup.setPlanner(std::make_shared<og::RRTConnect>(setup.getSpaceInformation()));
  setup.setup();

  PeerTimes times;
  const double begin = cpuSeconds();
  times.found = setup.solve(5.0) == ob::PlannerStatus::EXACT_SOLUTION;
  const double planned = cpuSeconds();
  times.plan = planned - begin;
  if (!times.found) return times;
  setup.simplifySolution(1.0);
  times.simplify = cpuSeconds() - planned;
  times.length = setup.getSolutionPath().length();
  return times;
}

}  // namespace monocular_eye_hand
