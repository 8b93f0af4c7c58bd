#include "monocular_eye_hand/recognition/contest.h"

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

constexpr double kMaxContestLogOdds = 12;  // log-odds of one pose against another

}  // namespace

double ContestWeights::logOdds(const PoseContest& contest) const {
  return log_odds * contest.log_odds + precise * contest.precise + contrast * contest.contrast +
         strength * contest.strength + shading * contest.shading;
}

std::vector<double> sharesOf(const std::vector<std::vector<double>>& log_odds) {
  std::vector<double> shares;
  double total = 0;
  for (size_t i = 0; i < log_odds.size(); ++i) {
    double against = 1;
    for (size_t j = 0; j < log_odds.size(); ++j)
      if (j != i) against += std::exp(-std::clamp(log_odds[i][j], -kMaxContestLogOdds, kMaxContestLogOdds));
    shares.push_back(1 / against);
    total += shares.back();
  }
  for (double& share : shares) share /= total;
  return shares;
}

}  // namespace monocular_eye_hand
