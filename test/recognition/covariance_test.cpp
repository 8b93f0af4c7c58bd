// Whether poses scatter as their covariance says. Real pictures: data_test.cpp.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cstdio>
#include <opencv2/core.hpp>

#include "monocular_eye_hand/simulation/render/render.h"
#include "world.h"

namespace monocular_eye_hand {
namespace {

struct Sample {
  Vector6d error;  ///< from the truth, modulo symmetry
  Matrix6d covariance;
};

class Covariance : public testing::TestWithParam<const char*> {
 protected:
  Covariance() : recognizer_(someModels({GetParam()})) {}

  const ObjectModel& model() const { return recognizer_.models().objects[0].model; }
  Scene scene(double azimuth, double elevation) const {
    return plainScene({standing(GetParam(), model().mesh)}, lookFrom(azimuth, elevation, 0.5, {0, 0, 0.03}));
  }
  std::vector<Sample> look(const cv::Mat& grey, const Rigid3& truth) const {
    const RecognitionResult result = recognizer_.recognize(grey, testCamera());
    std::vector<Sample> samples;
    for (const ObjectEstimate& o : result.objects) {
      const Rigid3 pose = nearestEqualPose(model(), o.camera_from_object, truth);
      if (poseError(model(), testCamera(), pose, truth).image < 5)
        samples.push_back({difference(truth, pose), o.covariance});
    }
    return samples;
  }

  Recognizer recognizer_;
};

// Mean of the squared errors in units of the covariance, per degree of freedom: 1 when it is honest.
double normalizedSquare(const std::vector<Sample>& samples, const Vector6d& around) {
  double sum = 0;
  for (const Sample& s : samples) {
    const Vector6d d = s.error - around;
    sum += d.dot(s.covariance.ldlt().solve(d)) / 6;
  }
  return sum / double(samples.size());
}

TEST_P(Covariance, NoiseScattersThePoseWithinWhatItSays) {
  const Scene seen = scene(0.7, 0.75);
  RenderOptions clean;
  clean.noise_sigma = clean.shot_noise = 0;
  const cv::Mat picture = renderScene(seen, testCamera(), clean).grey;

  std::vector<Sample> samples;
  cv::RNG random(11);
  const int renders = 30;
  for (int i = 0; i < renders; ++i) {
    cv::Mat noise(picture.size(), CV_16SC1), noisy;
    random.fill(noise, cv::RNG::NORMAL, 0, 3);
    cv::add(picture, noise, noisy, {}, CV_8U);
    for (const Sample& s : look(noisy, seen.cameraFromObject(0))) samples.push_back(s);
  }
  ASSERT_EQ(samples.size(), size_t(renders)) << "found exactly once in every picture";

  Vector6d mean = Vector6d::Zero(), scatter = Vector6d::Zero(), reported = Vector6d::Zero();
  for (const Sample& s : samples) mean += s.error / renders;
  for (const Sample& s : samples) {
    scatter += (s.error - mean).cwiseAbs2() / (renders - 1);
    reported += s.covariance.diagonal() / renders;
  }
  const Vector6d ratio = (scatter.array() / reported.array()).sqrt();
  const double whole = normalizedSquare(samples, mean);
  std::printf(
      "%s: scatter / reported standard deviation x %.2f y %.2f z %.2f rx %.2f ry %.2f rz %.2f; "
      "normalised square %.2f around the mean, %.2f around the truth; reported sigma z %.2f mm\n",
      GetParam(), ratio[0], ratio[1], ratio[2], ratio[3], ratio[4], ratio[5], whole,
      normalizedSquare(samples, Vector6d::Zero()), 1e3 * std::sqrt(reported[2]));

  // Sensor noise is a small part of what the covariance allows for: it covers errors common to a feature,
  // too.
  EXPECT_GT(ratio.minCoeff(), 0.02);
  EXPECT_LT(ratio.maxCoeff(), 1.5);
  EXPECT_LT(whole, 2);
}

TEST_P(Covariance, OverViewsTheErrorIsWithinTenTimesOfWhatItSays) {
  std::vector<double> squares;
  for (int i = 0; i < 12; ++i) {
    const Scene seen = scene(0.4 + 0.52 * i, 0.55 + 0.05 * (i % 7));
    RenderOptions options;
    options.seed = uint32_t(100 + i);
    const auto samples = look(renderScene(seen, testCamera(), options).grey, seen.cameraFromObject(0));
    ASSERT_LE(samples.size(), 1u);
    if (!samples.empty()) squares.push_back(normalizedSquare(samples, Vector6d::Zero()));
  }
  ASSERT_GE(squares.size(), 10u);
  std::nth_element(squares.begin(), squares.begin() + squares.size() / 2, squares.end());
  const double median = squares[squares.size() / 2];
  std::printf("%s: median normalised squared error over %zu views %.2f\n", GetParam(), squares.size(),
              median);
  EXPECT_GT(median, 0.01);
  EXPECT_LT(median, 100);
}

INSTANTIATE_TEST_SUITE_P(Parts, Covariance, testing::Values("bracket", "bridge"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace monocular_eye_hand
