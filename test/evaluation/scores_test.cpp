#include "monocular_eye_hand/evaluation/scores.h"

#include <gmock/gmock.h>

#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "small_dataset.h"

// The numbers expected here are worked out by hand from the definitions, on the data set of small_dataset.h.

namespace monocular_eye_hand {
namespace {

class Scores : public testing::Test {
 protected:
  Scores() {
    writeSmallDataset(folder_);
    split_ = loadBopSplit(folder_.path(), "dev");
    models_ = loadBopModels(folder_.path("models"));
  }

  BopResult row(int scene, int image, int object, double score, const Eigen::Vector3d& t_mm) const {
    BopResult result;
    result.scene = scene;
    result.image = image;
    result.object = object;
    result.score = score;
    result.camera_from_object.translation = t_mm * 1e-3;
    result.time = 0.5;
    return result;
  }
  BopScores score(const std::vector<BopResult>& results, const std::vector<BopTarget>& targets = {}) const {
    return scoreBop(split_, models_, results, targets);
  }
  std::vector<SceneSummary> summary(const std::vector<BopResult>& results,
                                    const ImageTimes& times = {}) const {
    return summarize(split_, models_, results, times);
  }
  std::vector<BopResult> perfect() const {
    return {row(1, 0, 1, 0.9, {0, 0, 1000}), row(1, 0, 5, 0.8, {200, 0, 1000}),
            row(1, 3, 1, 0.7, {0, 0, 1000}), row(2, 0, 5, 0.6, {0, 0, 2000})};
  }

