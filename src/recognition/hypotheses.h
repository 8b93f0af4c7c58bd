#pragma once
#include <utility>
#include <vector>

#include "recognition/best_of_places.h"
#include "recognition/pair_poses.h"
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

  /// More evidence; all that differ are ordered.
  bool betterThan(const Hypothesis& other) const;
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

  /// A pool for the same object that keeps nothing yet.
  HypothesisPool emptied() const { return {task_, object_}; }
  /// Takes up the hypotheses of another pool for the same object.
  void add(HypothesisPool&& other) { best_.add(std::move(other.best_)); }

 private:
  SearchTask task_;
  int object_;
  const Camera& camera_;
  const SearchModel& model_;
  const RecognitionOptions& options_;
  DistanceRange range_;
  BestOfPlaces<Hypothesis> best_;
};

/// Distances of a model's centre at which it is looked for: those of the options, and where its image is
/// neither too small nor larger than the task wants it.
DistanceRange searchedDistances(const SearchTask& task, const ObjectModel& model);

/// Wong et al., 2.2, step 2: every image grouping with every model grouping of its kind, in every order that
/// the kind admits, the most telling first: likely structure of one object that fits the model in few ways.
/// Poses by the perspective tetrahedron, corner triplets of lines and circles (pair_poses.h).
void hypothesesFromGroupings(const SearchTask& task, int object, HypothesisPool* pool, WorkBudget* budget);

/// The usable segments (flags) that may be edges of a part, the most telling first, at most so many: long
/// ones among few of their direction.
std::vector<int> mostTellingSegments(const SearchImage& image, const std::vector<char>& usable,
                                     size_t max_count);

/// One whole edge with the view sphere: every one of these segments as every edge of every sampled view.
void hypothesesFromEdges(const SearchTask& task, int object, const std::vector<int>& segments,
                         HypothesisPool* pool, WorkBudget* budget);

}  // namespace monocular_eye_hand
