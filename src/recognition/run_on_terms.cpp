#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "recognition/drawing_terms.h"

namespace monocular_eye_hand {
namespace {

constexpr double kShortestEdge = 12;      // in the image, of those whose ends are looked at [px]
constexpr double kNearEnd = 18;           // samples within this of an end tell whether the edge is there [px]
constexpr double kFirstLook = 4;          // beyond the end [px]
constexpr double kLookStep = 2;           // between looks [px]
constexpr double kSameLineCosine = 0.94;  // |cos| of the angle between lines that run the same way
constexpr double kRunsOn = 0.95;          // ... between an edge and the edge that runs on from it
constexpr double kByChance = 0.25;        // share of the looks that find an edge by chance

using Samples = std::vector<const SeenSample*>;

// Whether the drawing itself has a line here with this direction.
bool drawn(const std::vector<SeenSample>& contour, const Eigen::Vector2d& uv,
           const Eigen::Vector2d& direction, int except_feature) {
  constexpr double kNear = 5;  // [px]
  return std::any_of(contour.begin(), contour.end(), [&](const SeenSample& s) {
    return s.feature != except_feature && std::abs(s.direction.dot(direction)) > kSameLineCosine &&
           (s.uv - uv).squaredNorm() < kNear * kNear;
  });
}

// The edge must be there right up to its end, else nothing can run on from it.
bool reachesItsEnd(const Samples& samples, const Eigen::Vector2d& end) {
  int near = 0, hits = 0;
  for (const SeenSample* s : samples) {
    if (!s->inside || (s->uv - end).norm() > kNearEnd) continue;
    ++near;
    hits += s->edge_point >= 0;
  }
  return near >= 2 && hits * 2 >= near;
}

// RunOns beyond the end of an edge, and those that find an edge that runs on.
struct RunOns {
  int looked = 0, on = 0;
  // Share that runs on, less what chance gives.
  double share() const { return std::max(0.0, (double(on) / looked - kByChance) / (1 - kByChance)); }
};

RunOns lookBeyond(const SearchImage& image, const std::vector<SeenSample>& contour, int edge,
                  const Eigen::Vector2d& end, const Eigen::Vector2d& outward, double reach) {
  const Eigen::Vector2d normal(-outward.y(), outward.x());
  RunOns looks;
  for (double d = kFirstLook; d <= reach; d += kLookStep) {
    const Eigen::Vector2d uv = end + d * outward;
    if (!image.domain.contains(uv.x(), uv.y()) || drawn(contour, uv, outward, edge)) break;
    ++looks.looked;
    const int found = image.raster.find(uv, normal, 1.5 + 0.03 * d);
    if (found < 0) continue;
    looks.on += std::abs(image.raster.point(found).normal.cast<double>().dot(normal)) > kRunsOn;
  }
  return looks;
}

// An image edge that runs straight on past a model edge's end contradicts the end: the part of a larger box,
// a tile.
void continuationTerm(const ObjectModel& model, const SearchImage& image, Candidate* candidate) {
  const Rigid3& pose = candidate->pose.camera_from_object;
  std::map<int, Samples> by_edge;
  for (const SeenSample& s : candidate->contour)
    if (s.feature < int(model.edges.size())) by_edge[s.feature].push_back(&s);

  double running = 0;
  int tested = 0;
  for (const auto& [e, samples] : by_edge) {
    const ModelEdge& edge = model.edges[size_t(e)];
    const Eigen::Vector3d p = pose * edge.p, q = pose * edge.q;
    if (p.z() <= 1e-3 || q.z() <= 1e-3) continue;
    const std::array<Eigen::Vector2d, 2> ends{image.camera.project(p), image.camera.project(q)};
    const double length = (ends[1] - ends[0]).norm();
    if (length < kShortestEdge) continue;

    const double reach = std::clamp(0.35 * length, 8.0, 24.0);
    for (size_t k = 0; k < 2; ++k) {
      if (!reachesItsEnd(samples, ends[k])) continue;
      const Eigen::Vector2d outward = (ends[k] - ends[1 - k]) / length;
      const RunOns looks = lookBeyond(image, candidate->contour, e, ends[k], outward, reach);
      if (looks.looked < 2) continue;
      ++tested;
      running += looks.share();
    }
  }
  candidate->terms.ends = tested;
  candidate->terms.continuation = tested > 0 ? running / tested : 0;
}

// Image segments that the drawing uses only in part: what is left over belongs to something else.
void overhangTerm(const SearchImage& image, Candidate* candidate) {
  const std::vector<int>& claimed = candidate->claimed;
  double used_length = 0, left_over = 0;
  for (const LineSegment& segment : image.features.segments) {
    if (segment.joined()) continue;  // its pieces speak for it
    const auto first = std::lower_bound(claimed.begin(), claimed.end(), segment.first);
    const auto last = std::lower_bound(first, claimed.end(), segment.first + segment.count);
    if (last - first < 2) continue;

    // Claimed points stand a step apart: each answers for the step.
    const double length = segment.length(), used = std::min(length, double(last - first) * kStep);
    used_length += length;
    left_over += std::max(0.0, length - used - kStep);
  }
  candidate->terms.overhang = used_length > 0 ? left_over / used_length : 0;
}

}  // namespace

void runOnTerms(const ObjectModel& model, const SearchImage& image, Candidate* candidate) {
  continuationTerm(model, image, candidate);
  overhangTerm(image, candidate);
}

}  // namespace monocular_eye_hand
