#pragma once
#include <vector>

#include "recognition/search_task.h"
#include "recognition/work_budget.h"

namespace monocular_eye_hand {

/// Where a hypothesis came from (Wong et al., 2.2, step 2: a matching pair of an image grouping and a model
/// feature).
struct Hypothesis {
  Rigid3 camera_from_object;  ///< canonical
  int view = 0;               ///< nearest sampled view
  float evidence = 0;         ///< coarse plausibility, see scorePose
  float in_frame = 0;
  GroupingKind kind = GroupingKind::kEdge;  ///< of the pair it came from
};

/// Keeps the best hypotheses of one object, spread over the image: a strong place cannot crowd out the
/// others.
class HypothesisPool {
 public:
  /// Refers to what the task refers to. `object`: the model whose hypotheses it keeps.
  HypothesisPool(const SearchTask& task, int object);
  /// Scores a pose and keeps it when it is admissible (distance, size, share in the frame) and good for its
  /// place.
  void offer(const Rigid3& camera_from_object, GroupingKind kind, const EvidenceMap& map, WorkBudget* budget);
  /// Takes out the best hypotheses, best first, near-duplicates dropped. What was not taken stays for the
  /// next round.
  std::vector<Hypothesis> take(int count);

 private:
  SearchTask task_;
  int object_;
  const Camera& camera_;
  const SearchModel& model_;
  const RecognitionOptions& options_;
  int cells_x_, cells_y_;
  std::vector<std::vector<Hypothesis>> cells_;
};

/// Wong et al., 2.2, step 2: every image grouping with every model grouping of its kind, in every order that
/// the kind admits, the most telling first: likely structure of one object that fits the model in few ways.
/// Poses by the perspective tetrahedron, corner triplets of lines and circles (pair_poses.h).
void hypothesesFromGroupings(const SearchImage& image, int object, const SearchModel& model,
                             HypothesisPool* pool, WorkBudget* budget);

/// One whole edge with the view sphere: every segment, long ones first, as every edge of every sampled view.
/// `usable`: flags of the segments that may serve (not explained yet).
void hypothesesFromEdges(const SearchImage& image, const SearchModel& model,
                         const RecognitionOptions& options, const std::vector<char>& usable,
                         HypothesisPool* pool, WorkBudget* budget);

}  // namespace monocular_eye_hand
