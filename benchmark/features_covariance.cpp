// Do the reported uncertainties of lines and ellipses tell the errors? Rendered draws of known shapes at
// random contrast, blur, noise and size.
#include <benchmark/benchmark.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "features_bench_sets.h"
#include "features_detectors.h"

namespace monocular_eye_hand {
namespace {

constexpr int kDraws = 10000;

double uniform(std::mt19937_64* random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(*random);
}

// One filled polygon on an even ground.
cv::Mat photographOf(const Corners& corners, int width, int height, std::mt19937_64* random) {
  const double ground = uniform(random, 40, 215);
  double grey = ground;
  while (std::fabs(grey - ground) < 25) grey = uniform(random, 15, 240);
  cv::Mat image(height, width, CV_32F, cv::Scalar(ground));
  fillByArea(corners, grey, &image);
  const double blur = uniform(random, 0.5, 1.2), noise = uniform(random, 1, 8);
  return photograph(image, blur, noise, random);
}

struct Coverage {
  Eigen::VectorXd limits;  // squared Mahalanobis distances of the 50, 90 and 99 % ellipsoids
  long within[3] = {}, draws = 0;
  std::vector<std::vector<double>> standardised;  // |error| / sigma of each parameter
  std::vector<double> sigma;                      // of the first parameter

  void add(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance) {
    const double distance2 = error.dot(covariance.ldlt().solve(error));
    ++draws;
    for (int k = 0; k < 3; ++k) within[k] += distance2 <= limits[k];
    standardised.resize(size_t(error.size()));
    for (int i = 0; i < error.size(); ++i)
      standardised[size_t(i)].push_back(std::fabs(error[i]) / std::sqrt(covariance(i, i)));
    sigma.push_back(std::sqrt(covariance(0, 0)));
  }
  // Reported over actual standard deviation, the parameter for which it is largest: a normal variable lies
  // within 0.6745 standard deviations half of the time.
  double sharpness() const {
    double max_ratio = 0;
    for (const std::vector<double>& z : standardised)
      max_ratio = std::max(max_ratio, 0.6745 / quantile(z, 0.5));
    return max_ratio;
  }
  double sharpest() const {
    double min_ratio = 1e9;
    for (const std::vector<double>& z : standardised)
      min_ratio = std::min(min_ratio, 0.6745 / quantile(z, 0.5));
    return min_ratio;
  }
  void report(benchmark::State* state, long missed) const {
    const char* names[] = {"within_50", "within_90", "within_99"};
    for (int k = 0; k < 3; ++k) state->counters[names[k]] = 100.0 * double(within[k]) / double(draws);
    state->counters["sharpness"] = sharpness();
    state->counters["sharpness_least"] = sharpest();
    state->counters["sigma"] = quantile(sigma, 0.5);
    state->counters["draws"] = double(draws);
    state->counters["missed"] = double(missed);
  }
};

// Offset at the segment's middle [px] and angle [rad] against the true edge; null when no segment is there.
const LineSegment* edgeSegment(const FeatureSet& features, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                               Eigen::Vector2d* error) {
  const Eigen::Vector2d u = (b - a).normalized(), n(-u.y(), u.x());
  const LineSegment* best = nullptr;
  for (const LineSegment& s : features.segments) {
    const Eigen::Vector2d middle = 0.5 * (s.p + s.q), d = s.direction();
    const double along = u.dot(middle - a) / (b - a).norm();
    const double sine = u.x() * d.y() - u.y() * d.x();
    if (std::fabs(n.dot(middle - a)) > 2 || along < 0 || along > 1 || std::fabs(sine) > 0.1) continue;
    if (best && best->length() >= s.length()) continue;
    best = &s;
    *error = {n.dot(middle - a), std::asin(u.dot(d) > 0 ? sine : -sine)};
  }
  return best;
}

void BM_LineCovariance(benchmark::State& state) {
  std::mt19937_64 random(31);
  Coverage coverage;
  coverage.limits = Eigen::Vector3d(1.38629, 4.60517, 9.21034);  // chi-square of two degrees of freedom
  long missed = 0;

  for (auto _ : state)
    while (coverage.draws < kDraws) {
      const int n = 3 + int(uniform(&random, 0, 3));
      const double turn = uniform(&random, 0, 2 * M_PI), r = uniform(&random, 20, 70);
      Corners corners;
      const Eigen::Vector2d centre(80 + uniform(&random, -1, 1), 80 + uniform(&random, -1, 1));
      for (int i = 0; i < n; ++i) {
        const double angle = turn + 2 * M_PI * (i + uniform(&random, -.2, .2)) / n;
        corners.push_back(centre + r * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      }

      const cv::Mat grey = photographOf(corners, 160, 160, &random);
      const FeatureSet features = detectFeatures(grey, benchCamera(grey));
      for (int i = 0; i < n; ++i) {
        const Eigen::Vector2d &a = corners[size_t(i)], &b = corners[size_t((i + 1) % n)];
        if ((b - a).norm() < 15) continue;
        Eigen::Vector2d error;
        const LineSegment* s = edgeSegment(features, a, b, &error);
        if (!s) {
          ++missed;
          continue;
        }
        const Eigen::Vector2d sigma(s->sigma_offset, s->sigma_angle);
        coverage.add(error, sigma.cwiseAbs2().asDiagonal().toDenseMatrix());
      }
    }
  coverage.report(&state, missed);
}
BENCHMARK(BM_LineCovariance)->Iterations(1)->Unit(benchmark::kMillisecond);

// The angle turns by half turns; of a circle it is free, so the axes stay apart here.
void BM_EllipseCovariance(benchmark::State& state) {
  std::mt19937_64 random(32);
  Coverage coverage;
  coverage.limits = Eigen::Vector3d(4.35146, 9.23636, 15.08627);  // chi-square of five degrees of freedom
  long missed = 0;

  for (auto _ : state)
    while (coverage.draws < kDraws) {
      Ellipse e;
      e.a = uniform(&random, 10, 60);
      e.b = e.a * uniform(&random, .3, .9);
      if (e.b < 5) continue;
      e.angle = uniform(&random, 0, M_PI);
      e.centre = {70 + uniform(&random, -1, 1), 70 + uniform(&random, -1, 1)};

      Corners corners;
      for (int i = 0; i < 360; ++i) corners.push_back(e.at(i * M_PI / 180));
      const cv::Mat grey = photographOf(corners, 140, 140, &random);
      const FeatureSet features = detectFeatures(grey, benchCamera(grey));
      const DetectedEllipse* best = nullptr;
      for (const DetectedEllipse& d : features.ellipses)
        if ((d.ellipse.centre - e.centre).norm() < 3 && std::fabs(d.ellipse.a - e.a) < 0.1 * e.a + 1 &&
            std::fabs(d.ellipse.b - e.b) < 0.1 * e.b + 1 && (!best || d.coverage > best->coverage))
          best = &d;
      if (!best) {
        ++missed;
        continue;
      }

      Eigen::VectorXd error(5);
      const double turn = best->ellipse.angle - e.angle;
      error << best->ellipse.centre - e.centre, best->ellipse.a - e.a, best->ellipse.b - e.b,
          turn - M_PI * std::round(turn / M_PI);
      coverage.add(error, best->covariance);
    }
  coverage.report(&state, missed);
}
BENCHMARK(BM_EllipseCovariance)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace monocular_eye_hand
