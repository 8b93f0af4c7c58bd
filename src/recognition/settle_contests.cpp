#include "recognition/settle_contests.h"

#include <algorithm>
#include <utility>

#include "recognition/alignment.h"
#include "recognition/decision.h"
#include "recognition/drawn_pixels.h"
#include "recognition/judging.h"
#include "recognition/pose_contest.h"
#include "recognition/verification.h"

namespace monocular_eye_hand {
namespace {

constexpr size_t kMaxContestants = 6;
constexpr double kWorthContest = 0.05;     // probability of the likeliest, else nothing is reported anyway
constexpr double kFarBehind = 4;           // log-odds behind the likeliest: no contest
constexpr double kSamePlace = 0.35;        // of the diameter between the centres
constexpr double kOtherPoseDistance = 10;  // nearer poses are taken for one [px]
constexpr double kResolved = 2.5;          // ... and those whose surfaces lie nowhere farther apart [px]
constexpr double kNoRival = -1e3;          // log-odds behind everything
constexpr int kMaxContestRays = 2500;      // of one contestant whose faces are looked at

// The contestant whose pose a candidate has, or which it is; -1: none.
int contestantOf(const SearchTask& task, const std::vector<Candidate>& candidates,
                 const std::vector<int>& competing, int candidate) {
  const Candidate& one = candidates[size_t(candidate)];
  const SearchModel& model = task.models[size_t(one.object)];
  for (int c : competing) {
    const Candidate& contestant = candidates[size_t(c)];
    if (contestant.object != one.object) continue;
    const Rigid3 &known = contestant.pose.camera_from_object, &pose = one.pose.camera_from_object;
    if (model.poseDistance(task.image.camera, known, pose) < kOtherPoseDistance ||
        model.coincide(task.image.camera, known, pose, kResolved))
      return c;
  }
  return -1;
}

bool inPlaceOf(const SearchTask& task, const Candidate& chosen, const Candidate& rival) {
  if (rival.object != chosen.object) return false;
  const ObjectModel& model = task.models[size_t(chosen.object)].model();
  const Eigen::Vector3d apart =
      rival.pose.camera_from_object * model.centre() - chosen.pose.camera_from_object * model.centre();
  return apart.norm() < kSamePlace * model.diameter;
}

// Of the chosen one and its rivals those that may be what is really there: the best of each pose.
std::vector<int> contestants(const SearchTask& task, const std::vector<Candidate>& candidates,
                             const Explanation& explanation) {
  std::vector<std::pair<double, int>> in_place;  // by log-odds
  const Candidate& chosen = candidates[size_t(explanation.candidate)];
  in_place.emplace_back(ownLogOdds(chosen, task.options.decision), explanation.candidate);
  for (int r : explanation.rivals)
    if (inPlaceOf(task, chosen, candidates[size_t(r)]))
      in_place.emplace_back(ownLogOdds(candidates[size_t(r)], task.options.decision), r);
  std::stable_sort(in_place.begin(), in_place.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });

