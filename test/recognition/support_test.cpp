// A known plane that parts stand on: what it rules out, and what it speaks for.
#include "recognition/support.h"

#include "model/build_model.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/look_at.h"
#include "monocular_eye_hand/simulation/render/render.h"
#include "support/pose_matchers.h"
#include "world.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

const ObjectModel& brick() {
  static const ObjectModel model = buildModel("brick", boxMesh({0.10, 0.06, 0.02}));
  return model;
}

const ObjectModel& roller() {
  static const ObjectModel model = buildModel("roller", cylinderMesh(0.02, 0.08, 24));
  return model;
}

// Seen from above, from the side, and askew.
std::vector<Rigid3> cameras() {
  return {lookAt({0, -0.01, 0.6}, {0, 0, 0}), lookAt({0.6, 0, 0.1}, {0, 0, 0}),
          lookAt({0.3, -0.4, 0.3}, {0, 0, 0})};
}

// The table's top, z = 0 of the world.
Support tableSeenBy(const Rigid3& world_from_camera, const ObjectModel& model) {
  const Rigid3 camera_from_world = world_from_camera.inverse();
  Support support;
  support.plane.normal = camera_from_world.rotation.col(2);
  support.plane.offset = support.plane.normal.dot(camera_from_world.translation);
  support.up_at_rest = {directionsUpAtRest(model)};
  support.rest_log_odds = 2;
  return support;
}

SupportEvidence evidenceAt(const Rigid3& world_from_camera, const ObjectModel& model,
                           const Rigid3& world_from_object, double sigma_of_height = 0.0005) {
  RefinedPose pose;
  pose.camera_from_object = world_from_camera.inverse() * world_from_object;
  pose.covariance.diagonal() << Eigen::Vector3d::Constant(sigma_of_height * sigma_of_height),
      Eigen::Vector3d::Constant(1e-6);
  return evidenceOfSupport(tableSeenBy(world_from_camera, model), 0, model, pose);
}

Rigid3 turnedAbout(const Eigen::Vector3d& axis, double angle, const Eigen::Vector3d& translation) {
  return {expSO3(angle * axis), translation};
}

// boxMesh() and cylinderMesh() stand on z = 0.
TEST(DirectionsUpAtRest, OfABrickAreItsSixSides) {
  const std::vector<Eigen::Vector3d> up = directionsUpAtRest(brick());
  ASSERT_EQ(up.size(), 6u);
  for (const Eigen::Vector3d& direction : up) EXPECT_NEAR(direction.cwiseAbs().maxCoeff(), 1, 1e-9);
}

TEST(DirectionsUpAtRest, OfASheetWithoutThicknessAreNone) {
  EXPECT_TRUE(directionsUpAtRest(buildModel("sheet", quadMesh(0.1, 0.1))).empty());
}

TEST(Support, GainsWhenThePartRestsOnEachOfItsSides) {
  for (const Rigid3& world_from_camera : cameras()) {
    EXPECT_GT(evidenceAt(world_from_camera, brick(), {}).rests, 0.95);
    const Rigid3 on_its_edge = turnedAbout({1, 0, 0}, M_PI / 2, {0, 0, 0.03});
    EXPECT_GT(evidenceAt(world_from_camera, brick(), on_its_edge).log_odds, 1.9);
  }
}

TEST(Support, GainsNothingForAPartThatLeansOrLiesOnAnother) {
  for (const Rigid3& world_from_camera : cameras()) {
    const SupportEvidence leans =
        evidenceAt(world_from_camera, brick(), turnedAbout({1, 0, 0}, 0.3, {0, 0, 0.03 * std::sin(0.3)}));
    EXPECT_LT(leans.rests, 0.01);
    EXPECT_EQ(leans.refused, "");

    const SupportEvidence on_another =
        evidenceAt(world_from_camera, brick(), {Eigen::Matrix3d::Identity(), {0, 0, 0.02}});
    EXPECT_LT(on_another.rests, 0.01);
    EXPECT_EQ(on_another.refused, "");
  }
}

