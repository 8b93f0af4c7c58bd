#include "monocular_eye_hand/task/camera_views.h"

#include <gmock/gmock.h>

#include <cmath>
#include <utility>

#include "monocular_eye_hand/arm/load_arm_description.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/task/drop_places.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

const Eigen::Vector3d kTarget(0.55, 0.05, 0.32);

class CameraViews : public testing::Test {
 protected:
  CameraViews() { current_ << 0, 0.8, -2.6, 0, -1.3, 0; }
  std::vector<Rigid3> views(const TaskView& view, const Eigen::Vector3d& target = kTarget,
                            const CameraViewOptions& options = {}) const {
    return cameraViews(view, target, arm_, description_.tool0_from_camera, current_, options);
  }
  static double azimuth(const Rigid3& base_from_camera) {
    const Eigen::Vector3d d = base_from_camera.translation - kTarget;
    return std::atan2(d.y(), d.x());
  }

  const Puma560 arm_;
  const ArmDescription description_ =
      loadArmDescription(std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/urdf/puma560.urdf");
  JointVector current_;
};

TaskView overview(int i) {
  TaskView view;
  view.overview = view.direction = i;
  return view;
}

TaskView nearLook(int approach) {
  TaskView view;
  view.near = true;
  view.approach = view.direction = approach;
  return view;
}

TaskView search(int direction) {
  TaskView view;
  view.search = true;
  view.direction = direction;
  return view;
}

TEST_F(CameraViews, LookAtTheTargetFromWithinReach) {
  const CameraViewOptions options;
  for (const TaskView& view : {overview(0), overview(1), overview(2), search(0), search(1), search(2),
                               nearLook(0), nearLook(1), nearLook(3)}) {
    const std::vector<Rigid3> poses = views(view);
    ASSERT_FALSE(poses.empty());
    EXPECT_LE(int(poses.size()), options.max_views);
    for (const Rigid3& pose : poses) {
      const Eigen::Vector3d in_camera = pose.inverse() * kTarget;
      EXPECT_NEAR(in_camera.head<2>().norm(), 0, 1e-9) << "the target is in the middle of the image";
      EXPECT_GE(in_camera.z(), options.min_distance - 1e-9);
      EXPECT_LE(in_camera.z(), view.near ? options.near_distance + 1e-9 : options.overview_distance + 1e-9);
      EXPECT_GT(pose.translation.z(), kTarget.z() + 0.1);
      ArmSolutions solutions;
      arm_.inverse(pose * description_.tool0_from_camera.inverse(), current_, &solutions);
      EXPECT_FALSE(solutions.empty());
    }
  }
}

TEST_F(CameraViews, SuccessiveViewsCross) {
  for (const auto& [a, b] : {std::pair{overview(0), overview(1)}, std::pair{search(1), search(2)},
                             std::pair{nearLook(0), nearLook(1)}}) {
    const Eigen::Vector3d from_a = (views(a)[0].translation - kTarget).normalized();
    const Eigen::Vector3d from_b = (views(b)[0].translation - kTarget).normalized();
    EXPECT_GT(std::acos(from_a.dot(from_b)), 0.15);
  }
}

TEST_F(CameraViews, EveryNearLookIsNearerUntilTheNearest) {
  const CameraViewOptions options;
  double before = 1e9;
  for (int approach : {0, 1}) {
    const double distance = (views(nearLook(approach))[0].translation - kTarget).norm();
    EXPECT_LT(distance, before);
    before = distance;
  }
  EXPECT_NEAR((views(nearLook(9))[0].translation - kTarget).norm(), options.min_distance, 1e-9);
}

TEST_F(CameraViews, ASearchIsNearerAndLowerThanAnOverview) {
  const Eigen::Vector3d far = views(overview(1))[0].translation - kTarget,
                        near = views(search(1))[0].translation - kTarget;
  EXPECT_LT(near.norm(), far.norm());
  EXPECT_LT(near.normalized().z(), far.normalized().z());
}

TEST_F(CameraViews, TheSameQuestionHasTheSameAnswer) {
  const std::vector<Rigid3> once = views(overview(1)), again = views(overview(1));
  ASSERT_EQ(once.size(), again.size());
  for (size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].rotation, again[i].rotation);
    EXPECT_EQ(once[i].translation, again[i].translation);
  }
}

TEST_F(CameraViews, OutOfReachThereIsNone) { EXPECT_TRUE(views(overview(0), {3, 0, 0.3}).empty()); }

TEST_F(CameraViews, WhatIsWrongIsNamed) {
  const auto refusalOf = [&](const CameraViewOptions& options) {
    return refusal([&] { views(overview(0), kTarget, options); });
  };
  CameraViewOptions options;
  options.min_distance = 0.5;
  EXPECT_THAT(refusalOf(options), testing::HasSubstr("min_distance"));
  options = {};
  options.overview_elevation = 2;
  EXPECT_THAT(refusalOf(options), testing::HasSubstr("overview_elevation"));
  options = {};
  options.max_views = 0;
  EXPECT_THAT(refusalOf(options), testing::HasSubstr("max_views"));
  EXPECT_THROW(views(overview(0), {NAN, 0, 0}), BadInput);
}

TEST(LookTarget, IsTheObjectThenTheFrameThenWhereTheFrameIsSaidToStand) {
  ModelBase models;
  models.objects.resize(1);
  models.objects[0].model.bounds.extend(Eigen::Vector3d(0, 0, 0));
  models.objects[0].model.bounds.extend(Eigen::Vector3d(0.2, 0, 0.1));
  const Eigen::Vector3d middle = models.objects[0].model.centre();
  MappedObject frame;
  frame.object = 0;
  frame.base_from_object.translation = {0.5, 0.1, 0.3};
  const std::array<double, 3> centre{{0.6, 0, 0.3}};

  EXPECT_EQ(lookTarget(overview(0), std::nullopt, centre, models), Eigen::Vector3d(0.6, 0, 0.3));
  EXPECT_TRUE(
      lookTarget(overview(0), frame, centre, models).isApprox(Eigen::Vector3d(0.5, 0.1, 0.3) + middle));
  TaskView near = nearLook(0);
  near.object = frame;
  near.object.base_from_object.translation = {0.4, 0, 0.3};
  EXPECT_TRUE(lookTarget(near, frame, centre, models).isApprox(Eigen::Vector3d(0.4, 0, 0.3) + middle));
}

TEST(DropPlaceCount, GoesOnOrBeginsAgain) {
  DropPlaceCount places;
  EXPECT_EQ(places.of(0), 0);
  places.take(places.of(0));
  places.take(places.of(1));
  EXPECT_EQ(places.next(), 2);

  places.restart(true);
  EXPECT_EQ(places.of(0), 2);
  places.take(places.of(0));
  EXPECT_EQ(places.next(), 3);
  places.restart(false);
  EXPECT_EQ(places.of(0), 0);
  EXPECT_EQ(places.next(), 0);
}

TEST(GripOf, HoldsWhenStalledAndNotClosed) {
  EXPECT_TRUE(gripOf({0, 0.04, false, true}, 0.002).holding);
  EXPECT_EQ(gripOf({0, 0.04, false, true}, 0.002).reason, "width 40.0 mm, stalled");
  EXPECT_FALSE(gripOf({0, 0.001, false, true}, 0.002).holding);
  const TaskGrip open = gripOf({0, 0.04, false, false}, 0.002);
  EXPECT_TRUE(open.known);
  EXPECT_FALSE(open.holding);
}

}  // namespace
}  // namespace monocular_eye_hand
