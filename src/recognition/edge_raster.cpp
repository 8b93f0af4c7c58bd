#include "recognition/edge_raster.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "monocular_eye_hand/geometry/vector_clones.h"

namespace monocular_eye_hand {
namespace {

// A walk across a contour, pixel by pixel, from `steps` before (x, y) to `steps` behind it.
struct Walk {
  static constexpr int kStretch = 8;  // steps whose places are worked out together
  float x, y;                         // in the raster [px], 0 at the outer border of the first pixel
  float nx, ny;                       // unit
  int steps;
};

// Where the steps first, first + 1, ... of a walk find their pixels in a raster of rows; -1 beyond it.
MONOCULAR_EYE_HAND_VECTOR_CLONES
void placesOn(const Walk& walk, int first, int width, int height, std::array<int, Walk::kStretch>* places) {
  for (int i = 0; i < Walk::kStretch; ++i) {
    const float x = walk.x + walk.nx * float(first + i);
    const float y = walk.y + walk.ny * float(first + i);
    const bool inside = x >= 0 && y >= 0 && x < float(width) && y < float(height);
    const int place = int(inside ? y : 0) * width + int(inside ? x : 0);
    (*places)[size_t(i)] = inside ? place : -1;
  }
}

}  // namespace

EdgeRaster::EdgeRaster(const FeatureSet& features, const RectDomain& domain)
    : points_(features.points.data()),
      u0_(domain.u0),
      v0_(domain.v0),
      width_(domain.width),
      height_(domain.height),
      index_(size_t(domain.width) * domain.height, -1) {
  const auto put = [&](int x, int y, int index, bool own) {
    if (unsigned(x) >= unsigned(width_) || unsigned(y) >= unsigned(height_)) return;
    int32_t& cell = index_[size_t(y) * width_ + x];
    if (cell < 0 || own) cell = index;
  };
  const auto& points = features.points;
  salience_.reserve(points.size());
  for (const EdgePoint& p : points) salience_.push_back(std::sqrt(p.gradient));

  for (int pass = 0; pass < 2; ++pass)  // thickening first, so that a point's own pixel wins
    for (size_t i = 0; i < points.size(); ++i) {
      const int x = int(std::lround(points[i].uv.x())) - u0_, y = int(std::lround(points[i].uv.y())) - v0_;
      if (pass == 0) {
        put(x + 1, y, int(i), false);
        put(x, y + 1, int(i), false);
      } else {
        put(x, y, int(i), true);
      }
    }
}

int EdgeRaster::find(const Eigen::Vector2d& uv, const Eigen::Vector2d& normal, double range) const {
  const float nx = float(normal.x()), ny = float(normal.y());
  const float u = float(uv.x()), v = float(uv.y());
  const float inverse_range = 1.0f / float(range + 1.0);
  const Walk walk{u - float(u0_) + 0.5f, v - float(v0_) + 0.5f, nx, ny, int(std::lround(range))};
  int best = -1, last = -1;
  float best_score = 0;
  const auto look = [&](int place) {
    const int index = index_[size_t(place)];
    if (index < 0 || index == last) return;
    last = index;

    const EdgePoint& p = points_[index];
    const float along = std::fabs(p.normal.x() * nx + p.normal.y() * ny);
    if (along < 0.906f) return;
    const float d = ((p.uv.x() - u) * nx + (p.uv.y() - v) * ny) * inverse_range;
    const float score = salience_[size_t(index)] * along * (1.05f - d * d);
    if (score <= best_score) return;
    best_score = score;
    best = index;
  };

  // All places of a stretch first, then what lies there: the memory answers many at a time.
  std::array<int, Walk::kStretch> places;
  for (int first = -walk.steps; first <= walk.steps; first += Walk::kStretch) {
    const int count = std::min(Walk::kStretch, walk.steps + 1 - first);
    placesOn(walk, first, width_, height_, &places);
    for (int i = 0; i < count; ++i)
      if (places[size_t(i)] >= 0) look(places[size_t(i)]);
  }
  return best;
}

}  // namespace monocular_eye_hand
