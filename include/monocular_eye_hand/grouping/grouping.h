#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "monocular_eye_hand/features/features.h"
#include "monocular_eye_hand/model/known_object.h"

namespace monocular_eye_hand {

/// Kinds of feature groupings (Wong et al. 2.1). The points of an image grouping and of a model grouping of
/// the same kind correspond in order, up to the permutations that the kind allows (listed here; see
/// correspondences()).
enum class GroupingKind {
  kEdge,      ///< one whole segment: points = its two ends (reversible)
  kJunction,  ///< L: two segments meeting: points = far end, corner, far end (reversible)
  kTriplet,   ///< three segments meeting (arrow, Y, T): points = corner, three far ends in angular order
              ///< (cyclic)
  kChain,     ///< two corners sharing a segment: points = far end, corner, corner, far end (reversible)
  kQuad,  ///< four-corner face (one side may be missing): points = the corners in order (cyclic, reversible)
  kParallelPair,  ///< two parallel segments side by side: points = ends of the one, ends of the other
  kEllipse,       ///< one ellipse
  kEllipsePair,   ///< two ellipses with a common axis
  kEllipseLine    ///< an ellipse and a segment near it: points = the segment's ends
};
constexpr int kGroupingKinds = 9;
std::string toString(GroupingKind kind);

/// What a triplet, chain or quad looks like. "Angular order" everywhere is growing atan2(v, u): clockwise on
/// the screen, v points down.
enum class GroupingShape {
  kNone,
  kArrow,   ///< triplet: all three segments on one side of a line through the corner
  kY,       ///< triplet: no such line
  kT,       ///< triplet: two of the segments are in line; often one object in front of another
  kU,       ///< chain: both far ends on one side of the shared segment
  kZ,       ///< chain: far ends on different sides
  kClosed,  ///< quad: four segments, four corners; segments[i] joins points[i] and points[i + 1]
  kOpen     ///< quad: three segments; the side from points[3] to points[0] is missing
};
std::string toString(GroupingShape shape);

/// Ends with a standard deviation of this much or more [px] are cut off: by the image border, by something in
/// front, or because the line goes on. They say where the line is, not where it ends.
constexpr double kCutOffSigma = 20.0;

/// A group of image features that is likely one part of one object.
struct Grouping {
  GroupingKind kind = GroupingKind::kEdge;
  GroupingShape shape = GroupingShape::kNone;
  std::vector<int> segments;            ///< FeatureSet::segments, in the order of the points
  std::vector<int> ellipses;            ///< FeatureSet::ellipses
  std::vector<Eigen::Vector2d> points;  ///< uv_rect, see GroupingKind
  std::vector<double> sigma;            ///< standard deviation of each point, mean over directions [px]
  double weight = 0;                    ///< probability that this is structure of one object, not an accident
  std::vector<int> candidates;  ///< ModelBase::objects it can come from (Wong et al., eq. 1: F_i => {obj_j})
};

/// One way to lay an image grouping over a model grouping: image.points[i] is the image of
/// model.points[points[i]], image.segments[i] of model.edges[segments[i]], image.ellipses[i] of
/// model.circles[ellipses[i]]. Unused places are -1.
struct Correspondence {
  std::array<int, 4> points{-1, -1, -1, -1};
  std::array<int, 4> segments{-1, -1, -1, -1};
  std::array<int, 2> ellipses{-1, -1};
};

/// The grouping's copy symmetries.discrete[symmetry] * grouping is visible as a whole from
/// ViewSphere::views[view]. Equivalently the grouping itself is seen from the direction
/// symmetries.discrete[symmetry]^-1 * view direction.
struct SeenFrom {
  int view = 0;
  int symmetry = 0;
};

/// The same of a model: points in the object frame. Of groupings that the model's symmetries make equal only
/// one is kept. Because the view sphere, too, is stored modulo the symmetries, a pose built from one grouping
/// and one view must run over `seen`, not over `views` alone.
struct ModelGrouping {
  GroupingKind kind = GroupingKind::kEdge;
  GroupingShape shape =
      GroupingShape::kNone;  ///< chain in one plane: kU or kZ, in space: kNone; quad: kClosed
  std::vector<int> edges;    ///< ObjectModel::edges in the order of the points
  std::vector<int> circles;  ///< ObjectModel::circles
  std::vector<Eigen::Vector3d> points;
  bool oriented = false;  ///< the turning sense of its points is the same in every image that shows it
  std::vector<Correspondence> orders;  ///< admissible orders, without those that a symmetry makes equal
  double weight = 0;                   ///< share of the view sphere from which it is visible as a whole
  std::vector<int>
      views;  ///< SampledViews (nearest distance) that see it, or an equal copy, as a whole; ascending
  std::vector<SeenFrom> seen;  ///< the same, copy by copy
};

/// The orders in which an image grouping can be a view of a model grouping. Empty when the kinds differ or
/// the shapes exclude each other (a U in one plane is never seen as a Z). No true order is left out.
const std::vector<Correspondence>& correspondences(const Grouping& image, const ModelGrouping& model);

/// Defaults stand here and nowhere else.
struct GroupingOptions {
  double corner_gap = 8.0;  ///< largest distance between a corner and the segment ends that make it [px]
  double corner_gap_ratio =
      0.25;  ///< ... or this share of the shorter segment, whichever is smaller, at least 3 px
  double min_corner_angle = 0.20;  ///< smallest angle between the lines of a junction [rad]
  int max_corners_per_end = 8;     ///< corners kept per segment end, best by weight
  double parallel_angle = 0.12;    ///< largest angle between parallel segments [rad]
  double parallel_overlap = 0.5;   ///< smallest overlap of parallel segments, as a share of the shorter one
  double parallel_distance_ratio =
      1.0;                        ///< largest distance of parallel segments, as a share of the longer one
  int max_pairs_per_feature = 8;  ///< parallel pairs kept per segment, lines kept per ellipse
  double ellipse_axis_tolerance =
      0.25;                     ///< of a common axis: axis ratio, and offset as a share of the larger axis
  double ellipse_reach = 4.0;   ///< farthest partner of an ellipse in its semi-major axes
  double border_margin = 5.0;   ///< an end this near to the image border is cut off [px]
  double free_end_sigma = 2.0;  ///< standard deviation of an end at which no other segment ends [px]
  int max_per_kind = 4000;  ///< best by weight; single edges and ellipses are all kept: they make the cover