  std::vector<int> competing;
  for (const auto& [log_odds, candidate] : in_place) {
    if (competing.size() == kMaxContestants || log_odds < in_place.front().first - kFarBehind) break;
    if (contestantOf(task, candidates, competing, candidate) < 0) competing.push_back(candidate);
  }
  return competing;
}

// Of the same object as the contestants, and none of them.
struct Bystander {
  int candidate = 0;
  int contestant = -1;  // whose pose it has, -1: of none
};

std::vector<Bystander> bystanders(const SearchTask& task, const std::vector<Candidate>& candidates,
                                  const std::vector<int>& competing, const Explanation& explanation) {
  std::vector<int> others = explanation.rivals;
  others.push_back(explanation.candidate);
  std::vector<Bystander> found;
  for (int other : others) {
    if (std::count(competing.begin(), competing.end(), other) > 0) continue;
    if (candidates[size_t(other)].object != candidates[size_t(explanation.candidate)].object) continue;
    found.push_back({other, contestantOf(task, candidates, competing, other)});
  }
  return found;
}

// The contestant moved by all its features, when that makes it more likely: what two poses draw differently
// is often no larger than the poses are off.
Candidate movedByFeatures(const SearchTask& task, const Candidate& contestant) {
  const SearchModel& model = task.models[size_t(contestant.object)];
  Candidate moved = contestant;
  moved.pose =
      alignByFeatures(model, task.image, contestant.pose.camera_from_object, kFineRanges.back(), kFineStep);
  if (!moved.pose.well_posed) return contestant;

  moved.pose.camera_from_object = model.canonical(moved.pose.camera_from_object, &moved.view);
  verify(model, task.image, &moved);
  weighAlone(task, &moved);
  return ownLogOdds(moved, task.options.decision) > ownLogOdds(contestant, task.options.decision)
             ? moved
             : contestant;
}

// Holds each against each; records it and returns what each has of the probability.
std::vector<double> compete(const SearchTask& task, const std::vector<int>& competing,
                            std::vector<Candidate>* candidates) {
  cv::Rect box;
  for (int c : competing) box |= (*candidates)[size_t(c)].bounding_box;
  const int step = latticeStep(box, kMaxContestRays);
  std::vector<Contestant> contestants;
  for (int c : competing) {
    const Candidate& candidate = (*candidates)[size_t(c)];
    const ObjectModel& model = task.models[size_t(candidate.object)].model();
    contestants.push_back({candidate, ownLogOdds(candidate, task.options.decision),
                           litFaces(model, task.image, candidate, step)});
  }

  const size_t n = competing.size();
  std::vector<std::vector<double>> log_odds(n, std::vector<double>(n, 0));
  for (size_t i = 0; i < n; ++i)
    for (size_t j = i + 1; j < n; ++j) {
      const PoseContest contest = contestBetween(task.image, contestants[i], contestants[j]);
      (*candidates)[size_t(competing[i])].contests.emplace_back(competing[j], contest);
      log_odds[i][j] = task.options.decision.contest.logOdds(contest);
      log_odds[j][i] = -log_odds[i][j];
    }
  return sharesOf(log_odds);
}

// Probability that one of them is right: of the likeliest, when the others speak half as much against it as
// strangers in its place would. Where the part is, its turned poses are nearly as good; where it is not, so
// is the best of many wrong ones.
double probabilityTogether(const SearchTask& task, const std::vector<Candidate>& candidates,
                           const std::vector<int>& competing, const std::vector<Bystander>& around,
                           const Explanation& explanation) {
  double best_outside = kNoRival;
  for (const Bystander& other : around)
    if (other.contestant < 0 && other.candidate != explanation.candidate)
      best_outside =
          std::max(best_outside, ownLogOdds(candidates[size_t(other.candidate)], task.options.decision));

  double together = candidates[size_t(explanation.candidate)].probability;
  for (int c : competing) {
    const double own = ownLogOdds(candidates[size_t(c)], task.options.decision);
    Lead lead = candidates[size_t(c)].lead;
    const double over_strangers = leadOver(own, best_outside);
    if (over_strangers > lead.in_place) lead.in_place = 0.5 * (lead.in_place + over_strangers);
    together = std::max(together, task.options.decision.probability(own, lead));
  }
  return together;
}

// The probabilities after a contest. A bystander in its place is no likelier than the contestant whose pose
// it has, or than the last one.
void share(const SearchTask& task, const std::vector<int>& competing, const std::vector<Bystander>& around,
           double together, const std::vector<double>& shares, std::vector<Candidate>* candidates) {
  const double winners_share = *std::max_element(shares.begin(), shares.end());
  double min_probability = 1;
  for (size_t k = 0; k < competing.size(); ++k) {
    Candidate& contestant = (*candidates)[size_t(competing[k])];
    contestant.probability = together * shares[k];
    contestant.winners_share = winners_share;
    min_probability = std::min(min_probability, contestant.probability);
  }

  for (const Bystander& other : around) {
    Candidate& rival = (*candidates)[size_t(other.candidate)];
    if (!inPlaceOf(task, (*candidates)[size_t(competing.front())], rival)) continue;
    const double bound =
        other.contestant < 0 ? min_probability : (*candidates)[size_t(other.contestant)].probability;
    rival.probability = std::min(rival.probability, bound);
    rival.winners_share = winners_share;
  }
}

}  // namespace

std::vector<Candidate> settleContests(const SearchTask& task, Explained all, StageLog* log) {
  std::vector<Candidate>& candidates = all.candidates;
  return log->timed("contests", [&](StageReport* report) {
    for (const Explanation& explanation : all.chosen) {
      if (candidates[size_t(explanation.candidate)].probability < kWorthContest) continue;
      const std::vector<int> competing = contestants(task, candidates, explanation);
      if (competing.size() < 2) continue;
      for (int c : competing) candidates[size_t(c)] = movedByFeatures(task, candidates[size_t(c)]);
      report->counts["contestants"] += double(competing.size());

      const std::vector<Bystander> around = bystanders(task, candidates, competing, explanation);
      const double together = probabilityTogether(task, candidates, competing, around, explanation);
      const std::vector<double> shares = compete(task, competing, &candidates);
      share(task, competing, around, together, shares, &candidates);
    }
    return std::move(candidates);
  });
}

}  // namespace monocular_eye_hand
