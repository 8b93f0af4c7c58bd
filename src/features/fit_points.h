#pragma once
#include <array>
#include <vector>

#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {

/// A contiguous run points[first .. first + count).
struct PointRange {
  int first = 0, count = 0;
};

/// At most kCapacity edge points as the ellipse fits read them, coordinate by coordinate and without
/// allocation. The arrays are padded to a multiple of kLanes by copies of weight 0.
class FitPoints {
 public:
  static constexpr int kCapacity = 320, kLanes = 4;

  /// Takes at most about `max_points` of the points, evenly chosen over the ranges.
  void assign(const std::vector<EdgePoint>& points, const PointRange* ranges, size_t range_count,
              int max_points);
  void assign(const std::vector<EdgePoint>& points, const std::vector<PointRange>& ranges, int max_points) {
    assign(points, ranges.data(), ranges.size(), max_points);
  }

  int count() const { return count_; }
  int padded() const { return (count_ + kLanes - 1) / kLanes * kLanes; }
  const double* x() const { return x_.data(); }            ///< [px]
  const double* y() const { return y_.data(); }            ///< [px]
  const double* weight() const { return weight_.data(); }  ///< inverse variance along the normal [px^-2]
  const double* blur2() const { return blur2_.data(); }  ///< squared standard deviation of the profile [px^2]

 private:
  using Column = std::array<double, kCapacity>;
  int count_ = 0;
  alignas(32) Column x_, y_, weight_, blur2_;
};

}  // namespace monocular_eye_hand
