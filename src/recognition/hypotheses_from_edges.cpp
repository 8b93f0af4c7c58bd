#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "recognition/best_of_places.h"
#include "recognition/focal_length.h"
#include "recognition/hypotheses.h"
#include "recognition/shared_work.h"

namespace monocular_eye_hand {
namespace {

constexpr double kMinSegment = 14.0;  // shortest segment that fixes roll and scale well enough [px]
constexpr int kFlatPerPlace = 24;     // flat candidates
// Flat evidence a candidate must have collected after 4, 8 and all samples, in map units.
constexpr int kAfter4 = int(-1.5f * kEvidenceUnit), kAfter8 = int(0.0f * kEvidenceUnit);
constexpr int kAfterAll = int(6.0f * kEvidenceUnit);
constexpr int kNever = -10000;     // of a candidate that is given up
constexpr int kOutsideValue = -4;  // a sample beyond the image says little

// A segment, from one of its ends: the base edges of the view templates are laid on it.
struct ImageEdge {
  Eigen::Vector2d p, q;  // its ends [uv_rect px]
  float px, py, dx, dy;  // first end and extent in half-resolution map pixels
  int direction;         // in 256ths of pi, plus the rounding of a bin
};

// A view template, laid with its base edge on an edge of the image.
struct FlatCandidate {
  float score = 0;
  int edge = 0, level = 0, view_template = 0;

  bool betterThan(const FlatCandidate& other) const {
    if (score != other.score) return score > other.score;
    return std::tie(edge, level, view_template) < std::tie(other.edge, other.level, other.view_template);
  }
};

// The best flat candidates of every place.
struct FlatCandidates {
  const SearchImage& image;
  BestOfPlaces<FlatCandidate> best{image.camera.width, image.camera.height, kFlatPerPlace};

  FlatCandidates emptied() const { return {image}; }
  void add(FlatCandidates&& other) { best.add(std::move(other.best)); }
};

// Templates of one level whose base edge may be as long as an edge, where the part may be.
struct Fitting {
  size_t first = 0, last = 0;
};

// orientation of (angle in the template + direction of the edge) -> bin
std::array<uint8_t, 512> makeBinTable() {
  std::array<uint8_t, 512> table{};
  for (int i = 0; i < 512; ++i)
    table[i] = uint8_t(int(std::lround((i & 255) * double(kOrientationBins) / 256.0)) % kOrientationBins);
  return table;
}

int templateEvidence(const ViewTemplate& shape, const ImageEdge& edge, const EvidencePlanes& map,
                     const std::array<uint8_t, 512>& bins) {
  constexpr std::array<int, 3> kEnds{4, 8, ViewTemplate::kSamples};
  constexpr std::array<int, 3> kMinSums{kAfter4, kAfter8, kNever};
  std::array<int, ViewTemplate::kSamples> places;
  int sum = 0;
  int first = 0;

  for (size_t part = 0; part < kEnds.size(); ++part) {
    // All places first, then their values: the memory answers many at a time.
    for (int i = first; i < kEnds[part]; ++i) {
      const float u = edge.px + edge.dx * shape.x[i] - edge.dy * shape.y[i];
      const float v = edge.py + edge.dx * shape.y[i] + edge.dy * shape.x[i];
      places[i] = u >= 0 && v >= 0 ? map.index(bins[shape.angle[i] + edge.direction], int(u), int(v)) : -1;
    }
    for (int i = first; i < kEnds[part]; ++i) {
      const int8_t seen = places[i] < 0 ? kOutside : map.value(places[i]);
      sum += seen == kOutside ? kOutsideValue : int(seen);  // NOLINT(bugprone-signed-char-misuse)
    }
    if (sum < kMinSums[part]) return kNever;
    first = kEnds[part];
  }
  return sum;
}

// The pose that lays the base edge of the template on the edge.
Rigid3 poseFromTemplate(const SearchModel& model, const ViewTemplate& shape, const ImageEdge& edge,
                        const Camera& camera) {
  const Eigen::Vector2d& p = edge.p;
  const Eigen::Vector2d ab = (shape.b - shape.a).cast<double>();
  const Eigen::Vector2d pq = edge.q - p;
  const double scale = pq.norm() / ab.norm();  // px per metre at the object's centre
  const double roll = std::atan2(pq.y(), pq.x()) - std::atan2(ab.y(), ab.x());
  const Eigen::Vector2d centre_uv =
      p + scale * (Eigen::Rotation2Dd(roll) * Eigen::Vector2d(-shape.a.cast<double>()));
  const Eigen::Vector3d ray = camera.ray(centre_uv).normalized();

  // Off the axis a small object appears magnified by 1/cos across and 1/cos^2 along the radius.
  const double focal = focalLength(camera);
  const double distance = focal / (scale * std::pow(ray.z(), 1.5));

  Rigid3 pose;
  pose.rotation = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), ray).toRotationMatrix() *
                  Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
                  model.viewRotation(shape.view);
  pose.translation = distance * ray - pose.rotation * model.model().centre();
  return pose;
}

// A coordinate of the image [uv_rect px] as one of the half-resolution map that begins at `origin`, and back.
float inHalfMap(double image, int origin) { return float(image - origin) * 0.5f + 0.5f; }
float inImage(float half, int origin) { return (half - 0.5f) * 2 + float(origin); }

// What the image says for an edge along the segment: much where little else is like it [map units].
double evidenceAlong(const LineSegment& segment, const EvidenceMap& map) {
  const Eigen::Vector2d along = segment.q - segment.p;
  const int steps = int(segment.length());
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const int8_t value = map.at(segment.p + along * (double(i) / steps), along);
    if (value != kOutside) sum += value;
  }
  return sum;
}

