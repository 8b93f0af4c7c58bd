#include "recognition/verification.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "recognition/alignment.h"
#include "recognition/drawing_terms.h"
#include "recognition/face_evidence.h"
#include "recognition/median.h"
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

void matchSamples(const SearchImage& context, Candidate* candidate) {
  for (SeenSample& s : candidate->contour) {
    if (!s.inside) continue;
    s.edge_point = context.raster.find(s.uv, {-s.direction.y(), s.direction.x()}, kHitRange);
    if (s.edge_point >= 0) {
      candidate->claimed.push_back(s.edge_point);
      continue;
    }
    const double distance = (candidate->pose.camera_from_object * s.p_in_object).norm();
    s.hidden = hidden(*candidate, context.camera, s.uv, distance);
    s.inside = !s.hidden;
  }
  std::sort(candidate->claimed.begin(), candidate->claimed.end());
  candidate->claimed.erase(std::unique(candidate->claimed.begin(), candidate->claimed.end()),
                           candidate->claimed.end());
}

void contourTerms(const SearchImage& context, Candidate* candidate) {
  EvidenceTerms& terms = candidate->terms;
  double sum = 0, squares = 0;
  int inside = 0, hits = 0, outline = 0, outline_hits = 0, hidden = 0;
  std::map<int, std::pair<int, int>> groups;  // group -> samples, hits
  std::vector<float> gradients;
  for (const SeenSample& s : candidate->contour) {
    hidden += s.hidden;
    if (!s.inside) continue;
    ++inside;
    auto& group = groups[s.group];
    ++group.first;
    outline += s.silhouette;
    outline_hits += s.silhouette && s.edge_point >= 0;
    const int bin = orientationBin(float(s.direction.x()), float(s.direction.y()));
    const int8_t value = context.map.at(bin, int(std::lround(s.uv.x())) - context.map.u0(),
                                        int(std::lround(s.uv.y())) - context.map.v0());
    if (value != kOutside) sum += value;
    if (s.edge_point < 0) continue;
    ++hits;
    ++group.second;
    const EdgePoint& p = context.raster.point(s.edge_point);
    gradients.push_back(p.gradient);
    const double d = (p.uv.cast<double>() - s.uv).dot(Eigen::Vector2d(-s.direction.y(), s.direction.x()));
    squares += d * d;
  }
  const double nats = sum / kEvidenceUnit;
  terms.sum = nats * kStep / kIndependent;
  terms.mean = inside ? nats / inside : 0;
  terms.hit_ratio = inside ? double(hits) / inside : 0;
  terms.silhouette_hits = outline ? double(outline_hits) / outline : terms.hit_ratio;
  terms.crease_hits =
      inside > outline ? double(hits - outline_hits) / (inside - outline) : terms.silhouette_hits;
  const int all = int(candidate->contour.size());
  terms.in_frame = all > hidden ? double(inside) / (all - hidden) : 0;
  terms.hidden = all ? double(hidden) / all : 0;
  terms.contour_length = inside * kStep;
  terms.rms = hits ? std::sqrt(squares / hits) : kHitRange;
  int total = 0, missing = 0;
  double length = 0, missing_length = 0;
  for (const auto& [group, count] : groups) {
    if (count.first * kStep < kMinFeature) continue;
    const bool unsupported = count.second < kUnsupportedHits * count.first;
    ++total;
    length += count.first;
    if (unsupported) ++missing, missing_length += count.first;
  }
  candidate->matched_groups = total - missing;
  terms.groups = total;
  terms.unsupported = total ? double(missing) / total : 1;
  terms.unsupported_length = length > 0 ? missing_length / length : 1;
  terms.contrast = median(&gradients) / std::max(context.noise, 1e-3);
}

// Whether the drawing itself has a line here with this direction.
class DrawnLines {
 public:
  DrawnLines(const std::vector<SeenSample>& contour) : contour_(contour) {}
  bool explains(const Eigen::Vector2d& uv, const Eigen::Vector2d& direction, int except_group) const {
    for (const SeenSample& s : contour_)
      if (s.group != except_group && std::abs(s.direction.dot(direction)) > 0.94 &&
          (s.uv - uv).squaredNorm() < 25.0)
        return true;
    return false;
  }

