#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "map_world.h"
#include "monocular_eye_hand/geometry/covariance.h"
#include "monocular_eye_hand/model/equal_poses.h"
#include "monocular_eye_hand/model/free_turns.h"
#include "support/pose_matchers.h"

namespace monocular_eye_hand {
namespace {

using namespace map_world;

const Eigen::Vector3d kMiddle(0.45, 0, 0);

std::vector<Eigen::Vector3d> eyesAround(int count, double radius = 0.25, double height = 0.4) {
  std::vector<Eigen::Vector3d> eyes;
  for (int k = 0; k < count; ++k)
    eyes.push_back(kMiddle + Eigen::Vector3d(radius * std::cos(0.4 + k), radius * std::sin(0.4 + k), height));
  return eyes;
}

TEST(Fusion, ViewsShrinkTheImagePartOnly) {
  ObjectMap map(&models());
  const Rigid3 truth = upright(0.45, 0, 0.3);
  double first_image = 0, first_total = 0;

  // One camera direction, places apart: the hand-eye's error is the same in every view.
  for (int k = 0; k < 25; ++k) {
    const Eigen::Vector3d shift(0.012 * k - 0.15, 0, 0);
    map.add(view(k + 1, kMiddle + shift + Eigen::Vector3d(0, 0, 0.5), kMiddle + shift, {{kBridge, truth}}));
    const MappedObject o = map.objects().at(0);
    if (k == 0) {
      first_image = o.image_covariance(0, 0);
      first_total = o.covariance(0, 0);
    }
  }
  const MappedObject o = map.objects().at(0);
  EXPECT_EQ(o.views, 25);
  EXPECT_NEAR(o.image_covariance(0, 0), first_image / 25, 0.02 * first_image);
  const double hand_eye = 5e-4 * 5e-4;  // what no number of views takes away
  const double floor = 1e-4 * 1e-4;     // and what CAD and part differ by
  EXPECT_GT(o.covariance(0, 0), hand_eye + floor);
  EXPECT_LT(o.covariance(0, 0), first_total);
  EXPECT_THAT(truth, PoseNear(o.base_from_object, 1e-06, 6e-08));
}

TEST(Fusion, CovarianceAgreesWithMonteCarlo) {
  // Random image errors per view, one hand-eye and one set of joint errors per run.
  const Puma560 arm;
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  const auto draw = [&](const Matrix6d& covariance) -> Vector6d {
    Vector6d v;
    for (int k = 0; k < 6; ++k) v[k] = normal(generator);
    return Eigen::LLT<Matrix6d>(covariance).matrixL() * v;
  };

  ObjectMapOptions options;
  options.floor_position = options.floor_rotation = 1e-9;
  options.gate = 1e9;
  options.same_place = 10;
  options.arm.joint_sigma = {5e-4, 5e-4, 5e-4, 5e-4, 5e-4, 5e-4};

  const std::vector<JointVector> places = {(JointVector() << 0.2, 0.9, -2.4, 0.2, 0.3, 0).finished(),
                                           (JointVector() << -0.3, 0.8, -2.2, -0.6, 0.5, 0.7).finished(),
                                           (JointVector() << 0.1, 1.1, -2.6, 1.2, -0.4, -1.0).finished()};
  const HandEye eye = mounted();
  const Rigid3 truth = arm.baseFromTool0(places[0]) * eye.tool0_from_camera *
                       Rigid3{Eigen::AngleAxisd(2, Eigen::Vector3d(1, 2, 2).normalized()).toRotationMatrix(),
                              {0.02, -0.03, 0.4}};

  Matrix6d sampled = Matrix6d::Zero(), stated = Matrix6d::Zero();
  const int runs = 4000;
  for (int run = 0; run < runs; ++run) {
    ObjectMap map(&models(), options);
    const Rigid3 actual_eye = perturbed(eye.tool0_from_camera, draw(eye.covariance));
    JointVector zero_error;
    for (int k = 0; k < 6; ++k) zero_error[k] = options.arm.joint_sigma[size_t(k)] * normal(generator);
    for (size_t i = 0; i < places.size(); ++i) {
      ObjectView v;
      v.stamp = double(i);
      v.camera = camera();
      v.complete = false;
      v.hand = handPose(arm, places[i]);
      v.hand_eye = eye;
      const Matrix6d image = imageCovariance(1e-3 * (1 + double(i)), 4e-3);
      const Rigid3 actual = (arm.baseFromTool0(places[i] + zero_error) * actual_eye).inverse() * truth;
      v.objects = {{kBracket, perturbed(actual, draw(image)), image, 0.9}};
      map.add(v);
    }
    ASSERT_EQ(map.objects().size(), 1u);
    ASSERT_EQ(map.objects()[0].views, 3);
    const MappedObject o = map.objects()[0];
    const Vector6d d =
        difference(truth, nearestEqualPose(models().objects[kBracket].model, o.base_from_object, truth));
    sampled += d * d.transpose() / runs;
    stated = o.covariance;
  }

  stated.diagonal().head<3>().array() -= options.arm.position_sigma * options.arm.position_sigma;
  const Vector6d scale = stated.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix6d gap = scale.asDiagonal() * (sampled - stated) * scale.asDiagonal();
  EXPECT_LT(gap.cwiseAbs().maxCoeff(), 0.1) << gap;
}

TEST(Fusion, SymmetricPosesAreOne) {
  // The bridge looks the same turned by half about z.
  ObjectMap map(&models());
  const ObjectModel& bridge = models().objects[kBridge].model;
  ASSERT_GT(bridge.symmetries.discrete.size(), 1u);
  const Rigid3 truth = upright(0.45, 0.02, 0.3);
  double stamp = 0;
  for (const Eigen::Vector3d& eye : eyesAround(6)) {
    const Rigid3 equal =
        truth * bridge.symmetries.discrete[size_t(stamp) % bridge.symmetries.discrete.size()];
    map.add(view(++stamp, eye, kMiddle, {{kBridge, equal}}));
  }
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.objects()[0].views, 6);
  EXPECT_THAT(nearestEqualPose(bridge, map.objects()[0].base_from_object, truth),
              PoseNear(truth, 1e-06, 6e-08));
}

TEST(Fusion, AFreeAxisIsNotAveraged) {
  const ObjectModel& flange = models().objects[kFlange].model;
  ASSERT_TRUE(flange.symmetries.axis.has_value());

  ObjectMap map(&models());
  const Rigid3 truth = upright(0.45, 0.02, 0.3);
  double stamp = 0;
  for (const Eigen::Vector3d& eye : eyesAround(6)) {
    ObjectView v =
        view(stamp + 1, eye, kMiddle, {{kFlange, truth * rotationAbout(*flange.symmetries.axis, stamp)}});
    SeenObject& seen = v.objects[0];
    seen.covariance =
        withFreeAxisVariance(flange, seen.camera_from_object,
                             conditionedOnFreeAxis(flange, seen.camera_from_object, seen.covariance));
    const ViewReport report = map.add(v);
    EXPECT_LT(report.decisions.at(0).chi_square, 1e-6);
    ++stamp;
  }
  const MappedObject o = map.objects().at(0);
  EXPECT_EQ(o.views, 6);
  EXPECT_TRUE(o.free_axis);
  EXPECT_NEAR(o.covariance(5, 5), M_PI * M_PI / 3, 1e-3);
  EXPECT_LT(o.covariance(3, 3), 4e-3 * 4e-3);
  EXPECT_LT((o.base_from_object.rotation.col(2) - truth.rotation.col(2)).norm(), 1e-9);
}

}  // namespace
}  // namespace monocular_eye_hand