// The segments from both ends.
std::vector<ImageEdge> imageEdgesOf(const SearchImage& image, const std::vector<int>& chosen) {
  const std::vector<LineSegment>& segments = image.features.segments;
  std::vector<ImageEdge> edges;
  const auto add = [&](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    const Eigen::Vector2d d = q - p;
    ImageEdge edge{p, q, 0, 0, float(d.x()) * 0.5f, float(d.y()) * 0.5f, 0};
    edge.px = inHalfMap(p.x(), image.map.u0());
    edge.py = inHalfMap(p.y(), image.map.v0());
    edge.direction = int(std::lround(std::atan2(d.y(), d.x()) / M_PI * 256.0)) & 255;
    edges.push_back(edge);
  };
  for (int s : chosen) {
    add(segments[size_t(s)].p, segments[size_t(s)].q);
    add(segments[size_t(s)].q, segments[size_t(s)].p);
  }
  return edges;
}

Fitting fittingTemplates(const TemplateLevel& level, double length, double near, double far) {
  const auto shorter = [](const ViewTemplate& shape, double value) { return double(shape.length) < value; };
  const auto first = std::lower_bound(level.templates.begin(), level.templates.end(), length * near, shorter);
  const auto longer = [](double value, const ViewTemplate& shape) { return value < double(shape.length); };
  const auto last = std::upper_bound(first, level.templates.end(), length * far, longer);
  return {size_t(first - level.templates.begin()), size_t(last - level.templates.begin())};
}

// A search for the views of one object along the edges of an image.
struct TemplateSearch {
  const SearchImage& image;
  const SearchModel& model;
  DistanceRange range;
  const std::vector<ImageEdge>& edges;

  void lay(int r, FlatCandidates* found, WorkBudget* budget) const {
    const Camera& camera = image.camera;
    const double focal = focalLength(camera);
    const double diameter = model.model().diameter;
    const double length = (edges[size_t(r)].q - edges[size_t(r)].p).norm();
    for (size_t l = 0; l < model.levels().size(); ++l) {
      const TemplateLevel& level = model.levels()[l];
      const double nearest = std::max(range.nearest, level.min_ratio * diameter);
      const double farthest = std::min(range.farthest, level.max_ratio * diameter);
      const Fitting fitting = fittingTemplates(level, length, nearest / focal, farthest / focal);
      for (size_t a = fitting.first; a < fitting.last && !budget->workSpent(); ++a)
        layTemplate(r, int(l), int(a), float(length), found, budget);
    }
  }

 private:
  void layTemplate(int r, int l, int a, float length, FlatCandidates* found, WorkBudget* budget) const {
    static const std::array<uint8_t, 512> kBins = makeBinTable();
    const ImageEdge& edge = edges[size_t(r)];
    const ViewTemplate& shape = model.levels()[size_t(l)].templates[size_t(a)];
    budget->count();

    // The object's centre decides the place.
    const float u = inImage(edge.px + edge.dx * shape.centre_x - edge.dy * shape.centre_y, image.map.u0());
    const float v = inImage(edge.py + edge.dx * shape.centre_y + edge.dy * shape.centre_x, image.map.v0());
    if (!found->best.hasPlace(u, v)) return;

    const int sum = templateEvidence(shape, edge, image.map.half(), kBins);
    if (sum < kAfterAll) return;
    const float score = float(sum) * shape.contour / shape.length * length;
    found->best.offer(u, v, {score, r, l, a});
  }
};

}  // namespace

std::vector<int> mostTellingSegments(const SearchImage& image, const std::vector<char>& usable,
                                     size_t max_count) {
  const std::vector<LineSegment>& segments = image.features.segments;
  std::vector<int> order;
  std::vector<double> said(segments.size(), 0);
  for (size_t s = 0; s < segments.size(); ++s) {
    if (!usable[s] || segments[s].length() < kMinSegment) continue;
    order.push_back(int(s));
    said[s] = evidenceAlong(segments[s], image.map);
  }

  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return said[size_t(a)] > said[size_t(b)]; });
  if (order.size() > max_count) order.resize(max_count);
  return order;
}

void hypothesesFromEdges(const SearchTask& task, int object, const std::vector<int>& segments,
                         HypothesisPool* pool, WorkBudget* budget) {
  const SearchImage& image = task.image;
  const SearchModel& model = task.models[size_t(object)];
  const DistanceRange range = searchedDistances(task, model.model());
  const std::vector<ImageEdge> edges = imageEdgesOf(image, segments);
  const TemplateSearch search{image, model, range, edges};

  FlatCandidates flat{image};
  gather(&flat, budget, [&](const WorkShare& share, WorkBudget* part, FlatCandidates* found) {
    for (int r = share.first; r < int(edges.size()) && !part->spent(); r += share.step)
      search.lay(r, found, part);
  });

  const std::vector<FlatCandidate> candidates = flat.best.all();
  gather(pool, budget, [&](const WorkShare& share, WorkBudget* part, HypothesisPool* best) {
    for (size_t i = size_t(share.first); i < candidates.size(); i += size_t(share.step)) {
      const FlatCandidate& c = candidates[i];
      const ViewTemplate& shape = model.levels()[size_t(c.level)].templates[size_t(c.view_template)];
      best->offer(poseFromTemplate(model, shape, edges[size_t(c.edge)], image.camera), GroupingKind::kEdge,
                  image.map, part);
    }
  });
}

}  // namespace monocular_eye_hand
