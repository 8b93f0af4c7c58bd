// Share of the visible model edges with image contrast that a detector covers, under the true poses.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "features_bench_sets.h"
#include "features_detectors.h"
#include "model/build_model.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/mesh/ray_scene.h"
#include "monocular_eye_hand/model/contour.h"

namespace monocular_eye_hand {
namespace {

constexpr double kDistance = 1.5, kAngle = 10 * M_PI / 180;  // px, rad
constexpr float kContrast = 4;  // grey levels per px across the edge, after blurring by 1 px

struct Sample {
  Eigen::Vector2d uv, direction;
};
using Models = std::map<int, ObjectModel>;

Models buildModels(const BopModels& bop) {
  Models models;
  for (const auto& [id, model] : bop) models[id] = buildModel(model.name, loadMesh(model.mesh_path, "mm"));
  return models;
}

// Image gradient by central differences of the blurred image.
struct GradientImage {
  cv::Mat dx, dy;
  explicit GradientImage(const cv::Mat& grey) {
    cv::Mat smooth;
    grey.convertTo(smooth, CV_32F);
    cv::GaussianBlur(smooth, smooth, {0, 0}, 1.0);
    const cv::Mat kernel = (cv::Mat_<float>(1, 3) << -.5f, 0, .5f);
    cv::filter2D(smooth, dx, CV_32F, kernel);
    cv::filter2D(smooth, dy, CV_32F, kernel.t());
  }
  // Strongest gradient across the edge among the pixels within kDistance along the normal.
  bool contrast(const Sample& s) const {
    const Eigen::Vector2d n(-s.direction.y(), s.direction.x());
    for (double t = -kDistance; t <= kDistance; t += 0.5) {
      const int x = int(std::lround(s.uv.x() + t * n.x())), y = int(std::lround(s.uv.y() + t * n.y()));
      if (x < 0 || y < 0 || x >= dx.cols || y >= dx.rows) continue;
      if (std::fabs(dx.at<float>(y, x) * n.x() + dy.at<float>(y, x) * n.y()) >= kContrast) return true;
    }
    return false;
  }
};

// Hidden by another object of the image?
bool hidden(const BopImage& image, size_t self, const Models& models, const Eigen::Vector3d& p_in_camera) {
  for (size_t k = 0; k < image.truth.size(); ++k) {
    if (k == self) continue;
    const Rigid3 object_from_camera = image.truth[k].camera_from_object.inverse();
    if (models.at(image.truth[k].object)
            .rays->occluded(object_from_camera.translation, object_from_camera * p_in_camera))
      return true;
  }
  return false;
}

// About one sample per pixel of every visible edge that lies in the image and has contrast.
std::vector<Sample> contourSamples(const BopImage& image, const Camera& camera, const Models& models,
                                   const GradientImage& gradient) {
  std::vector<Sample> out;
  for (size_t k = 0; k < image.truth.size(); ++k) {
    const Rigid3& pose = image.truth[k].camera_from_object;
    const ObjectModel& model = models.at(image.truth[k].object);
    ContourOptions options;
    options.step = 0.5 * (pose * model.centre()).z() / camera.fx;
    Eigen::Vector2d last(-1e9, -1e9);
    int feature = -1;
    for (const ContourSample& c : visibleContour(model, pose.inverse().translation, options)) {
      const Eigen::Vector3d p = pose * c.p;
      if (p.z() <= 0) continue;
      const Eigen::Vector2d uv = camera.project(p);
      if (c.feature == feature && (uv - last).norm() < 1) continue;
      feature = c.feature;
      last = uv;
      if (uv.x() < 3 || uv.y() < 3 || uv.x() > camera.width - 4 || uv.y() > camera.height - 4) continue;
      const Eigen::Vector2d ahead = camera.project(pose * (c.p + 1e-4 * c.tangent)) - uv;
      if (!(ahead.norm() > 1e-9)) continue;
      const Sample sample{uv, ahead.normalized()};
      if (gradient.contrast(sample) && !hidden(image, k, models, p)) out.push_back(sample);
    }
  }
  return out;
}

bool parallel(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::fabs(a.x() * b.y() - a.y() * b.x()) <= std::sin(kAngle) * a.norm() * b.norm();
}
bool covers(const BenchSegment& s, const Sample& sample) {
  const Eigen::Vector2d d = s.q - s.p;
  const double t = std::min(1.0, std::max(0.0, d.dot(sample.uv - s.p) / d.squaredNorm()));
  return (s.p + t * d - sample.uv).norm() <= kDistance && parallel(d, sample.direction);
}
// To first order (Sampson): F / |grad F| of F = sqrt(x^2/a^2 + y^2/b^2) - 1.
bool covers(const Ellipse& e, const Sample& sample) {
  const double c = std::cos(e.angle), s = std::sin(e.angle);
  const Eigen::Vector2d d = sample.uv - e.centre;
  const double x = c * d.x() + s * d.y(), y = -s * d.x() + c * d.y();
  const double root = std::sqrt(x * x / (e.a * e.a) + y * y / (e.b * e.b));
  if (!(root > 0)) return false;
  const Eigen::Vector2d g(x / (e.a * e.a * root), y / (e.b * e.b * root));
  if (std::fabs(root - 1) > kDistance * g.norm()) return false;
  const Eigen::Vector2d normal(c * g.x() - s * g.y(), s * g.x() + c * g.y());
  return parallel(Eigen::Vector2d(-normal.y(), normal.x()), sample.direction);
}
bool covered(const BenchFeatures& features, const Sample& sample) {
  for (const BenchSegment& s : features.segments)
    if (covers(s, sample)) return true;
  for (const Ellipse& e : features.ellipses)
    if (covers(e, sample)) return true;
  return false;
}

// The ellipses and the longest segments, together no more than `max_count`.
BenchFeatures longest(BenchFeatures features, size_t max_count) {
  std::sort(features.segments.begin(), features.segments.end(),
            [](const BenchSegment& a, const BenchSegment& b) { return a.length() > b.length(); });
  const size_t ellipses = std::min(max_count, features.ellipses.size());
  features.ellipses.resize(ellipses);
  features.segments.resize(std::min(features.segments.size(), max_count - ellipses));
  return features;
}

// Argument: data set. Every detector on every image.
void BM_EdgeCoverage(benchmark::State& state) {
  const std::vector<BenchDataset> sets = benchDatasets();
  if (size_t(state.range(0)) >= sets.size()) {
    state.SkipWithError("MONOCULAR_EYE_HAND_DATA names no folder with the data sets");
    return;
  }

  const BenchDataset& set = sets[size_t(state.range(0))];
  const Models models = buildModels(set.models);
  long samples = 0, hits[kDetectors] = {}, as_few[kDetectors] = {};
  std::vector<double> counts[kDetectors];

  for (auto _ : state)
    for (const BopImage& image : set.images.images) {
      const cv::Mat grey = loadBopImage(image);
      const Camera camera = bopCamera(image, grey.cols, grey.rows);
      const std::vector<Sample> contour = contourSamples(image, camera, models, GradientImage(grey));
      samples += long(contour.size());
      BenchFeatures ours;
      for (int d = 0; d < kDetectors; ++d) {
        const BenchFeatures found = detectBy(Detector(d), grey, {});
        const size_t count = found.segments.size() + found.ellipses.size();
        if (d == int(Detector::kOurs)) ours = found;
        const BenchFeatures few = longest(ours, count);
        counts[d].push_back(double(count));
        for (const Sample& s : contour) {
          hits[d] += covered(found, s);
          as_few[d] += covered(few, s);
        }
      }
    }

  state.SetLabel(set.name);
  state.counters["samples"] = double(samples);
  for (int d = 0; d < kDetectors; ++d) {
    const std::string name = nameOf(Detector(d));
    state.counters[name + "_covered"] = double(hits[d]) / double(std::max(1L, samples));
    state.counters["ours_as_few_as_" + name] = double(as_few[d]) / double(std::max(1L, samples));
    state.counters[name + "_features"] = quantile(counts[d], 0.5);
  }
}
BENCHMARK(BM_EdgeCoverage)->Arg(0)->Arg(1)->Arg(2)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace monocular_eye_hand
