#include "monocular_eye_hand/grasp/plan_grasps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "grasp_world.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/stable_poses.h"
#include "monocular_eye_hand/model/free_turns.h"
#include "monocular_eye_hand/options/options.h"
#include "support/pose_matchers.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using namespace grasp_world;
using testing::HasSubstr;

Rigid3 onTable(double x, double y, double turn, const Rigid3& table_from_object = {}) {
  return Rigid3{Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix(), {x, y, kTable}} *
         table_from_object;
}

GraspPlan plan(const ObjectModel& model, const Rigid3& base_from_object, const Matrix6d& covariance,
               const std::vector<GraspObstacle>& obstacles = {}, const GraspPlanOptions& options = {}) {
  GraspScene scene;
  scene.table_height = kTable;
  scene.obstacles = obstacles;
  return planGrasps({&model, base_from_object, covariance}, sampleGrasps(model, {}), scene, {}, Puma560(),
                    tool0FromTcp(), ready(), options);
}

// What every candidate promises.
void expectSound(const GraspPlan& found) {
  const Puma560 arm;
  const GraspPlanOptions options;
  double last = 1;

  for (const GraspCandidate& c : found.candidates) {
    EXPECT_LE(c.quality, last + 1e-9);
    last = c.quality;
    const std::pair<Rigid3, JointVector> stations[] = {{c.base_from_pregrasp, c.pregrasp_joints},
                                                       {c.base_from_grasp, c.grasp_joints},
                                                       {c.base_from_lift, c.lift_joints}};
    for (const auto& [pose, joints] : stations) {
      EXPECT_THAT(pose, PoseNear(arm.baseFromTool0(joints) * tool0FromTcp(), 0.001, 6e-05));
      EXPECT_TRUE(arm.withinLimits(joints));
      EXPECT_LE((joints - c.grasp_joints).cwiseAbs().maxCoeff(), options.max_joint_step);
      EXPECT_GE(std::abs(std::sin(joints[4])), options.min_wrist);
      EXPECT_EQ(joints[4] > 0, c.branch.wrist == Wrist::kPositive);
    }
    EXPECT_LT(c.approach.z(), -std::cos(options.max_tilt) + 1e-9);
    EXPECT_NEAR((c.base_from_grasp.translation - c.base_from_pregrasp.translation).dot(c.approach),
                options.approach_distance, 1e-12);
    EXPECT_NEAR(c.base_from_lift.translation.z() - c.base_from_grasp.translation.z(), options.lift_distance,
                1e-12);
    EXPECT_GE(c.clearance(), 0);
    EXPECT_NEAR(c.opening, c.part_width + 2 * c.free, 1e-12);
    const double lowest_tip = c.base_from_grasp.translation.z() + 0.009 * c.base_from_grasp.rotation(2, 2);
    EXPECT_GT(lowest_tip, kTable + options.table_clearance - 1e-9);
  }
}

TEST(PlanGrasps, ShippedPartsInAllTheirStablePoses) {
  for (const char* name : {"bridge", "grenade", "flange", "bracket"}) {
    const ObjectModel model = shipped(name);
    int reached = 0, all = 0;
    for (const StablePose& stable : stablePoses(model.mesh)) {
      if (stable.weight < 0.02) continue;
      for (int k = 0; k < 4; ++k) {
        const GraspPlan found =
            plan(model, onTable(0.42 + 0.05 * (k % 2), -0.2 + 0.1 * k, 0.7 * k, stable.table_from_object),
                 sigma(5e-4, 3e-3));
        ++all;
        reached += !found.candidates.empty();
        EXPECT_FALSE(found.candidates.empty()) << stable.weight << ' ' << found.reason;
        expectSound(found);
      }
    }
    EXPECT_GT(all, 3);
    EXPECT_EQ(reached, all) << name;
  }
}

TEST(PlanGrasps, AnUncertainPoseIsRefusedWithItsNumbers) {
  const ObjectModel model = boxModel(0.2, 0.08, 0.03);  // 5 mm on each side
  const Rigid3 pose = onTable(0.45, 0, 0);
  const GraspPlan sure = plan(model, pose, sigma(5e-4, 1e-3));
  ASSERT_FALSE(sure.candidates.empty()) << sure.reason;
  EXPECT_FALSE(sure.too_uncertain);
  EXPECT_NEAR(sure.candidates[0].free, 0.005, 1e-9);
  EXPECT_NEAR(sure.candidates[0].needed, 0.0025, 3e-4);
  const GraspPlan unsure = plan(model, pose, sigma(2.5e-3, 1e-3));
  EXPECT_TRUE(unsure.candidates.empty());
  EXPECT_TRUE(unsure.too_uncertain);
  EXPECT_THAT(unsure.reason,
              HasSubstr("3 sigma of the pose need 8.5 mm on each side of the part, the gripper "
                        "leaves 5 mm (opening 90 mm, part 80 mm)"));
}

