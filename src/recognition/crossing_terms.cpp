#include <algorithm>
#include <cmath>

#include "recognition/drawing_terms.h"

namespace monocular_eye_hand {
namespace {

constexpr double kInside = 5.0;       // where edges that cross the outline are looked for, inwards of it [px]
constexpr double kMinCrossing = 4.0;  // how far such an edge must get beyond the outline [px]
constexpr int kTracePoints = 18;      // edge points followed along its trace
constexpr double kMaxAlong = 0.85;    // largest |cos| between it and the outline
constexpr double kSide = 10.0;        // beyond the outline it may have moved this far along it [px]

}  // namespace

// Where the part lies over other things, their edges end at its outline: one that runs on inside says that
// nothing lies there.
void crossingTerms(const SearchImage& image, Candidate* candidate) {
  const std::vector<EdgePoint>& points = image.features.points;
  int outline = 0, crossed = 0;
  for (const SeenSample& s : candidate->contour) {
    if (!s.inside || !s.outline || s.inward == 0) continue;
    ++outline;

    const Eigen::Vector2d inward = s.inward * s.normal();
    for (double along : {-1.0, 1.0}) {
      const Eigen::Vector2d uv = s.uv + kInside * inward + along * s.direction;
      const int index = image.raster.indexAt(int(std::lround(uv.x())), int(std::lround(uv.y())));
      if (index < 0) continue;
      const EdgePoint& p = points[size_t(index)];
      const Eigen::Vector2d normal = p.normal.cast<double>();
      if (std::abs(normal.dot(inward)) > kMaxAlong) continue;  // runs along the outline

      const EdgeTrace& trace = image.features.traces[size_t(image.trace_of_point[size_t(index)])];
      const int first = std::max(trace.first, index - kTracePoints);
      const int last = std::min(trace.first + trace.count - 1, index + kTracePoints);

      bool through = false;
      for (int i : {first, last}) {
        const Eigen::Vector2d d = points[size_t(i)].uv.cast<double>() - s.uv;
        through = through || (d.dot(inward) < -kMinCrossing && std::abs(d.dot(s.direction)) < kSide);
      }
      if (!through) continue;
      ++crossed;
      break;
    }
  }
  candidate->terms.crossed = outline ? double(crossed) / outline : 0;
}

}  // namespace monocular_eye_hand
