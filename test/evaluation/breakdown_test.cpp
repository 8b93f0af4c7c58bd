#include "monocular_eye_hand/evaluation/breakdown.h"

#include <gtest/gtest.h>

#include <cmath>

#include "made_up_run.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

// Scene 1 image 0: block at 1 m, lid beside it, 60 % visible; image 1: block at 2 m. Scene 2 image 0: a lid
// of which 20 % are seen. Reported: the first block exactly, the lid 20 mm off (MSPD 21 px), a lid in image 1
// that is not there.
class Breakdown : public testing::Test {
 protected:
  Breakdown() {
    BopImage& first = run_.image(1, 0);
    MadeUpRun::truth(&first, 1, at(0, 0, 1000));
    MadeUpRun::truth(&first, 2, at(150, 0, 1000), 0.6);
    MadeUpRun::truth(&run_.image(1, 1), 1, at(0, 0, 2000));
    MadeUpRun::truth(&run_.image(2, 0), 2, at(0, 0, 1000), 0.2);
    run_.row(1, 0, 1, 0.9, at(0, 0, 1000));
    run_.row(1, 0, 2, 0.7, at(170, 0, 1000));
    run_.row(1, 1, 2, 0.6, at(0, 0, 1500));
    run_.row(7, 0, 1, 0.9, at(0, 0, 1000));  // of an image that is not in the split
  }
  MadeUpRun run_;
  const ImageTimes times_{{{1, 0}, 1.0}, {{1, 1}, 2.0}};
};

TEST_F(Breakdown, TruthAndRowsAreMatchedAndMeasured) {
  const RunOutcomes outcomes = run_.outcomes();
  ASSERT_EQ(outcomes.truths.size(), 4u);
  ASSERT_EQ(outcomes.rows.size(), 3u);
  EXPECT_TRUE(outcomes.truths[0].found());
  EXPECT_EQ(outcomes.truths[0].row, 0);
  EXPECT_NEAR(outcomes.truths[0].size, 1000 * 0.1 * std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(outcomes.truths[2].distance, 2, 1e-12);
  EXPECT_TRUE(outcomes.truths[0].towards_camera.isApprox(Eigen::Vector3d(0, 0, -1)));
  EXPECT_FALSE(outcomes.truths[1].found());
  EXPECT_NEAR(outcomes.truths[1].errors.mspd, 20 / 0.95, 1e-6);
  EXPECT_EQ(outcomes.truths[2].row, -1);
  EXPECT_EQ(outcomes.rows[1].nearest, 1);
  EXPECT_FALSE(outcomes.rows[1].right());
  EXPECT_EQ(outcomes.rows[2].nearest, -1);
}

TEST_F(Breakdown, ScoresBySceneByPartAndOfAll) {
  const auto scenes = scoresByScene(run_.split, run_.outcomes(), times_);
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_EQ(scenes[0].name, "scene 1");
  EXPECT_EQ(scenes[0].images, 2);
  EXPECT_EQ(scenes[0].found.part, 1);
  EXPECT_EQ(scenes[0].found.whole, 3);
  EXPECT_EQ(scenes[0].right.part, 1);
  EXPECT_EQ(scenes[0].wrong(), 2);
  EXPECT_EQ(scenes[0].median_time, 1.5);
  EXPECT_EQ(scenes[1].found.whole, 0) << "20 % visible is not wanted";
  EXPECT_EQ(scenes[1].counted, 1) << "... but counts in AR";
  EXPECT_EQ(scenes[1].ar, 0);
  EXPECT_TRUE(std::isnan(scenes[1].median_time));

  const auto parts = scoresByPart(run_.split, run_.models, run_.outcomes(), times_);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].name, "block");
  EXPECT_EQ(parts[0].images, 2);
  EXPECT_EQ(parts[0].found.whole, 2);
  EXPECT_EQ(parts[0].wrong(), 0);
  EXPECT_NEAR(parts[0].ar, 0.5, 1e-12);
  EXPECT_EQ(parts[1].wrong(), 2);
  EXPECT_EQ(parts[1].median_time, 1);

  const GroupScore all = scoreOfAll(run_.split, run_.outcomes(), times_);
  EXPECT_EQ(all.images, 3);
  EXPECT_EQ(all.found.whole, 3);
  EXPECT_EQ(all.right.whole, 3);
}