TEST(PlanGrasps, TheDirectionOfTheUncertaintyCounts) {
  // Long box along x: uncertain along x it is held across y all the same; uncertain along y it is not.
  const ObjectModel model = boxModel(0.2, 0.08, 0.03);
  Matrix6d along = sigma(5e-4, 1e-3), across = along;
  along(0, 0) = across(1, 1) = 2.5e-3 * 2.5e-3;
  EXPECT_FALSE(plan(model, onTable(0.45, 0, 0), along).candidates.empty());
  EXPECT_TRUE(plan(model, onTable(0.45, 0, 0), across).candidates.empty());
  EXPECT_FALSE(plan(model, onTable(0.45, 0, M_PI / 2), across).candidates.empty());
}

TEST(PlanGrasps, UncertaintyAcrossAndAlongTheApproachCounts) {
  const ObjectModel model = boxModel(0.2, 0.03, 0.04);
  const auto with = [&](int direction, double metres) {
    Matrix6d covariance = sigma(3e-4, 1e-3);
    covariance(direction, direction) = metres * metres;
    GraspPlanOptions steep;  // from straight above only, closing along y
    steep.max_tilt = 0.05;
    return plan(model, onTable(0.45, 0, 0), covariance, {}, steep);
  };
  EXPECT_FALSE(with(2, 5e-4).candidates.empty());
  const GraspPlan high = with(2, 4e-3), aside = with(0, 4e-3), deep = with(2, 2.4e-3);
  EXPECT_TRUE(high.too_uncertain);
  EXPECT_THAT(high.reason, HasSubstr("need 12 mm along the approach, half a pad is 8 mm"));
  EXPECT_TRUE(aside.too_uncertain);
  EXPECT_THAT(aside.reason, HasSubstr("need 12 mm across the pads, half a pad is 9 mm"));
  for (const GraspCandidate& c : deep.candidates)  // the rail stays clear of the part's top by 3 sigma
    EXPECT_GT(c.base_from_grasp.translation.z() + 0.050 - 3 * 2.4e-3, kTable + 0.04);
}

TEST(PlanGrasps, TheVarianceOfAFreeAxisDoesNotCount) {
  const ObjectModel flange = shipped("flange");
  const Rigid3 pose = onTable(0.45, 0, 0.4);
  const Matrix6d held = conditionedOnFreeAxis(flange, pose, sigma(4e-4, 2e-3));
  const GraspPlan a = plan(flange, pose, held),
                  b = plan(flange, pose, withFreeAxisVariance(flange, pose, held));
  ASSERT_FALSE(a.candidates.empty()) << a.reason;
  ASSERT_EQ(a.candidates.size(), b.candidates.size());
  EXPECT_NEAR(a.candidates[0].needed, b.candidates[0].needed, 1e-9);
  std::set<int> directions;  // the free axis is used to come from many sides
  for (const GraspCandidate& c : a.candidates)
    directions.insert(int(
        std::lround(10 * std::atan2(c.base_from_grasp.rotation(1, 1), c.base_from_grasp.rotation(0, 1)))));
  EXPECT_GT(directions.size(), 4u);
}

TEST(PlanGrasps, ObstaclesAreKeptClearOf) {
  const ObjectModel bridge = shipped("bridge"), frame = shipped("frame"), wall = boxModel(0.02, 0.3, 0.15);
  const Rigid3 pose = onTable(0.45, 0, 0);
  const GraspPlan in_frame = plan(bridge, pose, sigma(5e-4, 2e-3), {{&frame, onTable(0.45, 0, 0)}});
  EXPECT_FALSE(in_frame.candidates.empty()) << in_frame.reason;
  expectSound(in_frame);
  const ObjectModel lid = boxModel(0.5, 0.5, 0.02);
  Rigid3 above = pose;
  above.translation.z() += 0.08;
  const GraspPlan covered = plan(bridge, pose, sigma(5e-4, 2e-3), {{&lid, above}});
  EXPECT_TRUE(covered.candidates.empty());
  EXPECT_FALSE(covered.too_uncertain);
  EXPECT_THAT(covered.reason, HasSubstr("meets an obstacle (the hand comes nearer than 3 mm to box"));
}

