#pragma once
#include <memory>
#include <vector>

#include "features/edge_detection.h"

namespace monocular_eye_hand {

/// Traces of linked edge points; `points` lie trace after trace, ordered so that the bright side is on the
/// (d.y, -d.x) side of the walking direction d.
struct LinkedEdges {
  std::vector<EdgePoint> points;
  std::vector<EdgeTrace> traces;
};

/// Links every edge point to the neighbour ahead and behind that continues it best (distance plus departure
/// from both tangents). Traces that noise could make are dropped: with Rayleigh-distributed noise magnitudes,
/// the expected number of traces as strong and long as this one in a noise image of this size must be below
/// one (Desolneux, Moisan, Morel 2001).
class EdgeLinker {
 public:
  explicit EdgeLinker(const FeatureOptions& options);
  ~EdgeLinker();
  void link(const EdgeMap& edges, LinkedEdges* out);

 private:
  class Linking;
  std::unique_ptr<Linking> linking_;
};

}  // namespace monocular_eye_hand
