#include "features/collinear_pairs.h"

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

constexpr double kAngleCell = 4 * M_PI / 180, kOffsetCell = 6;  // rad, px
constexpr double kFar = 1e18;                                   // px: beyond every place
constexpr int kNeighbours = 6;  // candidates looked at on each side of a segment along its line
constexpr int kAngleCells = int(M_PI / kAngleCell + 0.5);

int angleCell(double angle) { return std::min(kAngleCells - 1, int(angle / kAngleCell)); }
int offsetCell(double offset) { return int(std::floor(offset / kOffsetCell)); }
int64_t cellOf(int angle_cell, int offset_cell) { return angle_cell * (int64_t(1) << 32) + offset_cell; }

}  // namespace

bool collinear(const Stretch& a, const Stretch& b, const FeatureOptions& options, double* gap) {
  const Stretch &longer = a.length >= b.length ? a : b, &shorter = a.length >= b.length ? b : a;
  const Eigen::Vector2d &d = longer.direction, n(-d.y(), d.x()), &m = longer.middle;
  const double half = 0.5 * longer.length;

  double t0 = d.dot(shorter.p - m), t1 = d.dot(shorter.q - m);
  if (t0 > t1) std::swap(t0, t1);
  *gap = t0 > 0 ? t0 - half : -half - t1;
  const double whole = std::max(half, t1) - std::min(-half, t0);
  if (*gap < -2.0 || *gap > options.join_gap_ratio * whole) return false;

  const double cross = std::fabs(d.x() * shorter.direction.y() - d.y() * shorter.direction.x());
  if (!(cross < std::max(0.05, std::min(0.2, 4 * shorter.sigma_angle)))) return false;

  const double max_aside = options.split_tolerance + 0.5;
  for (const Eigen::Vector2d& end : {shorter.p, shorter.q}) {
    const double along = d.dot(end - m), aside = std::fabs(n.dot(end - m));
    if (aside > max_aside) return false;
    const double sigma =
        std::sqrt(longer.sigma_offset * longer.sigma_offset + std::pow(longer.sigma_angle * along, 2) +
                  shorter.sigma_offset * shorter.sigma_offset +
                  std::pow(0.5 * shorter.length * shorter.sigma_angle, 2));
    if (aside > 3 * sigma + 0.3) return false;
  }
  return true;
}

CollinearPairs::Line CollinearPairs::lineOf(const LineSegment& s, const Eigen::Vector2d& reference) {
  Eigen::Vector2d d = s.direction();
  if (d.y() < 0 || (d.y() == 0 && d.x() < 0)) d = -d;
  const Eigen::Vector2d m = 0.5 * (s.p + s.q) - reference;
  return {std::atan2(d.y(), d.x()), d.x() * m.y() - d.y() * m.x(), d.dot(m)};
}

// The offset is taken about the middle of all segments; a far segment's offset moves with its angle error,
// which is why the cells are as wide as they are.
void CollinearPairs::assign(const std::vector<LineSegment>& segments) {
  Eigen::Vector2d reference = Eigen::Vector2d::Zero();
  for (const LineSegment& s : segments) reference += 0.5 * (s.p + s.q);
  if (!segments.empty()) reference /= double(segments.size());
  stretches_.clear();
  lines_.clear();
  entries_.clear();
  for (const LineSegment& s : segments) {
    const Line line = lineOf(s, reference);
    entries_.push_back(
        {cellOf(angleCell(line.angle), offsetCell(line.offset)), line.along, int(lines_.size())});
    stretches_.emplace_back(s);
    lines_.push_back(line);
  }
  std::sort(entries_.begin(), entries_.end());
}

const std::vector<CollinearPairs::Pair>& CollinearPairs::find(const std::vector<LineSegment>& segments) {
  assign(segments);
  pairs_.clear();
  for (Place& place : places_) place = entries_.cbegin();
  for (const Entry& entry : entries_) lookAround(entry.segment);
  std::sort(pairs_.begin(), pairs_.end(), [](const Pair& x, const Pair& y) {
    return x.gap != y.gap ? x.gap < y.gap : x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  return pairs_;
}

// The first entry of a cell or of those behind it. From entry to entry the cells of one angle only grow, and
// the next place is near; where the direction flips they do not.
CollinearPairs::Place CollinearPairs::firstOf(int64_t cell, bool flipped, Place* place) const {
  if (flipped) return std::lower_bound(entries_.cbegin(), entries_.cend(), Entry{cell, -kFar, -1});
  while (*place != entries_.cend() && (*place)->cell < cell) ++*place;
  return *place;
}

// Segments whose lines fall into the same or neighbouring cells of (angle, offset).
void CollinearPairs::lookAround(int i) {
  const Line& l = lines_[i];
  for (int da = -1; da <= 1; ++da) {
    const int a = angleCell(l.angle) + da;
    const bool flipped = a < 0 || a >= kAngleCells;  // past 0 or pi the direction and the offset change sign
    const double sign = flipped ? -1 : 1;
    const int64_t middle = cellOf((a + kAngleCells) % kAngleCells, offsetCell(sign * l.offset));
    // Cells that differ by one in the offset lie one after the other.
    Place from = firstOf(middle - 1, flipped, &places_[da + 1]);
    while (from != entries_.cend() && from->cell <= middle + 1) {
      Place to = from;
      while (to != entries_.cend() && to->cell == from->cell) ++to;
      look(i, sign * l.along, from, to);
      from = to;
    }
  }
}

// Looks at the entries of a cell before and after a place in it.
void CollinearPairs::look(int i, double along, Place begin, Place end) {
  const Place here = std::lower_bound(begin, end, Entry{begin->cell, along, i});
  const Place first = here - std::min<std::ptrdiff_t>(kNeighbours, here - begin);
  const Place last = here + std::min<std::ptrdiff_t>(kNeighbours, end - here);
  int others[2 * kNeighbours], count = 0;
  for (Place it = first; it != last; ++it) {
    others[count] = it->segment;
    count += int(i < it->segment);  // each pair is met from both sides; keep one
  }
  for (int k = 0; k < count; ++k) {
    double gap;
    if (collinear(stretches_[i], stretches_[others[k]], options_, &gap))
      pairs_.push_back({i, others[k], gap});
  }
}

}  // namespace monocular_eye_hand