TEST(PlanGrasps, UnreachableIsAReason) {
  const GraspPlan far = plan(shipped("bridge"), onTable(3, 0, 0), sigma(5e-4, 2e-3));
  EXPECT_TRUE(far.candidates.empty());
  EXPECT_THAT(far.reason, HasSubstr("unreachable (the grasp is out of the arm's reach or limits)"));
  EXPECT_FALSE(far.too_uncertain);

  GraspPlanOptions no_wrist;
  no_wrist.min_wrist = 0.9999;
  EXPECT_THAT(plan(shipped("bridge"), onTable(0.45, 0, 0), sigma(5e-4, 2e-3), {}, no_wrist).reason,
              HasSubstr("near a singularity"));
}

TEST(PlanGrasps, AFlatPartOnTheTableCannotBeHeldFromBelow) {
  const GraspPlan flat = plan(boxModel(0.3, 0.05, 0.006), onTable(0.45, 0, 0), sigma(2e-4, 1e-3));
  EXPECT_TRUE(flat.candidates.empty());
  EXPECT_THAT(flat.reason, HasSubstr("meets the table"));
}

TEST(PlanGrasps, NoGraspsOfTheModelIsAReason) {
  KnownObject frame{shipped("frame"), {}, {}};
  frame.handling.obstacle = true;
  const GraspPlan none = planGrasps({&frame.model, {}, Matrix6d::Zero()}, graspsOf(frame, {}), {}, {},
                                    Puma560(), tool0FromTcp(), ready());
  EXPECT_TRUE(none.candidates.empty());
  EXPECT_THAT(none.reason, HasSubstr("frame is an obstacle"));
}

TEST(PlanGrasps, VariedFirstTakesNeighboursLast) {
  std::vector<GraspCandidate> all(5);
  for (size_t k = 0; k < all.size(); ++k) all[k].model_grasp = int(k);
  all[1].base_from_grasp.translation.x() = 0.01;  // a neighbour of 0
  all[2].base_from_grasp.translation.x() = 0.10;
  all[3].branch.elbow = Elbow::kDown;
  all[4].base_from_grasp.rotation = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const auto order = [&](int count) {
    std::vector<int> indices;
    for (const GraspCandidate& c : variedFirst(all, count)) indices.push_back(c.model_grasp);
    return indices;
  };
  EXPECT_THAT(order(9), testing::ElementsAre(0, 2, 3, 4, 1));
  EXPECT_THAT(order(2), testing::ElementsAre(0, 2));
  EXPECT_TRUE(variedFirst({}, 3).empty());
}

TEST(PlanGrasps, BadInputIsNamed) {
  const ObjectModel model = boxModel(0.1, 0.04, 0.04);
  const auto refusalAfter =
      [&](const std::function<void(GraspObject*, GraspScene*, GraspPlanOptions*, JointVector*)>& spoil) {
        GraspObject object{&model, onTable(0.45, 0, 0), sigma(5e-4, 2e-3)};
        GraspScene scene;
        GraspPlanOptions options;
        JointVector joints = ready();
        spoil(&object, &scene, &options, &joints);
        return refusal([&] {
          planGrasps(object, sampleGrasps(model, {}), scene, {}, Puma560(), tool0FromTcp(), joints, options);
        });
      };

  using O = GraspObject;
  using S = GraspScene;
  using P = GraspPlanOptions;
  using J = JointVector;
  EXPECT_THAT(refusalAfter([](O* o, S*, P*, J*) { o->model = nullptr; }), HasSubstr("no model"));
  EXPECT_THAT(refusalAfter([](O* o, S*, P*, J*) { o->base_from_object.rotation *= 2; }),
              HasSubstr("no rigid transform"));
  EXPECT_THAT(refusalAfter([](O* o, S*, P*, J*) { o->covariance(0, 0) = -1; }),
              HasSubstr("negative variance"));
  EXPECT_THAT(refusalAfter([](O*, S* s, P*, J*) { s->obstacles.push_back({}); }),
              HasSubstr("obstacle has no model"));
  EXPECT_THAT(refusalAfter([](O*, S*, P* p, J*) { p->max_tilt = 2; }), HasSubstr("max_tilt = 2"));
  EXPECT_THAT(refusalAfter([](O*, S*, P*, J* j) { (*j)[2] = NAN; }), HasSubstr("joint angles"));

  GraspPlanOptions options;
  EXPECT_THROW(readOptions(parseYaml("sigma: 2"), &options), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
