#include <algorithm>
#include <cmath>

#include "recognition/hypotheses.h"

namespace monocular_eye_hand {
namespace {

constexpr double kMinSegment = 14.0;  // shortest segment that fixes roll and scale well enough [px]
constexpr double kCell = 32.0;        // places among which the flat candidates are spread [px]
constexpr int kPerCell = 24;
// Flat evidence a candidate must have collected after 4, 8 and all samples, in map units.
constexpr int kAfter4 = int(-1.5f * kEvidenceUnit), kAfter8 = int(0.0f * kEvidenceUnit);
constexpr int kAfterAll = int(6.0f * kEvidenceUnit);
constexpr int kNever = -10000;     // of a candidate that is given up
constexpr int kOutsideValue = -4;  // a sample beyond the image says little

struct FlatCandidate {
  float score = 0;
  int level = 0, anchor = 0, segment = 0;
  bool reversed = false;
};

struct Ruler {
  float px, py, dx, dy;  // first end and extent in half-resolution map pixels
  int turn;              // direction in 256ths of pi, plus the rounding of a bin
};

// orientation of (anchor angle + turn) -> bin
std::array<uint8_t, 512> makeBinTable() {
  std::array<uint8_t, 512> table{};
  for (int i = 0; i < 512; ++i)
    table[i] = uint8_t(int(std::lround((i & 255) * double(kOrientationBins) / 256.0)) % kOrientationBins);
  return table;
}

int flatEvidence(const Anchor& anchor, const Ruler& ruler, const EvidencePlanes& map,
                 const std::array<uint8_t, 512>& bins) {
  constexpr std::array<int, 3> kEnds{4, 8, Anchor::kSamples};
  constexpr std::array<int, 3> kLeast{kAfter4, kAfter8, kNever};
  std::array<int, Anchor::kSamples> places;
  int sum = 0;
  int first = 0;
  for (size_t part = 0; part < kEnds.size(); ++part) {
    // All places first, then their values: the memory answers many at a time.
    for (int i = first; i < kEnds[part]; ++i) {
      const float u = ruler.px + ruler.dx * anchor.x[i] - ruler.dy * anchor.y[i];
      const float v = ruler.py + ruler.dx * anchor.y[i] + ruler.dy * anchor.x[i];
      places[i] = u >= 0 && v >= 0 ? map.index(bins[anchor.angle[i] + ruler.turn], int(u), int(v)) : -1;
    }
    for (int i = first; i < kEnds[part]; ++i) {
      const int8_t seen = places[i] < 0 ? kOutside : map.value(places[i]);
      sum += seen == kOutside ? kOutsideValue : int(seen);  // NOLINT(bugprone-signed-char-misuse)
    }
    if (sum < kLeast[part]) return kNever;
    first = kEnds[part];
  }
  return sum;
}

// The pose that lays the flat template on the segment p -> q (uv_rect).
Rigid3 poseFromRuler(const SearchModel& model, const Anchor& anchor, const Eigen::Vector2d& p,
                     const Eigen::Vector2d& q, const Camera& camera) {
  const Eigen::Vector2d ab = (anchor.b - anchor.a).cast<double>(), pq = q - p;
  const double scale = pq.norm() / ab.norm();  // px per metre at the object's centre
  const double roll = std::atan2(pq.y(), pq.x()) - std::atan2(ab.y(), ab.x());
  const Eigen::Vector2d centre_uv =
      p + scale * (Eigen::Rotation2Dd(roll) * Eigen::Vector2d(-anchor.a.cast<double>()));
  const Eigen::Vector3d ray = camera.ray(centre_uv).normalized();
  // Off the axis a small object appears magnified by 1/cos across and 1/cos^2 along the radius.
  const double focal = std::sqrt(camera.fx * camera.fy);
  const double distance = focal / (scale * std::pow(ray.z(), 1.5));
  Rigid3 pose;
  pose.rotation = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), ray).toRotationMatrix() *
                  Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
                  model.viewRotation(anchor.view);
  pose.translation = distance * ray - pose.rotation * model.model().centre();
  return pose;
}

// The segments that may serve as rulers.
std::vector<int> longestFirst(const std::vector<LineSegment>& segments, const std::vector<char>& usable) {
  std::vector<int> order;
  for (size_t s = 0; s < segments.size(); ++s)
    if (usable[s] && segments[s].length() >= kMinSegment) order.push_back(int(s));
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return segments[a].length() > segments[b].length(); });
  return order;
}

}  // namespace

