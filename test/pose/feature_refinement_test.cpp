#include "monocular_eye_hand/pose/feature_refinement.h"

#include <gmock/gmock.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>
#include "monocular_eye_hand/pose/refine.h"
#include "support/camera.h"

namespace monocular_eye_hand {
namespace {

constexpr int kFeatures = 8;

Camera camera() { return centredCamera(640, 480, 700); }

Rigid3 truth() {
  Rigid3 p;
  p.rotation = expSO3({2.4, 0.2, 0.3});
  p.translation = {0.02, -0.01, 0.5};
  return p;
}

// The outlines of two squares of 10 cm, one 4 cm above the other, seen under truth(): eight features of
// `per_edge` samples each, from one end to the other.
struct Contour {
  explicit Contour(int per_edge) : per_edge(per_edge) {
    int group = 0;
    for (double z : {0.0, 0.04})
      for (int side = 0; side < 4; ++side, ++group) {
        const auto corner = [&](int k) {
          return Eigen::Vector3d((k + 1) % 4 < 2 ? -0.05 : 0.05, k % 4 < 2 ? -0.05 : 0.05, z);
        };
        const Eigen::Vector3d a = corner(side), b = corner(side + 1);
        const Eigen::Vector2d d = camera().project(truth() * b) - camera().project(truth() * a);
        for (int i = 0; i < per_edge; ++i) {
          const Eigen::Vector3d p = a + (i + 0.5) / per_edge * (b - a);
          FeatureSample sample;
          sample.line = {p, camera().project(truth() * p), Eigen::Vector2d(-d.y(), d.x()).normalized(), 0.3};
          sample.feature = group;
          sample.appearance.blur = 1.1;
          samples.push_back(sample);
        }
      }
  }
  // Moves a feature's edge across itself: by `offset` in its middle, more by `slope` at its end [px].
  void displace(int feature, double offset, double slope = 0) {
    for (int i = 0; i < per_edge; ++i) {
      LineMatch& match = samples[size_t(feature * per_edge + i)].line;
      match.uv += (offset + slope * ((2.0 * i + 1) / per_edge - 1)) * match.normal;
    }
  }
  RefinedPose refined(const Rigid3& start, const FreeAxis& axis = {}) const {
    return refineByFeatures(start, camera(), samples, axis);
  }
  int per_edge;
  std::vector<FeatureSample> samples;
};

double distance(const Rigid3& a, const Rigid3& b) { return difference(a, b).norm(); }

Rigid3 nearTruth() {
  Vector6d d;
  d << 3e-4, -2e-4, 4e-4, 1e-3, -1e-3, 5e-4;
  return perturbed(truth(), d);
}

TEST(FeatureRefinement, FindsThePoseOfExactSamples) {
  const RefinedPose refined = Contour(20).refined(nearTruth());
  ASSERT_TRUE(refined.well_posed);
  EXPECT_LT(distance(refined.camera_from_object, truth()), 0.02 * distance(nearTruth(), truth()));
  EXPECT_LT(refined.rms, 0.02);
  EXPECT_EQ(refined.inliers, 160);
}

TEST(FeatureRefinement, CovarianceIsSymmetricPositiveAndOfAPlausibleSize) {
  const Matrix6d c = Contour(20).refined(truth()).covariance;
  EXPECT_EQ(c, c.transpose());
  EXPECT_EQ(Eigen::LLT<Matrix6d>(c).info(), Eigen::Success);
  for (int i = 0; i < 2; ++i) {  // a fraction of a pixel: 0.7 mm each
    EXPECT_GT(std::sqrt(c(i, i)), 1e-6);
    EXPECT_LT(std::sqrt(c(i, i)), 3e-4);
  }
  EXPECT_GT(c(2, 2), c(0, 0)) << "depth is the least certain";
}

TEST(FeatureRefinement, MoreSamplesOfTheSameFeaturesDoNotMakeTheCovarianceVanish) {
  const auto sigma = [](int samples) {
    return std::sqrt(Contour(samples).refined(truth()).covariance(2, 2));
  };
  EXPECT_LT(sigma(20), sigma(5));
  EXPECT_LT(sigma(500), sigma(20));
  EXPECT_GT(sigma(500), 0.1 * sigma(20)) << "a feature as a whole is only so certain";
}

TEST(FeatureRefinement, AFeatureThatDisagreesCountsLittle) {
  for (int feature = 0; feature < kFeatures; ++feature) {
    Contour contour(20);
    contour.displace(feature, 1.0);
    const RefinedPose refined = contour.refined(truth());
    RefineOptions alike;
    alike.robust_scale = 0;
    std::vector<LineMatch> lines;
    for (const FeatureSample& sample : contour.samples) lines.push_back(sample.line);
    const RefinedPose plain = refinePose(truth(), camera(), lines, {}, alike);
    EXPECT_LT(distance(refined.camera_from_object, truth()),
              0.25 * distance(plain.camera_from_object, truth()))
        << feature;
  }
}

TEST(FeatureRefinement, AnEdgeWhoseProfileIsNoCleanStepCountsLittle) {
  for (double blur : {0.9, 1.3}) {
    Contour clean(20), doubtful(20);
    for (Contour* contour : {&clean, &doubtful}) contour->displace(0, 0.3);
    for (int i = 0; i < 20; ++i) doubtful.samples[size_t(i)].appearance.blur = blur;
    EXPECT_LT(distance(doubtful.refined(truth()).camera_from_object, truth()),
              0.5 * distance(clean.refined(truth()).camera_from_object, truth()))
        << blur;
    EXPECT_GT(doubtful.refined(truth()).covariance.trace(),
              1.02 * Contour(20).refined(truth()).covariance.trace());
  }
}

TEST(FeatureRefinement, AnEdgeThatMayBeDisplacedCountsLittle) {
  Contour sharp(20);
  sharp.displace(0, 0.5);
  Contour round = sharp;
  for (int i = 0; i < 20; ++i) round.samples[size_t(i)].displacement = 2;
  EXPECT_LT(distance(round.refined(truth()).camera_from_object, truth()),
            0.5 * distance(sharp.refined(truth()).camera_from_object, truth()));
}

TEST(FeatureRefinement, DisagreementWidensTheCovariance) {
  Contour contour(20);
  const Matrix6d agreeing = contour.refined(truth()).covariance;
  for (int feature = 0; feature < kFeatures; ++feature) contour.displace(feature, feature % 3 - 1.0, 0.3);
  EXPECT_GT(contour.refined(truth()).covariance(2, 2), 4 * agreeing(2, 2));
}

TEST(FeatureRefinement, ErrorsCommonToAFeatureLieWithinTheCovariance) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  constexpr int kDraws = 300;
  double mean = 0;  // of the squared errors in units of the covariance, 6 when it is honest
  for (int draw = 0; draw < kDraws; ++draw) {
    Contour contour(20);
    for (int feature = 0; feature < kFeatures; ++feature)
      contour.displace(feature, 0.1 * normal(random), 0.1 * normal(random));
    for (FeatureSample& sample : contour.samples) sample.line.uv += 0.1 * normal(random) * sample.line.normal;
    const RefinedPose refined = contour.refined(truth());
    const Vector6d error = difference(truth(), refined.camera_from_object);
    mean += error.dot(refined.covariance.ldlt().solve(error)) / kDraws;
  }
  EXPECT_GT(mean, 2);
  EXPECT_LT(mean, 14);
}

TEST(FeatureRefinement, OutliersSayNothing) {
  Contour contour(20);
  const RefinedPose clean = contour.refined(nearTruth());
  for (int i = 0; i < 50; ++i) {
    FeatureSample far = contour.samples[size_t(i)];
    far.line.uv += 30 * far.line.normal;
    contour.samples.push_back(far);
  }
  const RefinedPose same = contour.refined(nearTruth());
  EXPECT_LT(distance(same.camera_from_object, clean.camera_from_object), 1e-12);
  EXPECT_LT((same.covariance - clean.covariance).norm(), 1e-12 * clean.covariance.norm());
}

TEST(FeatureRefinement, WithoutUsableSamplesItIsNotWellPosed) {
  EXPECT_FALSE(refineByFeatures(truth(), camera(), {}, {}).well_posed);
  Contour contour(5);
  for (FeatureSample& sample : contour.samples) sample.line.uv.setConstant(std::nan(""));
  const RefinedPose refined = contour.refined(truth());
  EXPECT_FALSE(refined.well_posed);
  EXPECT_LT(distance(refined.camera_from_object, truth()), 1e-15);
}

TEST(FeatureRefinement, TheTurnAboutAFreeAxisIsOpenAndNothingElse) {
  FreeAxis axis;
  axis.present = true;
  axis.point = {0.01, 0.02, 0};
  axis.direction = Eigen::Vector3d::UnitZ();
  const Contour contour(20);
  const Matrix6d held = contour.refined(truth(), axis).covariance, seen = contour.refined(truth()).covariance;
  const Eigen::Vector3d direction = truth().rotation * axis.direction;
  const auto about = [&](const Matrix6d& c) {
    return direction.dot(c.bottomRightCorner<3, 3>() * direction);
  };
  EXPECT_NEAR(about(held), M_PI * M_PI / 3, 0.01);
  EXPECT_LT(about(seen), 1e-3);
  const Eigen::Vector3d tilt = direction.unitOrthogonal();
  EXPECT_LT(tilt.dot(held.bottomRightCorner<3, 3>() * tilt), 1e-3);

  // The point on the axis stays where it is: its covariance is small, though the turn is open.
  const Eigen::Vector3d arm = truth() * axis.point - truth().translation;
  Eigen::Matrix<double, 3, 6> moves;
  moves << Eigen::Matrix3d::Identity(), -skew(arm);
  EXPECT_LT((moves * held * moves.transpose()).trace(), 1e-5);
}

}  // namespace
}  // namespace monocular_eye_hand