  void check() const;  ///< throws BadInput naming field, value and rule

  /// Calls v("field", field) for every field: readers fill options by name.
  template <class Visitor>
  void visit(Visitor&& v) {
    v("corner_gap", corner_gap);
    v("corner_gap_ratio", corner_gap_ratio);
    v("min_corner_angle", min_corner_angle);
    v("max_corners_per_end", max_corners_per_end);
    v("parallel_angle", parallel_angle);
    v("parallel_overlap", parallel_overlap);
    v("parallel_distance_ratio", parallel_distance_ratio);
    v("max_pairs_per_feature", max_pairs_per_feature);
    v("ellipse_axis_tolerance", ellipse_axis_tolerance);
    v("ellipse_reach", ellipse_reach);
    v("border_margin", border_margin);
    v("free_end_sigma", free_end_sigma);
    v("max_per_kind", max_per_kind);
  }
};

/// Groups the features. The union of all groupings covers every segment and ellipse (Wong et al., eq. 1).
/// Kinds follow each other in the order of GroupingKind, each best first. Throws BadInput when an option is
/// out of range.
std::vector<Grouping> groupFeatures(const FeatureSet& features, const ModelBase& models,
                                    const GroupingOptions& options = {});

/// The groupings of one model, in the order of GroupingKind, each kind by falling weight. Those that no
/// sampled view shows are left out; without sampled views (object.views empty) all have weight 0. Of each
/// kind the 500 most telling are kept: seen in many views, of large features.
std::vector<ModelGrouping> modelGroupings(const KnownObject& object);

}  // namespace monocular_eye_hand