void hypothesesFromEdges(const SearchImage& image, const SearchModel& model,
                         const RecognitionOptions& options, const std::vector<char>& usable,
                         HypothesisPool* pool, WorkBudget* budget) {
  static const std::array<uint8_t, 512> kBins = makeBinTable();
  const Camera& camera = image.camera;
  const double focal = std::sqrt(camera.fx * camera.fy), diameter = model.model().diameter;
  const double max_distance = std::min(options.max_distance, diameter * focal / options.min_size);
  const int cells_x = int(std::ceil(camera.width / kCell)), cells_y = int(std::ceil(camera.height / kCell));
  std::vector<std::vector<FlatCandidate>> cells(size_t(cells_x) * cells_y);
  const auto better = [](const FlatCandidate& a, const FlatCandidate& b) { return a.score > b.score; };

  const auto& segments = image.features.segments;
  for (int s : longestFirst(segments, usable)) {
    if (budget->spent()) break;
    const double length = segments[s].length();
    for (int reversed = 0; reversed < 2; ++reversed) {
      const Eigen::Vector2d p = reversed ? segments[s].q : segments[s].p;
      const Eigen::Vector2d q = reversed ? segments[s].p : segments[s].q;
      const Eigen::Vector2d d = q - p;
      Ruler ruler;
      ruler.px = float(p.x() - image.map.u0()) * 0.5f + 0.5f;
      ruler.py = float(p.y() - image.map.v0()) * 0.5f + 0.5f;
      ruler.dx = float(d.x()) * 0.5f;
      ruler.dy = float(d.y()) * 0.5f;
      ruler.turn = int(std::lround(std::atan2(d.y(), d.x()) / M_PI * 256.0)) & 255;
      for (size_t l = 0; l < model.levels().size(); ++l) {
        const AnchorLevel& level = model.levels()[l];
        const double near = std::max(options.nearest(diameter), level.min_ratio * diameter);
        const double far = std::min(max_distance, level.max_ratio * diameter);
        const float shortest = float(length * near / focal), longest = float(length * far / focal);
        auto it = std::lower_bound(level.anchors.begin(), level.anchors.end(), shortest,
                                   [](const Anchor& a, float value) { return a.length < value; });
        for (; it != level.anchors.end() && it->length <= longest && !budget->workSpent(); ++it) {
          budget->count();
          const int sum = flatEvidence(*it, ruler, image.map.half(), kBins);
          if (sum < kAfterAll) continue;
          FlatCandidate candidate;
          candidate.score = float(sum) * it->contour / it->length * float(length);
          // The object's centre decides the place.
          const float cu = 2 * (ruler.px + ruler.dx * it->centre_x - ruler.dy * it->centre_y);
          const float cv = 2 * (ruler.py + ruler.dx * it->centre_y + ruler.dy * it->centre_x);
          const int x = std::clamp(int(cu / kCell), 0, cells_x - 1),
                    y = std::clamp(int(cv / kCell), 0, cells_y - 1);
          auto& cell = cells[size_t(y) * cells_x + x];
          candidate.level = int(l);
          candidate.anchor = int(it - level.anchors.begin());
          candidate.segment = s;
          candidate.reversed = reversed;
          if (int(cell.size()) < kPerCell) {
            cell.push_back(candidate);
            std::push_heap(cell.begin(), cell.end(), better);
          } else if (candidate.score > cell.front().score) {
            std::pop_heap(cell.begin(), cell.end(), better);
            cell.back() = candidate;
            std::push_heap(cell.begin(), cell.end(), better);
          }
        }
      }
    }
  }
  for (const auto& cell : cells)
    for (const FlatCandidate& c : cell) {
      const LineSegment& segment = segments[c.segment];
      const Anchor& anchor = model.levels()[c.level].anchors[c.anchor];
      pool->offer(c.reversed ? poseFromRuler(model, anchor, segment.q, segment.p, camera)
                             : poseFromRuler(model, anchor, segment.p, segment.q, camera),
                  GroupingKind::kEdge, image.map, budget);
    }
}

}  // namespace monocular_eye_hand
