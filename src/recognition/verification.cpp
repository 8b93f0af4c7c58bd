#include "recognition/verification.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/geometry/median.h"
#include "recognition/alignment.h"
#include "recognition/drawing_terms.h"
#include "recognition/face_evidence.h"
#include "recognition/resolved_contour.h"

namespace monocular_eye_hand {
namespace {

constexpr double kIndependent = 5.0;       // contour length that counts as one independent sample [px]
constexpr double kUnsupportedHits = 0.35;  // a feature with a smaller share of hits is unsupported
constexpr double kMinFeature = 8.0;        // shorter visible features are not counted [px]

bool hidden(const Candidate& candidate, const Camera& camera, const Eigen::Vector2d& uv, double distance) {
  return std::any_of(candidate.occluders.begin(), candidate.occluders.end(),
                     [&](const Occluder& occluder) { return occluder.hides(camera, uv, distance); });
}

void findEdges(const SearchImage& image, std::vector<SeenSample>* contour) {
  for (SeenSample& s : *contour)
    if (s.inside) s.edge_point = image.raster.find(s.uv, s.normal(), kHitRange);
}

// Of the rings of a thread count those that the image shows: that it does not show the others says nothing.
std::vector<SeenSample> withoutUnseenRings(const ObjectModel& model, const std::vector<SeenSample>& contour) {
  const std::vector<char> crowded = crowdedRings(model, contour);
  std::vector<SeenSample> counted;
  for (size_t i = 0; i < contour.size(); ++i)
    if (!crowded[i] || !contour[i].inside || contour[i].edge_point >= 0) counted.push_back(contour[i]);
  return counted;
}

void hideBehindOccluders(const Camera& camera, Candidate* candidate) {
  for (SeenSample& s : candidate->contour) {
    if (!s.inside || s.edge_point >= 0) continue;
    const double distance = (candidate->pose.camera_from_object * s.p_in_object).norm();
    s.hidden = hidden(*candidate, camera, s.uv, distance);
    s.inside = !s.hidden;
  }
}

// Edge points that answer the contour.
std::vector<int> claimedBy(const std::vector<SeenSample>& contour) {
  std::vector<int> claimed;
  for (const SeenSample& s : contour)
    if (s.edge_point >= 0) claimed.push_back(s.edge_point);
  std::sort(claimed.begin(), claimed.end());
  claimed.erase(std::unique(claimed.begin(), claimed.end()), claimed.end());
  return claimed;
}

// What of one feature was looked at.
struct FeatureTally {
  int samples = 0, hits = 0;
  bool supported() const { return hits >= kUnsupportedHits * samples; }
};

// How the samples fared, all together.
struct ContourTally {
  int all = 0, inside = 0, hits = 0, hidden = 0;
  int outline = 0, outline_hits = 0;
  double evidence = 0;        // of the map, in its units
  double squared_offset = 0;  // summed over the hits [px^2]
  std::vector<float> gradients;
  std::map<int, FeatureTally> features;
};

ContourTally tally(const SearchImage& image, const std::vector<SeenSample>& contour) {
  ContourTally t;
  for (const SeenSample& s : contour) {
    ++t.all;
    t.hidden += s.hidden;
    if (!s.inside) continue;
    const bool hit = s.edge_point >= 0;
    ++t.inside;
    t.outline += s.silhouette;
    t.outline_hits += s.silhouette && hit;
    FeatureTally& feature = t.features[s.feature];
    ++feature.samples;
    feature.hits += hit;

    const int8_t value = image.map.at(s.uv, s.direction);
    if (value != kOutside) t.evidence += value;
    if (!hit) continue;

    const EdgePoint& p = image.raster.point(s.edge_point);
    const Eigen::Vector2d normal = s.normal();
    const double offset = (p.uv.cast<double>() - s.uv).dot(normal);
    ++t.hits;
    t.squared_offset += offset * offset;
    t.gradients.push_back(p.gradient);
  }
  return t;
}

// Features with hardly any edge under them.
void supportTerms(const ContourTally& t, Candidate* candidate) {
  int total = 0, missing = 0, length = 0, missing_length = 0;
  for (const auto& [index, feature] : t.features) {
    if (feature.samples * kStep < kMinFeature) continue;
    ++total;
    length += feature.samples;
    if (feature.supported()) continue;
    ++missing;
    missing_length += feature.samples;
  }
  candidate->matched_features = total - missing;
  EvidenceTerms& terms = candidate->terms;
  terms.groups = total;
  terms.unsupported = total ? double(missing) / total : 1;
  terms.unsupported_length = length > 0 ? double(missing_length) / length : 1;
}

void contourTerms(const SearchImage& image, Candidate* candidate) {
  ContourTally t = tally(image, candidate->contour);
  EvidenceTerms& terms = candidate->terms;
  const double nats = t.evidence / kEvidenceUnit;
  terms.sum = nats * kStep / kIndependent;
  terms.mean = t.inside ? nats / t.inside : 0;
  terms.hit_ratio = t.inside ? double(t.hits) / t.inside : 0;
  terms.silhouette_hits = t.outline ? double(t.outline_hits) / t.outline : terms.hit_ratio;
  const int creases = t.inside - t.outline;
  terms.crease_hits = creases > 0 ? double(t.hits - t.outline_hits) / creases : terms.silhouette_hits;
  terms.in_frame = t.all > t.hidden ? double(t.inside) / (t.all - t.hidden) : 0;
  terms.hidden = t.all ? double(t.hidden) / t.all : 0;
  terms.contour_length = t.inside * kStep;
  terms.rms = t.hits ? std::sqrt(t.squared_offset / t.hits) : kHitRange;
  terms.contrast = median(&t.gradients) / std::max(image.noise, 1e-3);
  supportTerms(t, candidate);
}

void boundingBox(const SearchImage& context, Candidate* candidate) {
  Eigen::AlignedBox2d box;
  for (const SeenSample& s : candidate->contour) box.extend(s.uv);
  if (box.isEmpty()) return;
  const int u = int(std::floor(box.min().x())), v = int(std::floor(box.min().y()));
  candidate->bounding_box =
      cv::Rect(u, v, int(std::ceil(box.max().x())) - u, int(std::ceil(box.max().y())) - v) &
      cv::Rect(context.domain.u0, context.domain.v0, context.domain.width, context.domain.height);
}

}  // namespace

void drawContour(const SearchModel& model, const SearchImage& image, Candidate* candidate) {
  candidate->covered.clear();
  candidate->terms = EvidenceTerms();
  std::vector<SeenSample> drawn = resolvedContour(
      model.model(),
      projectContour(model.model(), candidate->pose.camera_from_object, image.camera, image.domain, kStep));
  findEdges(image, &drawn);
  candidate->contour = withoutUnseenRings(model.model(), drawn);
  candidate->claimed = claimedBy(candidate->contour);
  hideBehindOccluders(image.camera, candidate);
  contourTerms(image, candidate);
  boundingBox(image, candidate);
}

void weighDrawing(const SearchModel& model, const SearchImage& image, Candidate* candidate) {
  runOnTerms(model.model(), image, candidate);
  faceTerms(model.model(), image, candidate);
  coherenceTerms(image, candidate);
  precisionTerms(image, candidate);
  absenceTerms(model.model(), image, candidate);
  crossingTerms(image, candidate);
  chanceTerms(image, candidate);
  viewTerms(model, image, candidate);
}

void verify(const SearchModel& model, const SearchImage& image, Candidate* candidate) {
  drawContour(model, image, candidate);
  weighDrawing(model, image, candidate);
}

}  // namespace monocular_eye_hand
