#pragma once
#include <Eigen/Core>
#include <vector>

#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {

/// What happens at the end of a segment. Ends are numbered 2 * segment (its p) and 2 * segment + 1 (its q).
enum class EndState {
  kFree,       ///< nothing near: the end may be true, or the contrast was lost
  kCorner,     ///< meets other segments' ends
  kBorder,     ///< the image border cuts it off
  kContinued,  ///< another segment of the same line goes on
  kStem        ///< it runs into the side of another segment (T): usually hidden by what that one bounds
};

/// Two segment ends that meet. `p` is the lines' intersection.
struct Corner {
  int end_a = 0, end_b = 0;  ///< end_a < end_b
  Eigen::Vector2d p;         ///< uv_rect
  double sigma = 0;          ///< standard deviation of p, mean over directions [px]
  double weight = 0;         ///< probability that it is structure, see weights in docs/pipeline.md
};

/// The corners of an image and the state of every segment end.
struct EndMap {
  std::vector<Corner> corners;                   ///< ascending (end_a, end_b)
  std::vector<std::vector<int>> corners_of_end;  ///< per end: indices into corners, best first
  std::vector<EndState> state;                   ///< per end
  std::vector<std::vector<int>> continued_by;    ///< per end: ends of the same line that face it, ascending
};

inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

inline Eigen::Vector2d endPoint(const FeatureSet& f, int end) {
  return end % 2 ? f.segments[end / 2].q : f.segments[end / 2].p;
}
/// Unit vector along the segment, pointing out of it at this end.
inline Eigen::Vector2d outward(const FeatureSet& f, int end) {
  return (endPoint(f, end) - endPoint(f, end ^ 1)).normalized();
}

}  // namespace monocular_eye_hand
