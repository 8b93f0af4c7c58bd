#include <algorithm>

#include "grouping/candidates.h"
#include "grouping/line_groupings.h"
#include "grouping/pair_groupings.h"
#include "grouping/segment_ends.h"

namespace monocular_eye_hand {
namespace {

// Density of a single segment's surroundings is taken at its middle.
std::vector<double> segmentWeights(const FeatureSet& f, const SegmentGrid& grid) {
  std::vector<double> weights;
  for (const LineSegment& s : f.segments)
    weights.push_back(segmentWeight(s, grid.endDensity(0.5 * (s.p + s.q), 2.0)));
  return weights;
}

std::vector<std::vector<int>> piecesOf(const FeatureSet& f) {
  std::vector<std::vector<int>> pieces;
  for (int s = 0; s < int(f.segments.size()); ++s) {
    const IndexRange joined = f.piecesOf(f.segments[s]);
    pieces.emplace_back(joined.begin(), joined.end());
    if (joined.empty()) pieces.back().push_back(s);
    std::sort(pieces.back().begin(), pieces.back().end());
  }
  return pieces;
}

/// Marks the ends of pieces that a joined segment bridges: all but those at which the joined segment ends.
std::vector<char> bridgedEnds(const FeatureSet& f) {
  std::vector<char> bridged(2 * f.segments.size(), 0);
  for (int s = 0; s < int(f.segments.size()); ++s) {
    const LineSegment& joined = f.segments[s];
    if (!joined.joined()) continue;
    const Eigen::Vector2d d = joined.direction();
    const double last = joined.length();
    for (int piece : f.piecesOf(joined))
      for (int end : {2 * piece, 2 * piece + 1}) {
        const double at = d.dot(endPoint(f, end) - joined.p);
        if (at > 2.0 && at < last - 2.0) bridged[end] = 1;
      }
  }
  return bridged;
}

void add(std::vector<Grouping>&& groupings, int limit, std::vector<Grouping>* all) {
  keepBest(&groupings, limit);
  for (Grouping& g : groupings) all->push_back(std::move(g));
}

}  // namespace

ImageContext::ImageContext(const FeatureSet& f, const GroupingOptions& o)
    : features(f),
      options(o),
      grid(f, std::max(8.0, 2.0 * o.corner_gap)),
      pieces(piecesOf(f)),
      bridged(bridgedEnds(f)),
      segment_weight(segmentWeights(f, grid)) {}

std::vector<Grouping> groupFeatures(const FeatureSet& features, const ModelBase& models,
                                    const GroupingOptions& options) {
  options.check();
  const ImageContext context(features, options);
  const EndMap ends = mapEnds(context);
  const std::vector<Grouping> edges = edgeGroupings(context, ends);
  const std::vector<Grouping> chains = chainGroupings(context, ends);
  std::vector<Grouping> quads = closedQuadGroupings(context, ends);
  for (Grouping& open : openQuadGroupings(chains)) quads.push_back(std::move(open));

  const int limit = options.max_per_kind, unlimited = int(edges.size() + features.ellipses.size());
  std::vector<Grouping> all;
  add(std::vector<Grouping>(edges), unlimited, &all);  // the cover (Wong et al., eq. 1)
  add(junctionGroupings(context, ends), limit, &all);
  add(tripletGroupings(context, ends), limit, &all);
  add(std::vector<Grouping>(chains), limit, &all);
  add(std::move(quads), limit, &all);
  add(parallelGroupings(context, edges), limit, &all);
  add(ellipseGroupings(context), unlimited, &all);
  add(ellipsePairGroupings(context), limit, &all);
  add(ellipseLineGroupings(context, edges), limit, &all);

  const CandidateTable table(models);
  for (Grouping& g : all) g.candidates = table.candidates(g);
  return all;
}

}  // namespace monocular_eye_hand