 private:
  const std::vector<SeenSample>& contour_;
};

// An image edge that runs straight on past a model edge's end contradicts the end: the part of a larger box,
// a tile.
void continuationTerm(const SearchImage& context, const ObjectModel& model, Candidate* candidate) {
  const DrawnLines drawn(candidate->contour);
  double running = 0, tested = 0;
  const Rigid3& pose = candidate->pose.camera_from_object;
  std::map<int, std::vector<const SeenSample*>> by_edge;
  for (const SeenSample& s : candidate->contour)
    if (s.group < int(model.edges.size())) by_edge[s.group].push_back(&s);
  for (const auto& [e, samples] : by_edge) {
    const ModelEdge& edge = model.edges[e];
    const Eigen::Vector3d pc = pose * edge.p, qc = pose * edge.q;
    if (pc.z() <= 1e-3 || qc.z() <= 1e-3) continue;
    const Eigen::Vector2d ends[2] = {context.camera.project(pc), context.camera.project(qc)};
    const double length = (ends[1] - ends[0]).norm();
    if (length < 12) continue;
    const double reach = std::clamp(0.35 * length, 8.0, 24.0);
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d outward = (ends[k] - ends[1 - k]) / length;
      // The edge must be there right up to this end, else nothing can run on from it.
      int near = 0, near_hits = 0;
      for (const SeenSample* s : samples) {
        if (!s->inside || (s->uv - ends[k]).norm() > 18) continue;
        ++near;
        near_hits += s->edge_point >= 0;
      }
      if (near < 2 || near_hits * 2 < near) continue;
      int looked = 0, on = 0;
      const Eigen::Vector2d normal(-outward.y(), outward.x());
      for (double d = 4; d <= reach; d += 2) {
        const Eigen::Vector2d uv = ends[k] + d * outward;
        if (!context.domain.contains(uv.x(), uv.y()) || drawn.explains(uv, outward, e)) break;
        ++looked;
        const int found = context.raster.find(uv, normal, 1.5 + 0.03 * d);
        if (found < 0) continue;
        const EdgePoint& p = context.raster.point(found);
        on += std::abs(p.normal.cast<double>().dot(normal)) > 0.95;
      }
      if (looked < 2) continue;
      tested += 1;
      running += std::max(0.0, (double(on) / looked - 0.25) / 0.75);
    }
  }
  candidate->terms.ends = tested;
  candidate->terms.continuation = tested > 0 ? running / tested : 0;
}

// Image segments that the drawing uses only in part: what is left over belongs to something else.
void overhangTerm(const SearchImage& context, Candidate* candidate) {
  double used_length = 0, left_over = 0;
  for (const LineSegment& segment : context.features.segments) {
    if (segment.joined()) continue;  // its pieces speak for it
    const auto first = std::lower_bound(candidate->claimed.begin(), candidate->claimed.end(), segment.first);
    const auto last =
        std::lower_bound(candidate->claimed.begin(), candidate->claimed.end(), segment.first + segment.count);
    // Claimed points stand a step apart: each answers for the step.
    const double length = segment.length(), used = std::min(length, double(last - first) * kStep);
    if (last - first < 2) continue;
    used_length += length;
    left_over += std::max(0.0, length - used - kStep);
  }
  candidate->terms.overhang = used_length > 0 ? left_over / used_length : 0;
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
  candidate->claimed.clear();
  candidate->covered.clear();
  candidate->terms = EvidenceTerms();
  candidate->contour = resolvedContour(
      model.model(),
      projectContour(model.model(), candidate->pose.camera_from_object, image.camera, image.domain, kStep));
  matchSamples(image, candidate);
  contourTerms(image, candidate);
  boundingBox(image, candidate);
}

void weighDrawing(const SearchModel& model, const SearchImage& image, Candidate* candidate) {
  continuationTerm(image, model.model(), candidate);
  overhangTerm(image, candidate);
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
