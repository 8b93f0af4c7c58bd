#pragma once
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/evaluation/lost_at.h"
#include "monocular_eye_hand/evaluation/outcomes.h"

namespace monocular_eye_hand {

/// The limits that an instance or its candidate may lie beyond (RecognitionOptions).
struct SearchLimits {
  double min_distance = 0, max_distance = std::numeric_limits<double>::infinity();  ///< [m]
  double min_size = 0;              ///< [px of the image as it was given to the search]
  double min_in_frame = 0;          ///< share of the contour
  double accept_probability = 0.5;  ///< smallest of what is reported
  double searched_scale = 1;        ///< searched pixels per pixel of the data set's images
};

struct MissedObject {
  TruthOutcome truth;
  LostAt lost;
  int nearest = -1;  ///< the judged pose of its object nearest to it (MSPD), in the list given; -1: none
  std::optional<TracedTruth> traced;  ///< how near the search came to it, when that is known
  bool turned = false;  ///< nothing within 10 px was judged, but its object in its place, turned
  std::string limit;    ///< which limit of the search excludes it, with both numbers; "" = none
  std::string cause;    ///< short, without numbers of its own: what is counted
};

/// What a pose that is wrong has been taken for.
enum class WrongCause {
  kNearMiss,     ///< its object, 10 to 20 px off, which is less than a quarter of its image
  kTwin,         ///< its object in the right place, in a wrong orientation
  kMisplaced,    ///< on an instance of its object, larger, smaller or displaced
  kOtherObject,  ///< on another object of the truth
  kClutter,      ///< on nothing that the truth knows
};
std::string toString(WrongCause cause);

struct WrongAccept {
  RowOutcome row;
  WrongCause cause = WrongCause::kClutter;
  int on = -1;         ///< BopImage::truth that it sits on; -1: none
  double overlap = 0;  ///< share of its outline's hull on the hull of that
  int judged = -1;     ///< the judged pose that it is, in the list given; -1: not among them
};

/// Share of an instance's contour that lies inside its image.
using InFrame = std::function<double(const TruthOutcome&)>;

/// Every wanted instance that was not found and what is known of why; worst first: those inside the limits of
/// the search, the most visible, the largest. `judged` as measured() gave it; `traced`: of the run's search,
/// those that are known; `in_frame` may be empty.
std::vector<MissedObject> missedObjects(const BopSplit& split, const BopModels& models,
                                        const RunOutcomes& run, const std::vector<JudgedPose>& judged,
                                        const std::vector<TracedTruth>& traced, const SearchLimits& limits,
                                        const InFrame& in_frame);

/// Every row that is not right, the surest first.
std::vector<WrongAccept> wrongAccepts(const BopSplit& split, const BopModels& models, const RunOutcomes& run,
                                      const std::vector<JudgedPose>& judged);

/// A cause and how often it occurs.
struct CauseCount {
  std::string cause;
  int count = 0;
};
/// The most frequent first, equal counts in the order of the alphabet.
std::vector<CauseCount> causeCounts(const std::vector<MissedObject>& missed);
std::vector<CauseCount> causeCounts(const std::vector<WrongAccept>& wrong);

}  // namespace monocular_eye_hand
