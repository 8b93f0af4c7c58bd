#pragma once
#include <vector>

namespace monocular_eye_hand {

/// What an image says for one pose of a part against another one of it in the same place. What both draw
/// alike says nothing; what one draws and the other does not decides. Differences, first less second: what
/// speaks for the first is positive, and of the other way round the same is negative.
struct PoseContest {
  double log_odds = 0;  ///< by each one's own evidence
  double precise = 0;   ///< share of its own lines on parallel edges within 0.75 px
  double contrast = 0;  ///< ln of the contrast across its own lines over that beside them, squared
  double strength = 0;  ///< contrast across its own lines, in standard deviations of the noise, at most 6
  double shading = 0;   ///< how much better its faces explain the greys where the two look different ways

  template <class Visitor>
  void visit(Visitor&& v) {
    v("log_odds", log_odds);
    v("precise", precise);
    v("contrast", contrast);
    v("strength", strength);
    v("shading", shading);
  }
};

/// Weights of a contest: log-odds that the first of two poses is right when one of them is. There is no bias:
/// the order of the two says nothing. The default believes each one's own evidence.
struct ContestWeights : PoseContest {
  ContestWeights() { log_odds = 1; }
  double logOdds(const PoseContest& contest) const;
};

/// What each of several poses has of the probability that one of them is right; the shares sum to 1.
/// `log_odds[i][j]`: for i against j (Bradley and Terry 1952, with every pair's own log-odds).
std::vector<double> sharesOf(const std::vector<std::vector<double>>& log_odds);

}  // namespace monocular_eye_hand
