#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "monocular_eye_hand/features/joining.h"
#include "monocular_eye_hand/features/line_fitting.h"

namespace monocular_eye_hand {
namespace {

constexpr double kAngleCell = 4 * M_PI / 180, kOffsetCell = 6;  // rad, px
constexpr double kFar = 1e18;                                   // px: beyond every place
constexpr int kNeighbours = 6;  // candidates looked at on each side of a segment along its line

struct Line {
  double angle, offset;  // direction in [0, pi), signed distance from the reference point
  double along;          // middle along the direction
};

// What collinear() asks of a segment, computed once.
struct Stretch {
  Eigen::Vector2d p, q, middle, direction;
  double length, sigma_offset, sigma_angle;
  explicit Stretch(const LineSegment& s)
      : p(s.p),
        q(s.q),
        middle(0.5 * (s.p + s.q)),
        direction(s.direction()),
        length(s.length()),
        sigma_offset(s.sigma_offset),
        sigma_angle(s.sigma_angle) {}
};

// A segment in its cell of (angle, offset), by its place along the line.
struct Entry {
  int64_t cell;
  double along;
  int segment;
  bool operator<(const Entry& other) const {
    return std::tie(cell, along, segment) < std::tie(other.cell, other.along, other.segment);
  }
};
int64_t cellOf(int angle_cell, int offset_cell) { return angle_cell * (int64_t(1) << 32) + offset_cell; }

// One candidate join.
struct Pair {
  int a, b;
  double gap;
};

class SegmentJoiner {
 public:
  SegmentJoiner(const std::vector<LineSegment>& plain, const FeatureOptions& options)
      : plain_(plain), options_(options), parent_(plain.size()) {
    for (const LineSegment& s : plain) reference_ += 0.5 * (s.p + s.q);
    if (!plain.empty()) reference_ /= double(plain.size());
    for (size_t i = 0; i < plain.size(); ++i) parent_[i] = int(i);
    stretches_.reserve(plain.size());
    for (const LineSegment& s : plain) stretches_.emplace_back(s);
  }

  std::vector<LineSegment> run() {
    std::vector<Pair> pairs = candidates();
    std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
      return x.gap != y.gap ? x.gap < y.gap : x.a != y.a ? x.a < y.a : x.b < y.b;
    });
    members_.resize(plain_.size());
    for (size_t i = 0; i < plain_.size(); ++i) members_[i] = {int(i)};
    for (const Pair& pair : pairs) tryJoin(pair);
    std::vector<LineSegment> out;
    for (size_t i = 0; i < plain_.size(); ++i)
      if (parent_[i] == int(i) && members_[i].size() > 1) out.push_back(joined(members_[i]));
    return out;
  }

 private:
  Line lineOf(const LineSegment& s) const {
    Eigen::Vector2d d = s.direction();
    if (d.y() < 0 || (d.y() == 0 && d.x() < 0)) d = -d;
    const Eigen::Vector2d m = 0.5 * (s.p + s.q) - reference_;
    return {std::atan2(d.y(), d.x()), d.x() * m.y() - d.y() * m.x(), d.dot(m)};
  }

  // Segments whose lines fall into the same or neighbouring cells of (angle, offset), near each other along
  // the line. The offset is taken about the middle of all segments; a far segment's offset moves with its
  // angle error, which is why the cells are as wide as they are.
  std::vector<Pair> candidates() const {
    std::vector<Entry> entries;
    std::vector<Line> lines;
    const int turns = int(std::lround(M_PI / kAngleCell));
    const auto angleCell = [&](const Line& l) { return std::min(turns - 1, int(l.angle / kAngleCell)); };
    const auto offsetCell = [](double offset) { return int(std::floor(offset / kOffsetCell)); };
    for (int i = 0; i < int(plain_.size()); ++i) {
      lines.push_back(lineOf(plain_[i]));
      entries.push_back({cellOf(angleCell(lines[i]), offsetCell(lines[i].offset)), lines[i].along, i});
    }
    std::sort(entries.begin(), entries.end());
    std::vector<Pair> pairs;
    for (int i = 0; i < int(plain_.size()); ++i) {
      const Line& l = lines[i];
      for (int da = -1; da <= 1; ++da) {
        const int a = angleCell(l) + da;
        const bool flipped = a < 0 || a >= turns;  // past 0 or pi the direction and the offset change sign
        const double sign = flipped ? -1 : 1;
        const int64_t middle = cellOf((a + turns) % turns, offsetCell(sign * l.offset));
        // Cells that differ by one in the offset lie one after the other.
        auto from = std::lower_bound(entries.begin(), entries.end(), Entry{middle - 1, -kFar, -1});
        while (from != entries.end() && from->cell <= middle + 1) {
          auto to = from;
          while (to != entries.end() && to->cell == from->cell) ++to;
          look(i, sign * l.along, from, to, &pairs);
          from = to;
        }
      }
    }
    return pairs;
  }

  // Looks at the entries of a cell before and after a place in it.
  using Place = std::vector<Entry>::const_iterator;
  void look(int i, double along, Place begin, Place end, std::vector<Pair>* pairs) const {
    const Place here = std::lower_bound(begin, end, Entry{begin->cell, along, i});
    const Place first = here - std::min<std::ptrdiff_t>(kNeighbours, here - begin);
    const Place last = here + std::min<std::ptrdiff_t>(kNeighbours, end - here);
    for (Place it = first; it != last; ++it) consider(i, it->segment, pairs);
  }

