#include "monocular_eye_hand/evaluation/lost_at.h"

#include <algorithm>

#include "monocular_eye_hand/evaluation/outcomes.h"

namespace monocular_eye_hand {
namespace {

// A hypothesis need not be right, it must lie where alignment leads to the right pose. That is the farther
// off the larger the object is: hypotheses of one view, place, distance and rotation are taken as one
// although they differ by up to this share of the object's image. In rendered scenes all that the search
// found had one as near.
constexpr double kCoarselyNear = 0.15;

}  // namespace

std::string toString(LostAt::Stage stage) {
  switch (stage) {
    case LostAt::kNoGrouping:
      return "no grouping of its own";
    case LostAt::kNotGenerated:
      return "no hypothesis near";
    case LostAt::kNotTaken:
      return "ranked too low";
    case LostAt::kNotAligned:
      return "not aligned";
    case LostAt::kNotVerified:
      return "aligned, not verified";
    case LostAt::kNotBorneOut:
      return "not borne out by the image";
    case LostAt::kNotKept:
      return "lost after the search";
    case LostAt::kNotJudged:
      return "no candidate within 10 px";
    case LostAt::kRejected:
      return "rejected";
    case LostAt::kSuppressed:
      return "suppressed";
    case LostAt::kFoundElsewhere:
      return "found elsewhere";
  }

  return "unknown";
}

LostAt lostInSearch(const TracedTruth& traced, double size) {
  const double coarse = std::max(kRightError, kCoarselyNear * size);
  struct Reached {
    double nearest, limit;
    LostAt::Stage lost_behind;
  };
  const Reached last_first[] = {
      {traced.recorded, kRightError, LostAt::kNotKept},
      {traced.verified, kRightError, LostAt::kNotBorneOut},
      {traced.aligned, kRightError, LostAt::kNotVerified},
      {traced.taken, coarse, LostAt::kNotAligned},
      {traced.generated, coarse, LostAt::kNotTaken},
  };

  LostAt lost;
  for (const Reached& reached : last_first) {
    if (reached.nearest < reached.limit) return {reached.lost_behind, reached.nearest, ""};
    lost.nearest_px = std::min(lost.nearest_px, reached.nearest);
  }
  lost.stage = traced.groupings > 0 ? LostAt::kNotGenerated : LostAt::kNoGrouping;
  return lost;
}

}  // namespace monocular_eye_hand
