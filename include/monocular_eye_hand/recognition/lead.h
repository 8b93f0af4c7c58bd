#pragma once
#include <vector>

namespace monocular_eye_hand {

/// How far a candidate stands out among the others of its object in one image. Where the object is, the right
/// pose is far better than all others; where it is not, the best of many wrong ones is as good as the next.
/// Differences of log-odds, from -2 to 8; 8 when there is nothing to compare with.
struct Lead {
  double over_most = 0;  ///< over the lower quartile of all others
  /// Over the third best of those elsewhere in the image that are themselves improbable: other instances do
  /// not count against it.
  double elsewhere = 0;
  double in_place = 0;  ///< over the best other pose in its place
};

/// A lead in log-odds: their difference within its bounds.
double leadOver(double own_log_odds, double other_log_odds);

/// A candidate among the others of its image.
struct Competitor {
  int object = 0;
  double log_odds = 0;         ///< by its evidence alone
  std::vector<int> conflicts;  ///< indices of those of its object that explain the same part of the image
};

/// The lead of each. A conflict counts for both, whichever of the two names it.
std::vector<Lead> leadsAmong(const std::vector<Competitor>& competitors);

}  // namespace monocular_eye_hand