TEST_F(Breakdown, RecallInBins) {
  const RunOutcomes outcomes = run_.outcomes();
  const auto visible = recallByVisibility(outcomes);
  ASSERT_EQ(visible.size(), 5u) << "10-30 % up to 90-100 %";
  EXPECT_EQ(visible[0].found.whole, 1);
  EXPECT_EQ(visible[2].label, "50\u201370");
  EXPECT_EQ(visible[2].found.whole, 1);
  EXPECT_EQ(visible[4].found.whole, 2) << "fully visible is in the last bin";
  EXPECT_EQ(visible[4].found.part, 1);

  // 173 px, 171 px (sideways it is farther away) and 87 px.
  const auto size = recallBySize(outcomes);
  ASSERT_EQ(size.size(), 3u);
  EXPECT_EQ(size[0].label, "64\u201396");
  EXPECT_EQ(size[0].found.whole, 1);
  EXPECT_EQ(size[2].found.whole, 2);
  EXPECT_EQ(size[2].found.part, 1);

  const auto distance = recallByDistance(outcomes);
  ASSERT_FALSE(distance.empty());
  EXPECT_LE(distance.size(), 8u);
  EXPECT_EQ(distance.front().found.whole, 2);
  EXPECT_EQ(distance.front().label, "1\u20131.2");
  EXPECT_EQ(distance.back().found.whole, 1);

  const auto sides = recallBySide(outcomes, 1);
  ASSERT_EQ(sides.size(), 6u);
  EXPECT_EQ(sides[5].label, "\u2212z");
  EXPECT_EQ(sides[5].found.whole, 2);
  EXPECT_EQ(sides[4].found.whole, 0);
}

TEST_F(Breakdown, NothingWantedGivesNoBins) {
  const RunOutcomes none;
  EXPECT_TRUE(recallByVisibility(none).empty());
  EXPECT_TRUE(recallBySize(none).empty());
  EXPECT_TRUE(recallByDistance(none).empty());
}

TEST_F(Breakdown, PrecisionOverRecallGoesDownTheList) {
  run_.judge(1, 0, 1, 0.9, at(0, 0, 1000), JudgedPose::kReported);
  run_.judge(1, 0, 1, 0.8, at(1, 0, 1000), JudgedPose::kReported);  // a double: right, nothing new
  run_.judge(1, 1, 2, 0.6, at(0, 0, 1500), JudgedPose::kReported);  // wrong
  run_.judge(1, 1, 1, 0.3, at(0, 0, 2000), JudgedPose::kRejected);  // right
  run_.judge(1, 0, 2, 0.3, at(150, 0, 1000), JudgedPose::kRejected);
  run_.judge(1, 0, 2, 0.95, at(0, 0, 500), JudgedPose::kSuppressed);  // does not count
  const auto curve = precisionRecall(run_.poses(), run_.outcomes());
  ASSERT_EQ(curve.size(), 4u) << "equal probabilities are one point";
  EXPECT_EQ(curve[0].precision, 1);
  EXPECT_NEAR(curve[0].recall, 1 / 3.0, 1e-12);
  EXPECT_EQ(curve[1].precision, 1);
  EXPECT_NEAR(curve[1].recall, 1 / 3.0, 1e-12);
  EXPECT_NEAR(curve[2].precision, 2 / 3.0, 1e-12);
  EXPECT_EQ(curve[3].score, 0.3);
  EXPECT_NEAR(curve[3].precision, 4 / 5.0, 1e-12);
  EXPECT_NEAR(curve[3].recall, 1, 1e-12);

  const auto claimed = predictions(run_.poses());
  EXPECT_EQ(claimed.size(), 5u);
  EXPECT_EQ(std::count_if(claimed.begin(), claimed.end(), [](const Prediction& p) { return p.right; }), 4);
}

TEST_F(Breakdown, TwoRunsAreComparedInstanceByInstance) {
  MadeUpRun other = run_;
  other.results = {{1, 0, 2, 0.9, at(150, 0, 1000), 0.5}, {1, 1, 1, 0.9, at(0, 0, 2000), 0.5}};
  const RunComparison comparison = compareRuns(run_.split, run_.outcomes(), times_, other.outcomes(), times_);
  ASSERT_EQ(comparison.scenes.size(), 2u);
  EXPECT_EQ(comparison.scenes[0].found.only_a, 1);
  EXPECT_EQ(comparison.scenes[0].found.only_b, 2);
  EXPECT_EQ(comparison.scenes[0].found.both, 0);
  EXPECT_EQ(comparison.scenes[1].found.neither, 0);
  EXPECT_EQ(comparison.all.a.right.value(), 1 / 3.0);
  EXPECT_EQ(comparison.all.b.right.value(), 1);
  ASSERT_EQ(comparison.changed.size(), 3u);
  EXPECT_TRUE(comparison.changed[0].a.found());
  EXPECT_FALSE(comparison.changed[0].b.found());
  EXPECT_EQ(comparison.changed[2].b.image, 1);

  other.split.images.pop_back();
  EXPECT_THROW(compareRuns(run_.split, run_.outcomes(), times_, other.outcomes(), times_), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
