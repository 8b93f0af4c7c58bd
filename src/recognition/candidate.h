#pragma once
#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/grouping/grouping.h"
#include "monocular_eye_hand/model/object_model.h"
#include "monocular_eye_hand/pose/matches.h"
#include "monocular_eye_hand/recognition/contest.h"
#include "monocular_eye_hand/recognition/evidence_terms.h"
#include "monocular_eye_hand/recognition/lead.h"
#include "recognition/support_evidence.h"

namespace monocular_eye_hand {

/// A visible contour sample in the image, and the edge point that answers it.
struct SeenSample {
  Eigen::Vector3d p_in_object;
  Eigen::Vector2d uv, direction;  ///< rectified pixels; direction: unit
  double rounding = 0;  ///< standard deviation of a rounded edge's place across itself, 0: sharp [px]
  int feature = 0;
  int edge_point = -1;  ///< FeatureSet::points, -1: none within range
  bool inside = false;  ///< inside the image, and not hidden
  bool hidden = false;  ///< behind a surely recognised object
  bool silhouette = false;
  int inward =
      0;  ///< silhouette: +1 / -1 when the part lies on the side of +/- direction turned by 90 degrees
  bool outline = false;  ///< verify(): the part's outline, beyond which it is not seen

  /// `direction` turned by 90 degrees.
  Eigen::Vector2d normal() const { return {-direction.y(), direction.x()}; }
};

/// A surely recognised object, which may hide others.
struct Occluder {
  const ObjectModel* model = nullptr;
  Rigid3 object_from_camera;
  cv::Rect box;  ///< around its drawing [uv_rect px]

  /// Whether it lies before a point that is seen at this pixel, `distance` from the camera [m].
  bool hides(const Camera& camera, const Eigen::Vector2d& uv, double distance) const;
};

/// A pose that has been refined and looked at.
struct Candidate {
  int object = 0;
  GroupingKind kind = GroupingKind::kEdge;
  RefinedPose pose;
  int view = 0;
  EvidenceTerms terms;
  std::vector<SeenSample> contour;
  std::vector<int> claimed;  ///< edge points that answer it, ascending
  std::vector<int> covered;  ///< cells of kCoverCell px that its faces cover, ascending
  int matched_features = 0;
  int matched_corners = 0;          ///< size of its constellation, see growConstellation
  std::vector<Occluder> occluders;  ///< verify() does not miss what they hide
  cv::Rect bounding_box;
  SupportEvidence support;  ///< of the plane that parts stand on, where one is known
  double probability = 0;
  /// settleContests(): of the probability that one of the poses held against each other is right. It ranks
  /// among other explanations by what it would have alone.
  double winners_share = 1;
  Lead lead;  ///< weighAmongOthers(): over the others of its object
  /// settleContests(): with others by their index; each pair stands with one of the two.
  std::vector<std::pair<int, PoseContest>> contests;
};

constexpr int kCoverCell = 8;  ///< side of the cells that measure overlap [px]

}  // namespace monocular_eye_hand
