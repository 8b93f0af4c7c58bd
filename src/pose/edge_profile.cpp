#include "monocular_eye_hand/pose/edge_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "monocular_eye_hand/geometry/median.h"

namespace monocular_eye_hand {
namespace {

// Measured on 8700 edges of 700 rendered poses of five parts: of clean edges two thirds lie within the first,
// of others within so many times what their blur departs from the clean one, or what their direction turns.
constexpr double kMinOffset = 0.02;  // px
constexpr double kOffsetPerBlur = 2.2;
constexpr double kOffsetPerRadian = 2.3;           // px per radian
constexpr double kUsualAngle = 1.5 * M_PI / 180;   // scatter of single points' directions
constexpr double kShare = 0.25, kMinWidth = 0.02;  // of the appearances in the interval, and its width [px]

}  // namespace

EdgeProfiles::EdgeProfiles(const std::vector<EdgeAppearance>& appearances) {
  std::vector<double> blurs;
  blurs.reserve(appearances.size());
  for (const EdgeAppearance& point : appearances) blurs.push_back(point.blur);
  std::sort(blurs.begin(), blurs.end());
  if (blurs.empty()) return;
  const size_t inside = std::min(blurs.size(), std::max<size_t>(2, size_t(kShare * double(blurs.size()))));
  size_t best = 0;
  for (size_t i = 0; i + inside <= blurs.size(); ++i)
    if (blurs[i + inside - 1] - blurs[i] < blurs[best + inside - 1] - blurs[best]) best = i;
  clean_blur_ = 0.5 * (blurs[best] + blurs[best + inside - 1]);
  half_width_ = 0.5 * std::max(kMinWidth, blurs[best + inside - 1] - blurs[best]);
}

double EdgeProfiles::expectedOffset(const std::vector<EdgeAppearance>& edge) const {
  std::vector<double> blurs, angles;
  for (const EdgeAppearance& point : edge) {
    blurs.push_back(point.blur);
    angles.push_back(std::abs(point.angle));
  }
  if (edge.empty()) return kMinOffset;
  const double departure = std::max(0.0, std::abs(median(&blurs) - clean_blur_) - half_width_);
  const double angle = std::max(0.0, median(&angles) - kUsualAngle);
  return std::hypot(kMinOffset, kOffsetPerBlur * departure, kOffsetPerRadian * angle);
}

}  // namespace monocular_eye_hand