  void consider(int i, int j, std::vector<Pair>* pairs) const {
    if (i >= j) return;  // each pair is met from both sides; keep one
    double gap;
    if (collinear(stretches_[i], stretches_[j], &gap)) pairs->push_back({i, j, gap});
  }

  // Two segments on one line: no overlap, a gap within the ratio, ends of each within the uncertainty of the
  // other.
  bool collinear(const Stretch& a, const Stretch& b, double* gap) const {
    const Stretch &longer = a.length >= b.length ? a : b, &shorter = a.length >= b.length ? b : a;
    const Eigen::Vector2d &d = longer.direction, n(-d.y(), d.x()), &m = longer.middle;
    const double half = 0.5 * longer.length;
    double t0 = d.dot(shorter.p - m), t1 = d.dot(shorter.q - m);
    if (t0 > t1) std::swap(t0, t1);
    *gap = t0 > 0 ? t0 - half : -half - t1;
    const double whole = std::max(half, t1) - std::min(-half, t0);
    if (*gap < -2.0 || *gap > options_.join_gap_ratio * whole) return false;
    const double cross = std::fabs(d.x() * shorter.direction.y() - d.y() * shorter.direction.x());
    if (!(cross < std::max(0.05, std::min(0.2, 4 * shorter.sigma_angle)))) return false;
    const double most_aside = options_.split_tolerance + 0.5;
    for (const Eigen::Vector2d& end : {shorter.p, shorter.q}) {
      const double along = d.dot(end - m), aside = std::fabs(n.dot(end - m));
      if (aside > most_aside) return false;
      const double sigma =
          std::sqrt(longer.sigma_offset * longer.sigma_offset + std::pow(longer.sigma_angle * along, 2) +
                    shorter.sigma_offset * shorter.sigma_offset +
                    std::pow(0.5 * shorter.length * shorter.sigma_angle, 2));
      if (aside > 3 * sigma + 0.3) return false;
    }
    return true;
  }

  int root(int i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }

  void tryJoin(const Pair& pair) {
    const int a = root(pair.a), b = root(pair.b);
    if (a == b) return;
    double gap;
    const LineSegment left = members_[a].size() > 1 ? joined(members_[a]) : plain_[a];
    const LineSegment right = members_[b].size() > 1 ? joined(members_[b]) : plain_[b];
    if (!collinear(Stretch(left), Stretch(right), &gap)) return;
    const int keep = std::min(a, b), drop = std::max(a, b);
    parent_[drop] = keep;
    members_[keep].insert(members_[keep].end(), members_[drop].begin(), members_[drop].end());
    members_[drop].clear();
  }

  // Weighted line through the pieces, each standing for its middle and ends with its own uncertainty.
  LineSegment joined(const std::vector<int>& pieces) const {
    double w = 0, xx = 0, xy = 0, yy = 0;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    int longest = pieces[0];
    for (int i : pieces) {
      const LineSegment& s = plain_[i];
      const double wi = 1 / (s.sigma_offset * s.sigma_offset);
      w += wi;
      mean += wi * 0.5 * (s.p + s.q);
      if (s.length() > plain_[longest].length()) longest = i;
    }
    mean /= w;
    for (int i : pieces) {
      const LineSegment& s = plain_[i];
      const double wi = 1 / (s.sigma_offset * s.sigma_offset);
      const Eigen::Vector2d c = 0.5 * (s.p + s.q) - mean, h = 0.5 * (s.q - s.p);
      // Second moments of a piece of even density about its own middle: a third of the half length squared.
      xx += wi * (c.x() * c.x() + h.x() * h.x() / 3);
      xy += wi * (c.x() * c.y() + h.x() * h.y() / 3);
      yy += wi * (c.y() * c.y() + h.y() * h.y() / 3);
    }
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
    Eigen::Vector2d d(std::cos(angle), std::sin(angle));
    const LineSegment& main = plain_[longest];
    if (d.dot(main.direction()) < 0) d = -d;
    LineSegment out = main;
    double low = kFar, high = -kFar, contrast = 0, length = 0;
    for (int i : pieces) {
      const LineSegment& s = plain_[i];
      for (int end = 0; end < 2; ++end) {
        const double t = d.dot((end == 0 ? s.p : s.q) - mean), sigma = end == 0 ? s.sigma_p : s.sigma_q;
        if (t < low) low = t, out.sigma_p = sigma;
        if (t > high) high = t, out.sigma_q = sigma;
      }
      contrast += s.contrast * s.length();
      length += s.length();
    }
    out.p = mean + low * d;
    out.q = mean + high * d;
    const double spread = 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
    out.sigma_angle = 1 / std::sqrt(std::max(spread, 1e-9));
    out.sigma_offset = std::sqrt(1 / w + std::pow(out.sigma_angle * 0.5 * (low + high), 2));
    out.contrast = contrast / length;
    out.trace = -1;
    out.pieces = pieces;
    std::sort(out.pieces.begin(), out.pieces.end(), [&](int i, int j) {
      return d.dot(plain_[i].p + plain_[i].q) < d.dot(plain_[j].p + plain_[j].q);
    });
    return out;
  }

  const std::vector<LineSegment>& plain_;
  const FeatureOptions& options_;
  Eigen::Vector2d reference_ = Eigen::Vector2d::Zero();
  std::vector<Stretch> stretches_;
  std::vector<int> parent_;
  std::vector<std::vector<int>> members_;
};

}  // namespace

std::vector<LineSegment> joinSegments(const std::vector<LineSegment>& plain, const FeatureOptions& options) {
  if (options.join_gap_ratio <= 0) return {};
  return SegmentJoiner(plain, options).run();
}

}  // namespace monocular_eye_hand
