#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>

#include "monocular_eye_hand/mesh/ray_scene.h"
#include "recognition/drawing_terms.h"
#include "recognition/resolved_contour.h"

namespace monocular_eye_hand {
namespace {

constexpr double kMinTraced = 12.0;  // a shorter feature cannot be traced [px]
constexpr double kFoundShare = 0.5;  // of its samples answered: the feature is there
constexpr double kBareShare = 0.5;   // of its samples on flat ground: the feature is not there
constexpr double kFlatNoise = 3.0;   // a step below so many standard deviations is none
constexpr double kFlatGrey = 2.5;    // ... and below this [grey levels]
constexpr double kOtherSide = 2.5;   // where the outline's other side is looked at [px]
constexpr double kSharp = 1.0;       // dihedral of a crease that shading shows [rad]

struct AbsenceTally {
  int samples = 0, hits = 0, bare = 0;
  void add(bool hit, bool flat) {
    ++samples;
    hits += hit;
    bare += !hit && flat;
  }
  double hitShare() const { return samples ? double(hits) / samples : 0; }
  double bareShare() const { return samples ? double(bare) / samples : 0; }
};

// Mean grey 1.5 to 4.5 px to either side of the drawn line; whether the two differ by more than noise.
bool flat(const SearchImage& image, const SeenSample& s) {
  const Eigen::Vector2d normal = s.normal();
  double sum[2] = {0, 0};
  int count[2] = {0, 0};
  for (int side = 0; side < 2; ++side)
    for (double d = 1.5; d < 5; d += 1) {
      const Eigen::Vector2d uv = s.uv + (side ? d : -d) * normal;
      if (!image.domain.contains(uv.x(), uv.y())) continue;
      const int x = int(std::lround(uv.x())) - image.domain.u0,
                y = int(std::lround(uv.y())) - image.domain.v0;
      sum[side] += image.rect_grey.at<uint8_t>(y, x);
      ++count[side];
    }
  if (!count[0] || !count[1]) return false;
  const double step = std::abs(sum[0] / count[0] - sum[1] / count[1]);
  const double sigma = image.grey_noise * std::sqrt(1.0 / count[0] + 1.0 / count[1]);
  return step < kFlatGrey + kFlatNoise * sigma;
}

// Whether the drawn silhouette is the part's outline: beyond it the part is not hit any more.
bool isOutline(const ObjectModel& model, const SearchImage& image, const Rigid3& object_from_camera,
               const SeenSample& s) {
  if (!s.silhouette) return false;
  if (s.inward == 0) return true;
  const Eigen::Vector2d normal = s.normal();
  const Eigen::Vector2d beyond = s.uv - s.inward * kOtherSide * normal;
  const Eigen::Vector3d ray = (object_from_camera.rotation * image.camera.ray(beyond)).normalized();
  return !model.rays->cast(object_from_camera.translation, ray).hit;
}

}  // namespace

void absenceTerms(const ObjectModel& model, const SearchImage& image, Candidate* candidate) {
  const Rigid3 object_from_camera = candidate->pose.camera_from_object.inverse();
  AbsenceTally outline, inner, sharp;
  std::map<int, AbsenceTally> features;
  for (SeenSample& s : candidate->contour) {
    if (!s.inside) continue;
    const bool hit = s.edge_point >= 0, bare = !hit && flat(image, s);
    s.outline = isOutline(model, image, object_from_camera, s);
    if (s.outline) {
      outline.add(hit, bare);
      continue;
    }
    inner.add(hit, bare);
    features[s.feature].add(hit, bare);
    if (!s.silhouette && dihedralOf(model, s.feature) > kSharp) sharp.add(hit, bare);
  }

  EvidenceTerms& terms = candidate->terms;
  terms.outline_hits = outline.hitShare();
  terms.outline_bare = outline.bareShare();
  terms.inner_share =
      outline.samples + inner.samples ? double(inner.samples) / (outline.samples + inner.samples) : 0;
  terms.inner_hits = inner.samples ? inner.hitShare() : terms.outline_hits;
  terms.inner_bare = inner.bareShare();
  terms.sharp_bare = sharp.bareShare();
  int found = 0, bare = 0, counted = 0;
  for (const auto& [index, tally] : features) {
    if (tally.samples * kStep < kMinTraced) continue;
    ++counted;
    found += tally.hits >= kFoundShare * tally.samples;
    bare += tally.bare >= kBareShare * tally.samples;
  }
  terms.inner_features = counted;
  terms.inner_found = found;
  terms.features_bare = counted ? double(bare) / counted : 0;
  terms.features_found = counted ? double(found) / counted : terms.outline_hits;
}

}  // namespace monocular_eye_hand
