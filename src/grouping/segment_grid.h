#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {

/// Finds segments and segment ends near a pixel without looking at all of them.
class SegmentGrid {
 public:
  SegmentGrid(const FeatureSet& features, double cell);

  /// Ends (2 * segment + 0 / 1) within `radius` of `uv`, ascending.
  void endsNear(const Eigen::Vector2d& uv, double radius, std::vector<int>* ends) const;
  /// Segments that may come within `radius` of `uv` (a superset), ascending.
  void segmentsNear(const Eigen::Vector2d& uv, double radius, std::vector<int>* segments) const;
  /// Ends of plain segments per square pixel around `uv`, without `own` of them.
  double endDensity(const Eigen::Vector2d& uv, double own) const;

 private:
  struct Box {
    int x0, x1, y0, y1;
  };
  Box box(const Eigen::Vector2d& uv, double radius) const;
  int cellOf(const Eigen::Vector2d& uv) const;

  const FeatureSet& features_;
  double cell_;
  int columns_, rows_;
  std::vector<std::vector<int>> ends_, segments_;
};

}  // namespace monocular_eye_hand
