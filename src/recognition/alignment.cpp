#include "monocular_eye_hand/recognition/alignment.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "monocular_eye_hand/model/contour.h"
#include "monocular_eye_hand/recognition/feature_refinement.h"

namespace monocular_eye_hand {
namespace {

constexpr double kCoarseRanges[] = {10, 8, 6, 4, 3};  // association range per round [px]
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

bool plausibleStep(const RefinedPose& refined) {
  return refined.well_posed && refined.camera_from_object.isFinite() &&
         refined.camera_from_object.translation.z() > 0;
}

// Contour samples under a pose with the edge points that answer them, and the samples' features.
struct ContourMatches {
  std::vector<LineMatch> lines;
  std::vector<int> groups, edge_points;
};
ContourMatches matchContour(const SearchModel& model, const Camera& camera, const RectDomain& domain,
                            const EdgeRaster& raster, const Rigid3& pose, double range, double step) {
  ContourMatches matches;
  for (const SeenSample& s : projectContour(model.model(), pose, camera, domain, step)) {
    if (!s.inside) continue;
    const Eigen::Vector2d normal(-s.direction.y(), s.direction.x());
    const int found = raster.find(s.uv, normal, range);
    if (found < 0) continue;
    const EdgePoint& point = raster.point(found);
    matches.lines.push_back({s.p_in_object, point.uv.cast<double>(), normal,
                             std::max({kMinSigma, double(point.sigma), range / 3})});
    matches.groups.push_back(s.group);
    matches.edge_points.push_back(found);
  }
  return matches;
}

// Where two features answer to one image edge, as the front and the back rim of a face seen straight on do,
// the nearer one is what the image shows; counted twice the edge would seem to fix the tilt.
ContourMatches withoutDoubles(const ContourMatches& all, const Rigid3& pose) {
  constexpr int kNear = 2;  // edge points apart along their trace
  std::vector<size_t> order(all.lines.size());
  std::iota(order.begin(), order.end(), size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t i, size_t j) { return all.edge_points[i] < all.edge_points[j]; });
  const auto depth = [&](size_t i) { return (pose * all.lines[i].p_in_object).z(); };
  std::vector<char> behind(all.lines.size(), 0);
  for (size_t a = 0; a < order.size(); ++a)
    for (size_t b = a + 1; b < order.size(); ++b) {
      const size_t i = order[a], j = order[b];
      if (all.edge_points[j] - all.edge_points[i] > kNear) break;
      if (all.groups[i] != all.groups[j]) behind[depth(i) > depth(j) ? i : j] = 1;
    }
  ContourMatches single;
  for (size_t i = 0; i < all.lines.size(); ++i) {
    if (behind[i]) continue;
    single.lines.push_back(all.lines[i]);
    single.groups.push_back(all.groups[i]);
    single.edge_points.push_back(all.edge_points[i]);
  }
  return single;
}

}  // namespace

std::vector<SeenSample> projectContour(const ObjectModel& model, const Rigid3& pose, const Camera& camera,
                                       const RectDomain& domain, double step) {
  const Rigid3 object_from_camera = pose.inverse();
  const double distance = (pose * model.centre()).norm();
  ContourOptions options;
  options.step = step * distance / std::sqrt(camera.fx * camera.fy);
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
    out.group = s.group;
    out.silhouette = s.silhouette;
    out.inside = domain.contains(out.uv.x(), out.uv.y());
    seen.push_back(out);
  }
  return seen;
}

bool alignCoarsely(const SearchModel& model, const Camera& camera, const EdgeRaster& raster, Rigid3* pose,
                   int* view) {
  const FreeAxis axis = freeAxis(model.model());
  std::vector<LineMatch> matches;
  for (double range : kCoarseRanges) {
    const std::vector<ViewSample>& samples = model.samples(*view);
    const size_t count = std::min<size_t>(samples.size(), kCoarseSamples);
    matches.clear();
    for (size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d p_in_object = samples[i].p.cast<double>();
      const Eigen::Vector3d p = *pose * p_in_object;
      if (p.z() <= 1e-3) return false;
      const Eigen::Vector3d d = pose->rotation * samples[i].tangent.cast<double>();
      Eigen::Vector2d normal(-camera.fy * (d.y() - p.y() / p.z() * d.z()),
                             camera.fx * (d.x() - p.x() / p.z() * d.z()));
      const double length = normal.norm();
      if (!(length > 1e-9)) continue;
      normal /= length;
      const int found = raster.find(camera.project(p), normal, range);
      if (found < 0) continue;
      matches.push_back({p_in_object, raster.point(found).uv.cast<double>(), normal, range / 3});
    }
    if (matches.size() < kMinMatches) return false;
    RefineOptions options;
    options.max_iterations = 2;
    const RefinedPose refined = refinePose(*pose, camera, matches, {}, options, axis);
    if (!plausibleStep(refined)) return false;
    *pose = model.canonical(refined.camera_from_object, view);
  }
  return true;
}

RefinedPose alignFinely(const SearchModel& model, const Camera& camera, const RectDomain& domain,
                        const EdgeRaster& raster, const Rigid3& start, const std::vector<double>& ranges,
                        double step) {
  const FreeAxis axis = freeAxis(model.model());
  RefinedPose best;
  best.camera_from_object = start;
  for (size_t round = 0; round < ranges.size(); ++round) {
    const ContourMatches found =
        matchContour(model, camera, domain, raster, best.camera_from_object, ranges[round], step);
    if (found.lines.size() < kMinMatches) return best;
    RefineOptions options;
    options.max_iterations = round + 1 == ranges.size() ? 6 : 3;
    const RefinedPose refined = refinePose(best.camera_from_object, camera, found.lines, {}, options, axis);
    if (!plausibleStep(refined)) return best;
    best = refined;
  }
  return best;
}

RefinedPose alignByFeatures(const SearchModel& model, const Camera& camera, const RectDomain& domain,
                            const EdgeRaster& raster, const Rigid3& start, double range, double step) {
  const FreeAxis axis = freeAxis(model.model());
  RefinedPose best;
  best.camera_from_object = start;
  for (int round = 0; round < kFeatureRounds; ++round) {
    const Rigid3& pose = best.camera_from_object;
    const ContourMatches found =
        withoutDoubles(matchContour(model, camera, domain, raster, pose, range, step), pose);
    if (found.lines.size() < kMinMatches) break;
    const RefinedPose refined = refineByFeatures(pose, camera, found.lines, found.groups, axis);
    if (!plausibleStep(refined)) break;
    best = refined;
  }
  return best;
}

}  // namespace monocular_eye_hand