TEST(Support, RefusesAPoseThatReachesBelowByMoreThanToleranceAndThreeSigmas) {
  for (const Rigid3& world_from_camera : cameras()) {
    const Rigid3 sunk{Eigen::Matrix3d::Identity(), {0, 0, -0.012}};
    const SupportEvidence evidence = evidenceAt(world_from_camera, brick(), sunk);
    EXPECT_THAT(evidence.refused, HasSubstr("reaches 12.0 mm below the support plane"));
    EXPECT_LT(evidence.log_odds, -100);
    EXPECT_EQ(evidenceAt(world_from_camera, brick(), sunk, 0.004).refused, "")
        << "its height may be so much off";
  }
}

TEST(Support, LetsARollerLieOnAnyLineOfItsSide) {
  ASSERT_TRUE(roller().symmetries.axis) << "24 facets are a cylinder";
  for (double angle : {0.0, 0.05, 0.13, 1.0}) {
    const Rigid3 lying{expSO3({M_PI / 2, 0, 0}) * expSO3({0, 0, angle}), {0, 0.04, 0.02}};
    EXPECT_GT(evidenceAt(cameras()[2], roller(), lying).rests, 0.9) << angle;
  }
}

TEST(SupportPlane, ThatIsNoneIsRefusedByName) {
  SupportPlane plane;
  EXPECT_NO_THROW(plane.check());
  plane.normal = {0, 0, 2};
  EXPECT_THROW(plane.check(), BadInput);
  plane = {};
  plane.offset = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(plane.check(), BadInput);
  plane = {};
  plane.tolerance = -1;
  EXPECT_THROW(plane.check(), BadInput);
}

// A bridge on the table, seen by a camera that knows the table, or a plane that is not where the table is.
class KnownTable : public testing::Test {
 protected:
  static RecognitionResult recognized(const std::optional<SupportPlane>& support) {
    const Scene scene = plainScene({standing("bridge", shippedModel("bridge").mesh)}, camera());
    const RenderedImage image = renderScene(scene, testCamera());
    RecognitionRequest request;
    request.support = support;
    static const Recognizer recognizer(someModels({"bridge"}));
    return recognizer.recognize(image.grey, testCamera(), request);
  }
  static double lowest() { return shippedModel("bridge").bounds.min().z(); }
  static Rigid3 camera() { return lookAt({0.25, -0.35, 0.4}, {0, 0, 0.02}); }
  static SupportPlane planeAt(double height) {
    SupportPlane plane = tableSeenBy(camera(), shippedModel("bridge")).plane;
    plane.offset += height;
    return plane;
  }
};

TEST_F(KnownTable, MakesWhatRestsOnItLikelier) {
  const RecognitionResult without = recognized({}), with = recognized(planeAt(lowest()));
  ASSERT_EQ(without.objects.size(), 1u) << listed(without);
  ASSERT_EQ(with.objects.size(), 1u) << listed(with);
  EXPECT_GE(with.objects[0].probability, without.objects[0].probability);
  EXPECT_THAT(without.objects[0].camera_from_object,
              PoseNear(with.objects[0].camera_from_object, 1e-06, 6e-08));
}

TEST_F(KnownTable, RefusesWhatWouldLieBelowAndSaysWhy) {
  const RecognitionResult result = recognized(planeAt(lowest() + 0.05));
  EXPECT_TRUE(result.objects.empty()) << listed(result);
  EXPECT_THAT(result.reason, HasSubstr("below the support plane"));
}

// A camera that looks straight down from 0.6 m.
TEST(SupportPlane, IsThatOfTheFrameInTheCamerasAxes) {
  Rigid3 camera_from_base;
  camera_from_base.rotation = Eigen::Vector3d(1, -1, -1).asDiagonal();
  camera_from_base.translation = {0.1, 0.2, 0.6};
  const SupportPlane plane = supportPlane(camera_from_base, 0.25, 0.007);
  EXPECT_NO_THROW(plane.check());
  EXPECT_NEAR(plane.normal.dot(Eigen::Vector3d(0, 0, 0.35)), plane.offset, 1e-12);
  EXPECT_GT(plane.normal.dot(Eigen::Vector3d(0.3, -0.2, 0.34)), plane.offset)
      << "nearer to the camera is above";
  EXPECT_EQ(plane.tolerance, 0.007);
}

}  // namespace
}  // namespace monocular_eye_hand
