#include "recognition/alignment.h"

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/model/contour.h"
#include "monocular_eye_hand/pose/bent_edges.h"
#include "monocular_eye_hand/pose/feature_refinement.h"
#include "monocular_eye_hand/pose/refine.h"
#include "recognition/focal_length.h"
#include "recognition/resolved_contour.h"

namespace monocular_eye_hand {
namespace {

constexpr int kCoarseSamples = 48;
constexpr size_t kMinMatches = 8;
// Model tolerances and lens residuals: no edge is trusted better than this [px].
constexpr double kMinSigma = 0.3;
constexpr int kFeatureRounds = 2;  // features weighed against each other, then their samples sought again

FreeAxis freeAxis(const ObjectModel& model) {
  FreeAxis axis;
  if (model.symmetries.axis) {
    axis.present = true;
    axis.point = model.symmetries.axis->point;
    axis.direction = model.symmetries.axis->direction;
  }
  return axis;
}

// An image shows the edge somewhere on the round, depending on the light: as likely anywhere on its chord
// [m].
double roundingSigma(double rounding, double dihedral) {
  return rounding * std::sin(0.5 * dihedral) / std::sqrt(3.0);
}
double roundingSigma(const ObjectModel& model, int feature) {
  const size_t edge = size_t(feature), circle = edge - model.edges.size();
  if (edge < model.edges.size()) return roundingSigma(model.edges[edge].rounding, model.edges[edge].dihedral);
  if (circle >= model.circles.size()) return 0;
  return roundingSigma(model.circles[circle].rounding, model.circles[circle].dihedral);
}

bool plausibleStep(const RefinedPose& refined) {
  return refined.well_posed && refined.camera_from_object.isFinite() &&
         refined.camera_from_object.translation.z() > 0;
}

// A contour sample under a pose and the edge point that answers it.
struct ContourMatch {
  FeatureSample sample;
  int edge_point;
  double depth;  // in the camera frame [m]
};
std::vector<ContourMatch> matchContour(const SearchModel& model, const SearchImage& image, const Rigid3& pose,
                                       double range, double step) {
  std::vector<ContourMatch> matches;
  const std::vector<SeenSample> contour =
      resolvedContour(model.model(), projectContour(model.model(), pose, image.camera, image.domain, step));

  for (const SeenSample& s : contour) {
    if (!s.inside) continue;
    const Eigen::Vector2d normal = s.normal();
    const int found = image.raster.find(s.uv, normal, range);
    if (found < 0) continue;
    const EdgePoint& point = image.raster.point(found);

    FeatureSample sample;
    sample.line = {s.p_in_object, point.uv.cast<double>(), normal,
                   std::hypot(s.rounding, std::max({kMinSigma, double(point.sigma), range / 3}))};
    sample.displacement = s.rounding;
    sample.feature = s.feature;
    const double across = s.direction.dot(point.normal.cast<double>());
    sample.appearance = {point.blur, std::asin(std::clamp(across, -1.0, 1.0))};
    matches.push_back({sample, found, (pose * s.p_in_object).z()});
  }
  return matches;
}

// Where two features answer to one image edge, as the front and the back rim of a face seen straight on do,
// the nearer one is what the image shows; counted twice the edge would seem to fix the tilt.
std::vector<FeatureSample> uniqueEdgeMatches(std::vector<ContourMatch> matches) {
  constexpr int kNear = 2;  // edge points apart along their trace
  std::stable_sort(matches.begin(), matches.end(),
                   [](const ContourMatch& a, const ContourMatch& b) { return a.edge_point < b.edge_point; });
  std::vector<char> behind(matches.size(), 0);
  for (size_t i = 0; i < matches.size(); ++i)
    for (size_t j = i + 1; j < matches.size(); ++j) {
      if (matches[j].edge_point - matches[i].edge_point > kNear) break;
      if (matches[i].sample.feature != matches[j].sample.feature)
        behind[matches[i].depth > matches[j].depth ? i : j] = 1;
    }
  std::vector<FeatureSample> single;
  for (size_t i = 0; i < matches.size(); ++i)
    if (!behind[i]) single.push_back(matches[i].sample);
  return single;
}

}  // namespace

std::vector<SeenSample> projectContour(const ObjectModel& model, const Rigid3& pose, const Camera& camera,
                                       const RectDomain& domain, double step) {
  const Rigid3 object_from_camera = pose.inverse();
  const double distance = (pose * model.centre()).norm();
  ContourOptions options;
  options.step = step * distance / focalLength(camera);
  const std::vector<ContourSample> contour = visibleContour(model, object_from_camera.translation, options);

  std::vector<SeenSample> seen;
  seen.reserve(contour.size());
  for (const ContourSample& s : contour) {
    const Eigen::Vector3d p = pose * s.p, d = pose.rotation * s.tangent;
    if (p.z() <= 1e-3) continue;
    SeenSample out;
    out.p_in_object = s.p;
    out.uv = camera.project(p);
    const Eigen::Vector2d direction(camera.fx * (d.x() - p.x() / p.z() * d.z()),
                                    camera.fy * (d.y() - p.y() / p.z() * d.z()));
    const double length = direction.norm();
    if (!(length > 1e-9)) continue;  // seen end-on
    out.direction = direction / length;
    out.feature = s.feature;
    out.rounding = roundingSigma(model, s.feature) * focalLength(camera) / p.z();
    out.silhouette = s.silhouette;

    if (s.inner_side != 0) {
      const Eigen::Vector3d across = s.tangent.cross(s.p - object_from_camera.translation);
      const Eigen::Vector3d m = pose.rotation * (double(s.inner_side) * across);
      const Eigen::Vector2d towards(camera.fx * (m.x() - p.x() / p.z() * m.z()),
                                    camera.fy * (m.y() - p.y() / p.z() * m.z()));
      out.inward = towards.dot(out.normal()) > 0 ? 1 : -1;
    }
    out.inside = domain.contains(out.uv.x(), out.uv.y());
    seen.push_back(out);
  }
  return seen;
}

std::optional<ViewedPose> alignCoarsely(const SearchModel& model, const SearchImage& image, ViewedPose start,
                                        const std::vector<double>& ranges) {
  auto& [pose, view] = start;
  const Camera& camera = image.camera;
  const FreeAxis axis = freeAxis(model.model());
  std::vector<LineMatch> matches;

  for (double range : ranges) {
    const std::vector<ViewSample>& samples = model.samples(view);
    const size_t count = std::min<size_t>(samples.size(), kCoarseSamples);
    matches.clear();
    for (size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d p_in_object = samples[i].p.cast<double>();
      const Eigen::Vector3d p = pose * p_in_object;
      if (p.z() <= 1e-3) return std::nullopt;
      const Eigen::Vector3d d = pose.rotation * samples[i].tangent.cast<double>();
      Eigen::Vector2d normal(-camera.fy * (d.y() - p.y() / p.z() * d.z()),
                             camera.fx * (d.x() - p.x() / p.z() * d.z()));
      const double length = normal.norm();
      if (!(length > 1e-9)) continue;
      normal /= length;
      const int found = image.raster.find(camera.project(p), normal, range);
      if (found < 0) continue;
      matches.push_back({p_in_object, image.raster.point(found).uv.cast<double>(), normal, range / 3});
    }

    if (matches.size() < kMinMatches) return std::nullopt;
    RefineOptions options;
    options.max_iterations = 2;
    const RefinedPose refined = refinePose(pose, camera, matches, {}, options, axis);
    if (!plausibleStep(refined)) return std::nullopt;
    pose = model.canonical(refined.camera_from_object, &view);
  }
  return start;
}

RefinedPose alignFinely(const SearchModel& model, const SearchImage& image, const Rigid3& start,
                        const std::vector<double>& ranges, double step) {
  const FreeAxis axis = freeAxis(model.model());
  RefinedPose best;
  best.camera_from_object = start;
  for (size_t round = 0; round < ranges.size(); ++round) {
    std::vector<LineMatch> lines;
    for (const ContourMatch& m : matchContour(model, image, best.camera_from_object, ranges[round], step))
      lines.push_back(m.sample.line);
    if (lines.size() < kMinMatches) return best;
    RefineOptions options;
    options.max_iterations = round + 1 == ranges.size() ? 6 : 3;
    const RefinedPose refined = refinePose(best.camera_from_object, image.camera, lines, {}, options, axis);
    if (!plausibleStep(refined)) return best;
    best = refined;
  }
  return best;
}

RefinedPose alignByFeatures(const SearchModel& model, const SearchImage& image, const Rigid3& start,
                            double range, double step) {
  const FreeAxis axis = freeAxis(model.model());
  RefinedPose best;
  best.camera_from_object = start;
  for (int round = 0; round < kFeatureRounds; ++round) {
    const Rigid3& pose = best.camera_from_object;
    std::vector<FeatureSample> samples = uniqueEdgeMatches(matchContour(model, image, pose, range, step));
    if (samples.size() < kMinMatches) break;
    correctBlurBias(pose, image.camera, &samples);
    const RefinedPose refined = refineByFeatures(pose, image.camera, samples, axis);
    if (!plausibleStep(refined)) break;
    best = refined;
  }
  return best;
}

}  // namespace monocular_eye_hand
