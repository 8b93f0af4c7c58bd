#pragma once
#include <limits>
#include <string>

namespace monocular_eye_hand {

/// How near the search for an object came to a true instance, stage by stage: distance of the nearest pose
/// that reached the stage [px of the data set]; infinity: none came so far.
struct TracedTruth {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  int scene = 0, image = 0;
  int truth = 0;             ///< BopImage::truth
  int groupings = 0;         ///< of the image that consist of its features
  double generated = kNone;  ///< hypotheses
  double taken = kNone;      ///< ... that ranked high enough to be looked at further
  double aligned = kNone;    ///< ... coarsely moved onto the edges
  double verified = kNone;   ///< ... finely moved onto the edges and compared with the image
  double recorded = kNone;   ///< ... that the image bears out: candidates
};

/// Where on its way through recognition a wanted instance was lost, the earliest stage first.
struct LostAt {
  enum Stage {
    kNoGrouping,      ///< no grouping of its features, and no hypothesis near
    kNotGenerated,    ///< no hypothesis near
    kNotTaken,        ///< ... none that ranked high enough to be looked at further
    kNotAligned,      ///< ... none that reached the edges
    kNotVerified,     ///< ... none that was the best of its place and that the fine alignment brought to it
    kNotBorneOut,     ///< ... none that the image bears out
    kNotKept,         ///< ... none that was judged: not looked at in a larger image, or moved away there
    kNotJudged,       ///< no candidate near, and it is not known at which of the stages above it was lost
    kRejected,        ///< a right candidate was too improbable
    kSuppressed,      ///< a right candidate fell to another explanation
    kFoundElsewhere,  ///< a right row is there, but counts for another instance
  };
  Stage stage = kNotJudged;
  /// Distance of the nearest pose at the last stage that had one near, else of the nearest at all.
  double nearest_px = std::numeric_limits<double>::infinity();
  std::string by;  ///< the terms that spoke against it, or who suppressed it
};
/// For people: "rejected".
std::string toString(LostAt::Stage stage);

/// Where the search lost an instance of which nothing right was judged: behind the last stage that had a pose
/// near it. `size`: of its image [px of the data set].
LostAt lostInSearch(const TracedTruth& traced, double size);

}  // namespace monocular_eye_hand
