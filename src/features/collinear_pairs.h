#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <tuple>
#include <vector>

#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {

/// What collinear() asks of a segment, computed once.
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

/// Two segments on one line: no overlap, a gap [px] within the ratio, ends of each within the uncertainty of
/// the other.
bool collinear(const Stretch& a, const Stretch& b, const FeatureOptions& options, double* gap);

/// Finds pairs of segments on one line, near each other along it.
class CollinearPairs {
 public:
  struct Pair {
    int a, b;    // a < b
    double gap;  // px
  };
  explicit CollinearPairs(const FeatureOptions& options) : options_(options) {}
  /// Shortest gap first; valid until the next call.
  const std::vector<Pair>& find(const std::vector<LineSegment>& segments);

 private:
  struct Line {
    double angle, offset;  // direction in [0, pi), signed distance from the reference point
    double along;          // middle along the direction
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
  using Place = std::vector<Entry>::const_iterator;

  static Line lineOf(const LineSegment& s, const Eigen::Vector2d& reference);
  void assign(const std::vector<LineSegment>& segments);
  void lookAround(int i);
  void look(int i, double along, Place begin, Place end);
  Place firstOf(int64_t cell, bool flipped, Place* place) const;

  const FeatureOptions options_;
  std::vector<Stretch> stretches_;  // per segment
  std::vector<Line> lines_;         // per segment
  std::vector<Entry> entries_;      // sorted
  Place places_[3];                 // where the search for an angle of -1, 0, 1 cells has come to
  std::vector<Pair> pairs_;
};

}  // namespace monocular_eye_hand
