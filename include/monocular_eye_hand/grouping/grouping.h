#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "monocular_eye_hand/features/features.h"
#include "monocular_eye_hand/model/model_base.h"

namespace monocular_eye_hand {

/// Kinds of feature groupings (seed 2.1). The points of an image grouping and of a model grouping of the same kind
/// correspond in order, up to the permutations that the kind allows (listed here).
enum class GroupingKind {
  kEdge,          ///< one whole segment: points = its two ends (reversible)
  kJunction,      ///< L: two segments meeting: points = far end, corner, far end (reversible)
  kTriplet,       ///< three segments meeting (arrow, Y, T): points = corner, three far ends in angular order (cyclic)
  kChain,         ///< two corners sharing a segment: points = far end, corner, corner, far end (reversible)
  kQuad,          ///< four-corner face (one side may be missing): points = the corners in order (cyclic, reversible)
  kParallelPair,  ///< two parallel segments side by side: points = ends of the one, ends of the other
  kEllipse,       ///< one ellipse
  kEllipsePair,   ///< two ellipses with a common axis
  kEllipseLine    ///< an ellipse and a segment near it: points = the segment's ends
};
const char* name(GroupingKind kind);

/// A group of image features that is likely one part of one object.
struct Grouping {
  GroupingKind kind = GroupingKind::kEdge;
  std::vector<int> segments;            ///< FeatureSet::segments, in the order of the points
  std::vector<int> ellipses;            ///< FeatureSet::ellipses
  std::vector<Eigen::Vector2d> points;  ///< uv_rect, see GroupingKind
  std::vector<double> sigma;            ///< standard deviation of each point [px]; large for an end that is cut off
  double weight = 0;                    ///< probability that this is structure of one object, not an accident
  std::vector<int> candidates;          ///< ModelBase::objects it can come from (seed, eq. 1: F_i => {obj_j})
};

/// The same of a model: points in the object frame.
struct ModelGrouping {
  GroupingKind kind = GroupingKind::kEdge;
  std::vector<int> edges;    ///< ObjectModel::edges in the order of the points
  std::vector<int> circles;  ///< ObjectModel::circles
  std::vector<Eigen::Vector3d> points;
  double weight = 0;         ///< share of the view sphere from which it is visible as a whole
  std::vector<int> views;    ///< SampledViews (nearest distance) that see it as a whole
};

struct GroupingOptions {
  double corner_gap = 8.0;        ///< largest distance between a corner and the segment ends that make it [px]
  double corner_gap_ratio = 0.25; ///< ... or this share of the shorter segment, whichever is smaller, at least 3 px
  double min_corner_angle = 0.20; ///< smallest angle between the lines of a junction [rad]
  double parallel_angle = 0.12;   ///< largest angle between parallel segments [rad]
  int max_per_kind = 4000;        ///< best by weight
  void check() const;
};

/// Groups the features. The union of all groupings covers every segment and ellipse (seed, eq. 1).
std::vector<Grouping> groupFeatures(const FeatureSet& features, const ModelBase& models,
                                    const GroupingOptions& options = {});

/// The groupings of one model.
std::vector<ModelGrouping> modelGroupings(const KnownObject& object);

}  // namespace monocular_eye_hand
