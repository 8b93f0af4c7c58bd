#pragma once
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/features/features.h"
#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/grouping/grouping.h"
#include "monocular_eye_hand/recognition/contest.h"

// What is asked of a recognition and what it answers. Plain values: whoever draws, publishes or tracks
// objects needs no more of this room than this header.

namespace monocular_eye_hand {

enum class Decision { kAccepted, kRejected, kAmbiguous };
std::string toString(Decision decision);

/// Another pose (or object) that explains the same part of the image nearly as well.
struct Alternative {
  int object = -1;  ///< ModelBase::objects
  Rigid3 camera_from_object;
  double probability = 0;
};

/// The narrow waist: an object, its pose, its covariance, and the evidence.
struct ObjectEstimate {
  int object = -1;  ///< ModelBase::objects
  std::string name;
  Rigid3 camera_from_object;
  Matrix6d covariance = Matrix6d::Zero();  ///< x, y, z, rotation about x, y, z; camera frame; m^2, rad^2
  double plausibility = 0;  ///< 0..1: back-projection error, matched groupings and their weights combined
  double reliability = 0;   ///< 0..1: matched feature weight, less unsupported and run-past features
  double probability = 0;   ///< calibrated probability that object and pose are right
  Decision decision = Decision::kRejected;
  std::vector<Alternative> alternatives;
  int matched_features = 0;   ///< model edges, circles and silhouettes found
  int expected_features = 0;  ///< ... visible in this view
  int matched_groupings = 0;  ///< image groupings explained by this object
  int characteristic_view = -1;
  cv::Rect bounding_box;   ///< of the projected model [uv_rect px]
  std::string symmetry;    ///< "", "2 equal poses", "free about z axis (0, 0, 1) through ...", for people
  bool free_axis = false;  ///< rotation about the model's symmetry axis cannot be seen
  std::string reason;      ///< why accepted, rejected or ambiguous
  /// The terms that spoke most for and against it, in words with their values, the strongest first.
  std::vector<std::string> spoke_for, spoke_against;
  std::map<std::string, double> evidence;  ///< the terms of the decision by name
};

/// What became of a candidate: chosen and then accepted, ambiguous or rejected, or suppressed by a chosen one
/// that explains the same part of the image better.
enum class Fate { kAccepted, kAmbiguous, kRejected, kSuppressed };
std::string toString(Fate fate);

/// A candidate that was verified and had evidence, and why it won or lost. The choice can be made again with
/// other probabilities: go through the candidates by descending rank score (equal ones in the order of the
/// list); each is suppressed by the first one chosen so far that is among its conflicts, else it is chosen.
struct JudgedCandidate {
  int object = -1;  ///< ModelBase::objects
  std::string name;
  std::string kind;           ///< of the grouping that its hypothesis came from, as toString(GroupingKind)
  Rigid3 camera_from_object;  ///< of a chosen one as reported, of a suppressed one as verified
  double plausibility = 0;    ///< as ObjectEstimate's
  double reliability = 0;     ///< as ObjectEstimate's
  double probability = 0;     ///< calibrated probability that object and pose are right
  std::string strongest_against;  ///< what DecisionTerm::words says of the term most against it; "": none is
  std::map<std::string, double> evidence;  ///< the terms of the decision by name
  /// Order of choice: sum^(1/2) * (probability / winners_share + 0.05), `sum` of the terms in `evidence`.
  double rank_score = 0;
  Fate fate = Fate::kSuppressed;
  int suppressed_by = -1;      ///< index in the list; -1: chosen
  std::vector<int> conflicts;  ///< indices of all others that, chosen, would suppress this one; ascending
  /// Other poses of it in its place that it was held against, by their index in the list. Each pair stands
  /// with one of the two.
  std::vector<std::pair<int, PoseContest>> contests;
  /// What the likeliest of them has of the probability that one of them is right; 1 without a contest.
  double winners_share = 1;
};

/// Counts and times of one stage, for people and the explain page.
struct StageReport {
  std::string name;
  double seconds = 0;  ///< stages of several objects may run at once
  std::map<std::string, double> counts;
};

/// How near the search for an object came to a pose: distance of the nearest pose that reached a stage of the
/// search; infinity when none did. Measured at the corner of the part's bounding box that is farthest off,
/// modulo the part's symmetries [px of the given image].
struct PoseTrace {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  int groupings = 0;         ///< of the image, all of whose features answer the object's contour in this pose
  double generated = kNone;  ///< hypotheses, as they came from groupings and edges
  double taken = kNone;      ///< ... that ranked high enough to be looked at further
  double aligned = kNone;    ///< ... when they had been moved onto the edges coarsely
  double verified = kNone;   ///< the best of these in different poses, moved finely, compared with the image
  double recorded = kNone;   ///< ... that the image bears out: the candidates
};

struct RecognitionResult {
  std::vector<ObjectEstimate> objects;   ///< accepted and ambiguous, best first
  std::vector<ObjectEstimate> rejected;  ///< candidates that were chosen and rejected, best first
  std::vector<JudgedCandidate> judged;   ///< RecognitionRequest::judged: all candidates, as they came up
  std::vector<PoseTrace> traces;         ///< one per RecognitionRequest::traced; empty without a search
  std::string reason;                    ///< when nothing is found: why
  bool truncated = false;                ///< the time limit left work undone
  bool budget_spent = false;             ///< the budget left groupings unused
  std::vector<StageReport> stages;
  FeatureSet features;
  std::vector<Grouping> groupings;
};

/// A pose that somebody else proposes.
struct PoseProposal {
  int object = -1;  ///< ModelBase::objects
  Rigid3 camera_from_object;
};

/// A plane that parts stand on or above: the top of a table, the floor of a box.
struct SupportPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, up; camera frame
  double offset = 0;                                  ///< the plane: normal . p = offset [m]
  double tolerance = 0.004;  ///< a part may seem to reach this much below it: errors of the calibration [m]

  void check() const;  ///< throws BadInput naming field, value and rule
};
/// The plane z = `height` [m] of a level frame, z up. `tolerance` [m] as above.
SupportPlane supportPlane(const Rigid3& camera_from_level, double height, double tolerance);

/// What to look for in one image.
struct RecognitionRequest {
  /// Name of the one object wanted ("": all); the search stops at the first plausible and reliable match.
  std::string only;
  std::vector<ObjectEstimate> previous;  ///< last frame's objects: equal poses are reported nearest to these
  /// Poses to decide on instead of searching: moved onto the edges and judged as what a search finds.
  std::optional<std::vector<PoseProposal>> proposals;
  /// Where it is known: a pose that reaches below it is refused, one in which the part rests on it gains.
  std::optional<SupportPlane> support;
  bool judged = false;  ///< fill RecognitionResult::judged, for fitting and studying decisions; costs time
  /// Poses in front of the camera whose way through the search is told (RecognitionResult::traces), for
  /// studying what is not found; changes no answer. Not used with `proposals`, which are not
  /// searched for.
  std::vector<PoseProposal> traced;
};

}  // namespace monocular_eye_hand
