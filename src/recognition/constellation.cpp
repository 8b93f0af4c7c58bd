#include "recognition/constellation.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace monocular_eye_hand {
namespace {

constexpr double kSameCorner = 1.5;         // [px]
constexpr double kMaxCornerDistance = 4.0;  // farthest image corner that answers a model corner [px]
constexpr double kSameLine = 0.985;  // cosine between a model edge's image and the segment that answers it

bool lineMeets(const Eigen::Vector2d& direction, const ImageCorner& corner, const FeatureSet& features) {
  return std::any_of(corner.segments.begin(), corner.segments.end(), [&](int s) {
    return std::abs(features.segments[s].direction().dot(direction)) > kSameLine;
  });
}

// How many of the candidate's visible edges at this model corner have a segment at this image corner.
int agreeingEdges(const SearchModel& model, const Candidate& candidate, const Camera& camera,
                  int corner_index, const ImageCorner& corner, const FeatureSet& features,
                  const std::vector<char>& visible) {
  const Rigid3& pose = candidate.pose.camera_from_object;
  int agreeing = 0;
  for (int e : model.model().corners[corner_index].edges) {
    if (!visible[e]) continue;
    const ModelEdge& edge = model.model().edges[e];
    const Eigen::Vector3d p = pose * edge.p, q = pose * edge.q;
    if (p.z() <= 1e-3 || q.z() <= 1e-3) continue;
    const Eigen::Vector2d d = camera.project(q) - camera.project(p);
    if (d.norm() > 4) agreeing += lineMeets(d.normalized(), corner, features);
  }
  return agreeing;
}

}  // namespace

std::vector<ImageCorner> imageCorners(const std::vector<Grouping>& groupings) {
  std::vector<ImageCorner> all;
  const auto add = [&](const Grouping& g, size_t point, std::initializer_list<size_t> segments) {
    if (point >= g.points.size() || point >= g.sigma.size()) return;
    ImageCorner corner;
    corner.uv = g.points[point];
    corner.sigma = std::max(0.2, g.sigma[point]);
    for (size_t s : segments)
      if (s < g.segments.size() && g.segments[s] >= 0) corner.segments.push_back(g.segments[s]);
    all.push_back(corner);
  };

  for (const Grouping& g : groupings) {
    if (g.kind == GroupingKind::kJunction) add(g, 1, {0, 1});
    if (g.kind == GroupingKind::kTriplet) add(g, 0, {0, 1, 2});
  }

  std::stable_sort(all.begin(), all.end(), [](const ImageCorner& a, const ImageCorner& b) {
    return std::make_tuple(-int(a.segments.size()), a.sigma) <
           std::make_tuple(-int(b.segments.size()), b.sigma);
  });

  std::vector<ImageCorner> kept;
  for (ImageCorner& corner : all) {
    ImageCorner* same = nullptr;
    for (ImageCorner& k : kept)
      if ((k.uv - corner.uv).norm() < kSameCorner) {
        same = &k;
        break;
      }
    if (!same) {
      kept.push_back(corner);
      continue;
    }
    for (int s : corner.segments)
      if (std::find(same->segments.begin(), same->segments.end(), s) == same->segments.end())
        same->segments.push_back(s);
  }
  return kept;
}

std::vector<PointMatch> growConstellation(const SearchModel& model, const Candidate& candidate,
                                          const Camera& camera, const FeatureSet& features,
                                          const std::vector<ImageCorner>& corners) {
  std::vector<char> visible(model.model().edges.size(), 0);
  for (const SeenSample& s : candidate.contour)
    if (s.inside && s.feature < int(visible.size())) visible[s.feature] = 1;

  struct Pair {
    int agreeing;
    double distance;
    int model_corner, image_corner;
  };
  std::vector<Pair> pairs;
  for (size_t m = 0; m < model.model().corners.size(); ++m) {
    const Eigen::Vector3d p = candidate.pose.camera_from_object * model.model().corners[m].p;
    if (p.z() <= 1e-3) continue;
    const Eigen::Vector2d uv = camera.project(p);
    for (size_t i = 0; i < corners.size(); ++i) {
      const double distance = (corners[i].uv - uv).norm();
      if (distance > kMaxCornerDistance) continue;
      const int agreeing = agreeingEdges(model, candidate, camera, int(m), corners[i], features, visible);
      if (agreeing >= 2) pairs.push_back({agreeing, distance, int(m), int(i)});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::make_tuple(-a.agreeing, a.distance) < std::make_tuple(-b.agreeing, b.distance);
  });
  std::vector<char> model_used(model.model().corners.size(), 0), image_used(corners.size(), 0);
  std::vector<PointMatch> matches;
  for (const Pair& pair : pairs) {
    if (model_used[pair.model_corner] || image_used[pair.image_corner]) continue;
    model_used[pair.model_corner] = image_used[pair.image_corner] = 1;
    matches.push_back({model.model().corners[pair.model_corner].p, corners[pair.image_corner].uv,
                       corners[pair.image_corner].sigma});
  }
  return matches;
}

}  // namespace monocular_eye_hand
