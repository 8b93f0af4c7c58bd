#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "monocular_eye_hand/features/features.h"
#include "monocular_eye_hand/geometry/vector_clones.h"
#include "recognition/rect_domain.h"

namespace monocular_eye_hand {

/// Number of orientation bins over [0, pi). An edge point counts for the two bins nearest its direction.
constexpr int kOrientationBins = 12;

/// Bin nearest to the direction of (du, dv); directions pi apart are the same.
MONOCULAR_EYE_HAND_INLINE int orientationBin(float du, float dv) {
  // atan by a cubic on [-1, 1], good to 0.3 degrees, then rounded to 15 degree bins. Without branches, for
  // vector instructions.
  const float ax = std::fabs(du), ay = std::fabs(dv);
  const bool steep = ay > ax;
  const float larger = steep ? ay : ax;
  const float smaller = steep ? ax : ay;
  const float t = smaller / (larger + 1e-20f);
  const float low = t * (0.9724f - 0.1919f * t * t);             // 0 .. pi/4
  const float quarter = steep ? 1.5707963f - low : low;          // 0 .. pi/2
  const float a = du * dv < 0 ? 3.1415926f - quarter : quarter;  // 0 .. pi
  // a >= 0: truncation rounds it; std::lround would cost a call
  const int bin = int(a * (kOrientationBins / 3.1415926f) + 0.5f);  // NOLINT(bugprone-incorrect-roundings)
  return bin >= kOrientationBins ? bin - kOrientationBins : bin;
}

/// Fixed-point log-likelihood ratio: units per nat.
constexpr float kEvidenceUnit = 16.0f;
/// Value of map pixels outside the image.
constexpr int8_t kOutside = -128;

/// Evidence in units (kEvidenceUnit per nat), a plane for every orientation. It lies in tiles: what poses
/// near each other ask for is near in memory, too.
class EvidencePlanes {
 public:
  static constexpr int kTile = 8;  ///< side of a tile, which fills a line of the cache [px]

  EvidencePlanes() = default;  ///< of no image: kOutside everywhere
  EvidencePlanes(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Where `value` finds the evidence of a pixel; -1 beyond the image.
  int index(int bin, int x, int y) const {
    if (unsigned(x) >= unsigned(width_) || unsigned(y) >= unsigned(height_)) return -1;
    return placeOf(unsigned(bin), unsigned(x), unsigned(y));
  }
  /// The same of a place in the plane [px], 0 at the outer border of the first pixel.
  MONOCULAR_EYE_HAND_INLINE int indexNear(int bin, float x, float y) const {
    const bool inside = x >= 0 && y >= 0 && x < float(width_) && y < float(height_);
    const int place = placeOf(unsigned(bin), unsigned(int(inside ? x : 0)), unsigned(int(inside ? y : 0)));
    return inside ? place : -1;
  }
  int8_t value(int index) const { return values_[size_t(index)]; }
  /// Of the pixel (x, y) and those to its right in its tile, one after the other; x: a multiple of kTile.
  /// What of a tile lies beyond the image is kOutside.
  int8_t* run(int bin, int x, int y) {
    return &values_[size_t(placeOf(unsigned(bin), unsigned(x), unsigned(y)))];
  }
  const int8_t* run(int bin, int x, int y) const {
    return &values_[size_t(placeOf(unsigned(bin), unsigned(x), unsigned(y)))];
  }
  /// The evidence of a pixel; kOutside beyond the image.
  int8_t at(int bin, int x, int y) const {
    const int place = index(bin, x, y);
    return place < 0 ? kOutside : value(place);
  }

 private:
  // Of a pixel in the plane.
  MONOCULAR_EYE_HAND_INLINE int placeOf(unsigned bin, unsigned x, unsigned y) const {
    constexpr unsigned kSide = kTile;
    const unsigned tile = (bin * tiles_y_ + y / kSide) * tiles_x_ + x / kSide;
    return int((tile * kSide + y % kSide) * kSide + x % kSide);
  }

  int width_ = 0, height_ = 0;
  unsigned tiles_x_ = 0, tiles_y_ = 0;
  std::vector<int8_t> values_;
};

/// What a contour sample at a pixel with a direction says for (> 0) or against (< 0) an object there:
/// log p(distance to the nearest edge of that direction | object) / p(... | background here), the background
/// measured in a window around the pixel. One look-up per sample.
class EvidenceMap {
 public:
  EvidenceMap() = default;  ///< of no image: kOutside everywhere
  EvidenceMap(const FeatureSet& features, const RectDomain& domain);

  /// The map pixel (0, 0) in the rectified image [px].
  int u0() const { return u0_; }
  int v0() const { return v0_; }
  /// kOutside where the lens shows nothing.
  const EvidencePlanes& full() const { return full_; }
  /// What an edge of this direction says at the pixel nearest to a point of the rectified image; kOutside
  /// beyond it.
  int8_t at(const Eigen::Vector2d& uv, const Eigen::Vector2d& direction) const {
    const int bin = orientationBin(float(direction.x()), float(direction.y()));
    return full_.at(bin, int(std::lround(uv.x())) - u0_, int(std::lround(uv.y())) - v0_);
  }
  const EvidencePlanes& half() const { return half_; }  ///< every second pixel of every second row

 private:
  int u0_ = 0, v0_ = 0;
  EvidencePlanes full_, half_;
};

}  // namespace monocular_eye_hand
