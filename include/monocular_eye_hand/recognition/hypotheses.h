#pragma once
#include <vector>

#include "monocular_eye_hand/recognition/evidence.h"
#include "monocular_eye_hand/recognition/options.h"
#include "monocular_eye_hand/recognition/search_model.h"

namespace monocular_eye_hand {

/// Where a hypothesis came from (seed, step 2: a matching pair of an image grouping and a model feature).
struct Hypothesis {
  Rigid3 camera_from_object;  ///< canonical
  int view = 0;               ///< nearest sampled view
  float evidence = 0;         ///< coarse plausibility, see scorePose
  float in_frame = 0;
  GroupingKind kind = GroupingKind::kEdge;  ///< of the pair it came from
};

/// Everything the search of one image looks at.
struct SearchContext {
  const Camera& camera;
  const FeatureSet& features;
  const std::vector<Grouping>& groupings;
  const EvidenceMap& map;
  const RecognitionOptions& options;
};

/// Work done so far, in hypotheses scored; the search ends when it exceeds the limit.
struct WorkBudget {
  long long scored = 0;
  long long limit = 0;  ///< 0: none
  bool spent() const { return limit > 0 && scored >= limit; }
};

/// Keeps the best hypotheses of one object, spread over the image: a strong place cannot crowd out the
/// others.
class HypothesisPool {
 public:
  HypothesisPool(const Camera& camera, const SearchModel& model, const RecognitionOptions& options);
  /// Scores a pose and keeps it when it is admissible (distance, size, share in the frame) and good for its
  /// place.
  void offer(const Rigid3& camera_from_object, GroupingKind kind, const EvidenceMap& map, WorkBudget* budget);
  /// Takes out the best hypotheses, best first, near-duplicates dropped. What was not taken stays for the
  /// next round.
  std::vector<Hypothesis> take(int count);

 private:
  const Camera& camera_;
  const SearchModel& model_;
  const RecognitionOptions& options_;
  int cells_x_, cells_y_;
  std::vector<std::vector<Hypothesis>> cells_;
};

/// Seed, step 2 for point groupings: every image grouping (L, triplet, chain, quad) with every model grouping
/// of its kind, the pose by the perspective tetrahedron, further points choose among its roots.
void hypothesesFromPoints(const SearchContext& context, int object, const SearchModel& model,
                          HypothesisPool* pool, WorkBudget* budget);

/// Ellipses with model circles: the circle pose's two solutions, the roll from the contour.
void hypothesesFromEllipses(const SearchContext& context, int object, const SearchModel& model,
                            HypothesisPool* pool, WorkBudget* budget);

/// One whole edge with the view sphere: every segment as every edge of every sampled view. `usable`: flags of
/// the segments that may serve (not explained yet).
void hypothesesFromEdges(const SearchContext& context, const SearchModel& model,
                         const std::vector<char>& usable, HypothesisPool* pool, WorkBudget* budget);

}  // namespace monocular_eye_hand
