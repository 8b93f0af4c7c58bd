// Poses of one part that are nearly alike, held against each other.
#include "monocular_eye_hand/recognition/contest.h"
#include "monocular_eye_hand/simulation/render/render.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "recognition/settle_contests.h"
#include "verified.h"

namespace monocular_eye_hand {
namespace {

TEST(Shares, OfTwoAreTheLogisticFunctionOfTheirLogOdds) {
  const std::vector<double> shares = sharesOf({{0, 1.3}, {-1.3, 0}});
  EXPECT_NEAR(shares[0], 1 / (1 + std::exp(-1.3)), 1e-12);
  EXPECT_NEAR(shares[0] + shares[1], 1, 1e-12);
}

TEST(Shares, OfConsistentLogOddsAreProportionalToTheOdds) {
  const std::vector<double> strength{0.5, -1, 2};
  std::vector<std::vector<double>> log_odds(3, std::vector<double>(3));
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) log_odds[i][j] = strength[i] - strength[j];
  const std::vector<double> shares = sharesOf(log_odds);
  EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), 1, 1e-12);
  EXPECT_NEAR(shares[2] / shares[0], std::exp(1.5), 1e-9);
  EXPECT_NEAR(shares[0] / shares[1], std::exp(1.5), 1e-9);
}

TEST(Shares, StayFiniteWhateverTheLogOdds) {
  const std::vector<double> shares = sharesOf({{0, 1e9}, {-1e9, 0}});
  EXPECT_NEAR(shares[0], 1, 1e-4);
  EXPECT_GT(shares[1], 0);
}

TEST(ContestWeights, OfTheOtherWayRoundGiveTheOpposite) {
  const ContestWeights weights = fittedWeights().contest;
  PoseContest contest, opposite;
  contest.log_odds = 0.4;
  contest.precise = -0.2;
  contest.contrast = 1.5;
  contest.shading = -0.7;
  opposite = contest;
  opposite.visit([](const char*, double& value) { value = -value; });
  EXPECT_EQ(weights.logOdds(contest), -weights.logOdds(opposite));
  EXPECT_EQ(weights.logOdds({}), 0);
}

TEST(ContestWeights, ThatWereFittedFavourWhatTheImageShows) {
  ContestWeights weights = fittedWeights().contest;
  weights.visit([](const char* name, double& weight) { EXPECT_GT(weight, 0) << name; });
}

// A bar with a boss near one end, which lies on a table: a half turn leaves all but the boss where it is.
class Bar : public testing::Test {
 protected:
  static constexpr int kRight = 0, kTurned = 1;

  static Mesh mesh() {
    Mesh bar = boxMesh({0.1, 0.04, 0.02});
    const Mesh boss = boxMesh({0.014, 0.014, 0.012});
    const int first = int(bar.vertices.size());
    for (const Eigen::Vector3d& p : boss.vertices)
      bar.vertices.push_back(p + Eigen::Vector3d(0.033, 0, 0.015));
    for (const std::array<int, 3>& t : boss.triangles)
      bar.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return bar;
  }

  Bar() { models_.emplace_back(object_); }

  // What is looked at, the bar with its boss up, or down where it cannot be seen.
  SearchImage seen(bool boss_up) {
    Rigid3 world_from_bar;
    world_from_bar.rotation =
        Eigen::AngleAxisd(boss_up ? 0 : M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
    world_from_bar.translation.z() = boss_up ? 0 : 0.04;
    const Rigid3 world_from_camera = lookFrom(-1.1, 0.9, 0.45, {0, 0, 0});
    Scene scene = plainScene({standing("bar", mesh(), world_from_bar)}, world_from_camera);
    camera_from_bar_ = world_from_camera.inverse() * world_from_bar;
    return looked(renderScene(scene, testCamera()).grey, testCamera());
  }

  // The right pose and the turned one, both of probability 0.8, as candidates that explain the same place.
  std::vector<Candidate> settled(const SearchImage& image, int chosen) {
    const SearchTask task{image, models_, wanted_, options_};
    const Rigid3 turn = rotationAbout(models_[0].model().centre(),
                                      Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()).toRotationMatrix());
    std::vector<Candidate> candidates{verified(image, models_[0], camera_from_bar_),
                                      verified(image, models_[0], camera_from_bar_ * turn)};
    for (Candidate& candidate : candidates) {
      candidate.probability = 0.8;
      candidate.lead = {8, 8, 0};
    }
    StageLog log;
    return settleContests(task, {candidates, {Explanation{chosen, {1 - chosen}}}}, &log);
  }

