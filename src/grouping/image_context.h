#pragma once
#include <algorithm>
#include <vector>

#include "grouping/segment_grid.h"
#include "grouping/weights.h"
#include "monocular_eye_hand/features/features.h"
#include "monocular_eye_hand/grouping/grouping.h"

namespace monocular_eye_hand {

/// What every search for image groupings needs.
struct ImageContext {
  ImageContext(const FeatureSet& f, const GroupingOptions& o);

  /// Do two segments share edge points (a joined segment and its pieces)? Such are one line, never a
  /// grouping.
  bool related(int a, int b) const {
    if (a == b) return true;
    const std::vector<int>&pa = pieces[a], &pb = pieces[b];
    for (size_t i = 0, j = 0; i < pa.size() && j < pb.size();) {
      if (pa[i] == pb[j]) return true;
      pa[i] < pb[j] ? ++i : ++j;
    }
    return false;
  }
  /// Is this end of a piece bridged by a joined segment?
  bool insideJoined(int end) const { return bridged[end]; }

  const FeatureSet& features;
  const GroupingOptions& options;
  SegmentGrid grid;
  std::vector<std::vector<int>> pieces;  ///< per segment, ascending: itself when plain
  std::vector<char> bridged;             ///< per end
  std::vector<double> segment_weight;    ///< per segment: probability that it is an edge of something
};

}  // namespace monocular_eye_hand