  TempFolder folder_;
  BopSplit split_;
  BopModels models_;
};

TEST_F(Scores, TruePosesScoreOne) {
  const BopScores s = score(perfect());
  EXPECT_EQ(s.images, 3);
  EXPECT_EQ(s.targets, 4);
  EXPECT_EQ(s.estimates, 4);
  EXPECT_EQ(s.ar_mssd, 1);
  EXPECT_EQ(s.ar_mspd, 1);
  EXPECT_NEAR(s.map(), 1, 1e-12);
  EXPECT_NEAR(s.mapStrict(), 1, 1e-12);
}

TEST_F(Scores, NothingFoundScoresZero) {
  const BopScores s = score({});
  EXPECT_EQ(s.ar(), 0);
  EXPECT_EQ(s.map(), 0);
  const auto scenes = summary({});
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_EQ(scenes[0].foundShare(), 0);
  EXPECT_EQ(scenes[0].rightShare(), 0);
  EXPECT_EQ(scenes[0].ar, 0);
  EXPECT_TRUE(std::isnan(scenes[0].median_time));
}

TEST_F(Scores, RecallCountsTheThresholdsThatAnErrorStaysBelow) {
  // One row, 12 mm off sideways: MSPD 12 px, below 8 of 10 thresholds (15 ... 50); MSSD 12 / 141.4 = 0.085,
  // below 9. Of four targets: AR_MSPD = 0.8 / 4, AR_MSSD = 0.9 / 4.
  const BopScores s = score({row(1, 0, 1, 0.9, {12, 0, 1000})});
  EXPECT_NEAR(s.ar_mspd, 0.2, 1e-12);
  EXPECT_NEAR(s.ar_mssd, 0.225, 1e-12);
  // Precision is 1 up to recall 1/2 of object 1 (two visible instances): 51 of 101 recalls; object 5 has 0.
  EXPECT_NEAR(s.map_mspd, 0.8 * 51 / 101 / 2, 1e-12);
  const auto scenes = summary({row(1, 0, 1, 0.9, {12, 0, 1000})});
  EXPECT_EQ(scenes[0].found, 0);
  EXPECT_EQ(scenes[0].wanted, 2);
  EXPECT_EQ(scenes[0].right, 0);
  EXPECT_NEAR(scenes[0].ar, 0.85 / 3, 1e-12);
}

TEST_F(Scores, AnErrorEqualToAThresholdIsWrong) {
  // 10 mm off at 1 m and f = 1000 px; the tetrahedron's corners at 1 m move by 10 px, give or take rounding.
  EXPECT_NEAR(score({row(1, 0, 1, 0.9, {10 + 1e-6, 0, 1000})}).ar_mspd, 0.8 / 4, 1e-12);
  EXPECT_NEAR(score({row(1, 0, 1, 0.9, {10 - 1e-6, 0, 1000})}).ar_mspd, 0.9 / 4, 1e-12);
}

TEST_F(Scores, SymmetricPosesAreTheSame) {
  BopResult turned = row(2, 0, 5, 0.6, {0, 0, 2000});
  turned.camera_from_object.rotation = Eigen::Vector3d(-1, -1, 1).asDiagonal();
  EXPECT_NEAR(score({turned}).ar(), 0.25, 1e-12);
  EXPECT_EQ(summary({turned})[1].found, 1);
}

TEST_F(Scores, ADoubleIsRightButFoundOnce) {
  auto results = perfect();
  results.push_back(row(1, 0, 1, 0.95, {1, 0, 1000}));
  const auto scenes = summary(results);
  EXPECT_EQ(scenes[0].found, 2);
  EXPECT_EQ(scenes[0].rows, 4);
  EXPECT_EQ(scenes[0].right, 4);
  // Localization takes the best-scored one only; detection counts the other as false: object 1 has right
  // (0.95), false (0.9), right (0.7): precision 1 up to recall 1/2, 2/3 above.
  const BopScores s = score(results);
  EXPECT_EQ(s.ar_mspd, 1);
  EXPECT_NEAR(s.map_mspd, ((51 + 50 * 2.0 / 3) / 101 + 1) / 2, 1e-12);
}

TEST_F(Scores, TheHardlyVisibleInstanceIsNeitherWantedNorAFault) {
  auto results = perfect();
  results.push_back(row(1, 3, 1, 0.99, {-200, 0, 1000}));
  const BopScores s = score(results);
  EXPECT_NEAR(s.map(), 1, 1e-12);
  // Its score is the best, so localization spends the one estimate it allows on it.
  EXPECT_NEAR(s.ar(), 0.75, 1e-12);
  const auto scenes = summary(results);
  EXPECT_EQ(scenes[0].wanted, 2);
  EXPECT_EQ(scenes[0].found, 2);
  EXPECT_EQ(scenes[0].right, 4);
  EXPECT_NEAR(scenes[0].ar, 1, 1e-12);
}

TEST_F(Scores, AnObjectThatIsAbsentCountsInTheStrictScoreOnly) {
  auto results = perfect();
  results.push_back(row(2, 0, 1, 0.95, {0, 0, 1000}));
  const BopScores s = score(results);
  EXPECT_NEAR(s.map(), 1, 1e-12);
  // Object 1: false (0.95), right (0.9), right (0.7): precision 2/3 everywhere.
  EXPECT_NEAR(s.mapStrict(), (2.0 / 3 + 1) / 2, 1e-12);
  EXPECT_NEAR(summary(results)[1].rightShare(), 0.5, 1e-12);
}

TEST_F(Scores, ThresholdsScaleWithTheWidthOfTheImages) {
  split_.width = 1280;  // 12 px there are 6 px of 640: below 9 of the thresholds
  EXPECT_NEAR(score({row(1, 0, 1, 0.9, {12, 0, 1000})}).ar_mspd, 0.9 / 4, 1e-12);
}

TEST_F(Scores, TargetsSayWhatCounts) {
  const std::vector<BopTarget> targets{{1, 3, 1, 2}};
  EXPECT_NEAR(score(perfect(), targets).ar(), 0.5, 1e-12);
  EXPECT_EQ(score(perfect(), targets).targets, 2);
  EXPECT_THROW(score(perfect(), {{4, 3, 1, 2}}), BadInput);
}

TEST_F(Scores, TimesOfTheFileGoBeforeThoseOfTheRows) {
  auto results = perfect();
  EXPECT_EQ(summary(results)[0].median_time, 0.5);
  EXPECT_NEAR(summary(results, {{{1, 0}, 0.1}, {{1, 3}, 0.4}})[0].median_time, 0.25, 1e-12);
}

TEST_F(Scores, PrintedLines) {
  const auto scenes = summary(perfect());
  EXPECT_EQ(summaryLine(scenes[0]), "scene 1: found 1.000 (2/2) right 1.000 (3/3) AR 1.000 median 0.500 s");
  EXPECT_EQ(summaryFigure(scenes), "found/right/AR/time 1: 1.00/1.00/1.00/0.50s | 2: 1.00/1.00/1.00/0.50s");
}

TEST_F(Scores, ATruthWithoutAModelIsRefused) {
  models_.erase(5);
  EXPECT_THROW(score(perfect()), BadInput);
  EXPECT_THROW(summary(perfect()), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