  KnownObject object_ = known("bar", mesh());
  std::vector<SearchModel> models_;
  std::vector<int> wanted_{0};
  RecognitionOptions options_;
  Rigid3 camera_from_bar_;
};

TEST_F(Bar, WhatTheTwoDrawDifferentlyTellsWhichIsRight) {
  const SearchImage image = seen(true);
  for (int chosen : {kRight, kTurned}) {
    const std::vector<Candidate> candidates = settled(image, chosen);
    const Candidate &right = candidates[kRight], &turned = candidates[kTurned];
    EXPECT_GT(right.probability, 20 * turned.probability) << "chosen before: " << chosen;
    EXPECT_GT(rankScore(right), rankScore(turned));
    ASSERT_EQ(right.contests.size() + turned.contests.size(), 1u) << "each pair once";
    const double side = right.contests.empty() ? -1 : 1;
    const PoseContest& contest = (right.contests.empty() ? turned : right).contests[0].second;
    EXPECT_GT(side * contest.precise, 0.3);
    EXPECT_GT(side * contest.contrast, 1);
    EXPECT_GT(side * contest.strength, 1);
  }
}

TEST_F(Bar, WhatThisViewHidesLeavesBothAsLikelyAndTheWinnerRanksAsBothTogether) {
  const std::vector<Candidate> candidates = settled(seen(false), kRight);
  double together = 0;
  for (const Candidate& candidate : candidates) {
    EXPECT_GT(candidate.probability, 0.25);
    EXPECT_LT(candidate.probability, 0.75);
    together += candidate.probability;
  }
  EXPECT_LE(together, 1);
  const Candidate& winner =
      *std::max_element(candidates.begin(), candidates.end(),
                        [](const auto& a, const auto& b) { return a.probability < b.probability; });
  EXPECT_NEAR(winner.probability / winner.winners_share, together, 1e-9);
}

TEST_F(Bar, PosesCoincideWhenNoCameraTellsTheirSurfacesApart) {
  const Rigid3 turn = rotationAbout(models_[0].model().centre(),
                                    Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()).toRotationMatrix());
  const auto coincideAt = [&](double distance, const Rigid3& motion) {
    Rigid3 pose;
    pose.translation.z() = distance;
    return models_[0].coincide(testCamera(), pose, pose * motion, 2.5);
  };
  EXPECT_TRUE(coincideAt(0.4, Rigid3{}));
  EXPECT_FALSE(coincideAt(0.4, turn)) << "the boss is 21 px high";
  EXPECT_TRUE(coincideAt(4, turn)) << "the boss is 2 px high";
  Rigid3 beside;
  beside.translation.x() = 0.002;
  EXPECT_FALSE(coincideAt(0.4, beside)) << "3.5 px";
  EXPECT_TRUE(coincideAt(1, beside)) << "1.4 px";
}

TEST_F(Bar, OneThatIsFarBehindDoesNotCompete) {
  const SearchImage image = seen(true);
  const SearchTask task{image, models_, wanted_, options_};
  std::vector<Candidate> candidates{verified(image, models_[0], camera_from_bar_)};
  candidates.push_back(candidates[0]);
  candidates[1].pose.camera_from_object =
      camera_from_bar_ * rotationAbout(models_[0].model().centre(),
                                       Eigen::AngleAxisd(1, Eigen::Vector3d::UnitZ()).toRotationMatrix());
  verify(models_[0], image, &candidates[1]);
  candidates[0].probability = 0.9;
  StageLog log;
  candidates = settleContests(task, {candidates, {Explanation{0, {1}}}}, &log);
  EXPECT_EQ(candidates[0].probability, 0.9);
  EXPECT_EQ(candidates[0].winners_share, 1);
  EXPECT_TRUE(candidates[0].contests.empty());
}

}  // namespace
}  // namespace monocular_eye_hand
