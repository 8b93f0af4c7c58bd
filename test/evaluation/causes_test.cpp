#include "monocular_eye_hand/evaluation/causes.h"

#include <gmock/gmock.h>

#include "made_up_run.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

class Causes : public testing::Test {
 protected:
  std::vector<MissedObject> missed(const SearchLimits& limits = {}, const InFrame& in_frame = {}) const {
    return missedObjects(run_.split, run_.models, run_.outcomes(), run_.poses(), traced_, limits, in_frame);
  }
  std::vector<WrongAccept> wrong() const {
    return wrongAccepts(run_.split, run_.models, run_.outcomes(), run_.poses());
  }
  // The one wrong accept of a block's pose in an image with a block at 1 m and a lid beside it.
  WrongAccept wrongBlock(const Rigid3& pose) {
    BopImage& image = run_.image(1, 0);
    MadeUpRun::truth(&image, 1, at(0, 0, 1000));
    MadeUpRun::truth(&image, 2, at(150, 0, 1000));
    run_.row(1, 0, 1, 0.8, pose);
    const auto all = wrong();
    EXPECT_EQ(all.size(), 1u);
    return all.empty() ? WrongAccept{} : all[0];
  }
  MadeUpRun run_;
  std::vector<TracedTruth> traced_;
};

TEST_F(Causes, ARightCandidateThatWasRejectedSaysByWhat) {
  MadeUpRun::truth(&run_.image(1, 0), 1, at(0, 0, 1000));
  run_.judge(1, 0, 1, 0.2, at(1, 0, 1000), JudgedPose::kRejected, "a nearer one that is less probable");
  run_.judge(1, 0, 1, 0.4, at(2, 0, 1000), JudgedPose::kRejected,
             "share of its corners past which edges run on 0.33 (usually 0.05); blur 3.6 (usually 2)");
  run_.judged.back().strongest_against = "share of its corners past which edges run on";
  const auto all = missed();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].lost.stage, LostAt::kRejected);
  EXPECT_EQ(all[0].nearest, 1) << "the most probable of the right ones";
  EXPECT_NEAR(all[0].lost.nearest_px, 2 / 0.95, 1e-6);
  EXPECT_THAT(all[0].lost.by, HasSubstr("0.33 (usually 0.05)"));
  EXPECT_EQ(all[0].cause, "rejected: share of its corners past which edges run on");
}

TEST_F(Causes, SuppressedNearAndFarCandidates) {
  MadeUpRun::truth(&run_.image(1, 0), 1, at(0, 0, 1000));
  MadeUpRun::truth(&run_.image(1, 1), 1, at(0, 0, 1000));
  MadeUpRun::truth(&run_.image(1, 2), 1, at(0, 0, 1000));
  MadeUpRun::truth(&run_.image(1, 3), 1, at(0, 0, 1000));
  run_.judge(1, 0, 1, 0.9, at(1, 0, 1000), JudgedPose::kSuppressed, "lid 0.95");
  run_.judge(1, 1, 1, 0.9, at(15, 0, 1000), JudgedPose::kReported);
  run_.judge(1, 2, 1, 0.1, at(60, 0, 1000), JudgedPose::kRejected, "weak");
  run_.row(1, 1, 1, 0.9, at(15, 0, 1000));
  const auto all = missed();
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0].lost.stage, LostAt::kSuppressed);
  EXPECT_EQ(all[0].lost.by, "lid 0.95");
  EXPECT_EQ(all[1].lost.stage, LostAt::kNotJudged);
  EXPECT_NEAR(all[1].lost.nearest_px, 15 / 0.95, 1e-6);
  EXPECT_EQ(all[1].cause, "no candidate within 10 px, one nearly right");
  EXPECT_EQ(all[2].cause, "no candidate within 10 px, none in its place");
  EXPECT_EQ(all[3].nearest, -1);
  EXPECT_TRUE(std::isinf(all[3].lost.nearest_px));

  const auto counts = causeCounts(all);
  ASSERT_EQ(counts.size(), 3u);
  EXPECT_EQ(counts[0].count, 2) << "the most frequent first";
  EXPECT_EQ(counts[0].cause, all[2].cause);
}

TEST_F(Causes, ARejectionWithoutAKnownReasonIsCountedAsSuch) {
  MadeUpRun::truth(&run_.image(1, 0), 1, at(0, 0, 1000));
  run_.judge(1, 0, 1, 0.4, at(0, 0, 1000), JudgedPose::kRejected, "size 3.6 (usually 4)");
  EXPECT_EQ(missed().at(0).cause, "rejected");
}

TEST_F(Causes, ASmallObjectTurnedIsNotNearlyRight) {
  // 35 px large: 12 px are a third of it.
  MadeUpRun::truth(&run_.image(1, 0), 1, at(0, 0, 5000));
  Rigid3 turned = at(0, 0, 5000);
  turned.rotation = expSO3({0, 0, M_PI / 4});
  run_.judge(1, 0, 1, 0.4, turned, JudgedPose::kRejected);
  run_.row(1, 0, 1, 0.6, turned);
  EXPECT_NEAR(missed().at(0).lost.nearest_px, 10.9, 0.1);
  EXPECT_TRUE(missed().at(0).turned);
  EXPECT_EQ(wrong().at(0).cause, WrongCause::kTwin);
}

TEST_F(Causes, AMissedObjectThatOnlyTwinsWereJudgedOf) {
  MadeUpRun::truth(&run_.image(1, 0), 1, at(0, 0, 1000));
  Rigid3 turned = at(0, 0, 1000);
  turned.rotation = expSO3({0, 0, M_PI / 2});
  run_.judge(1, 0, 1, 0.3, turned, JudgedPose::kRejected);
  run_.judge(1, 0, 1, 0.3, at(40, 0, 1000), JudgedPose::kRejected);
  EXPECT_TRUE(missed().at(0).turned);
  EXPECT_EQ(missed().at(0).nearest, 1);
  EXPECT_EQ(missed().at(0).cause, "no candidate within 10 px, one in its place in a wrong orientation");
}

TEST_F(Causes, WhatSuppressedARightCandidateIsToldApart) {
  BopImage& image = run_.image(1, 0);
  MadeUpRun::truth(&image, 1, at(0, 0, 1000));
  MadeUpRun::truth(&image, 2, at(150, 0, 1000), 0.3);
  run_.judge(1, 0, 1, 0.9, at(1, 0, 1000), JudgedPose::kSuppressed);
  run_.judge(1, 0, 1, 0.9, at(40, 0, 1000), JudgedPose::kReported);
  run_.judge(1, 0, 2, 0.3, at(150, 0, 1000), JudgedPose::kRejected);
  run_.judged[0].suppressed_by = 1;
  EXPECT_EQ(missed().at(0).cause, "suppressed by a wrong pose of its object");
  run_.judged[0].suppressed_by = 2;
  EXPECT_EQ(missed().at(0).cause, "suppressed by a right pose of another object that was itself rejected");
  run_.judged[0].suppressed_by = -1;
  EXPECT_EQ(missed().at(0).cause, "suppressed");
  run_.judged[0].probability = 0.4;
  EXPECT_EQ(missed().at(0).cause, "suppressed, too improbable anyway");
}

// A trace of the only truth in image 0 of scene 1 that came near at no stage.
TracedTruth farTrace() {
  TracedTruth traced;
  traced.scene = 1;
  traced.groupings = 7;
  traced.generated = 40;
  traced.taken = 60;
  traced.aligned = 70;
  traced.verified = 80;
  return traced;
}

TEST_F(Causes, ATracedObjectWasLostBehindTheLastStageThatCameNear) {
  MadeUpRun::truth(&run_.image(1, 0), 1, at(0, 0, 1000));
  traced_ = {farTrace()};
  TracedTruth& trace = traced_[0];
  const auto lostWith = [&](double& distance, double px, const std::string& cause) {
    distance = px;
    const MissedObject one = missed().at(0);
    EXPECT_EQ(one.cause, cause);
    EXPECT_EQ(one.lost.nearest_px, px) << cause;
    EXPECT_TRUE(one.traced.has_value());
    return one.lost.stage;
  };
  trace.groupings = 0;
  EXPECT_EQ(lostWith(trace.generated, 40, "no grouping of its own"), LostAt::kNoGrouping);

  trace.groupings = 7;
  EXPECT_EQ(lostWith(trace.generated, 39, "no hypothesis near"), LostAt::kNotGenerated);
  EXPECT_EQ(lostWith(trace.generated, 21, "ranked too low"), LostAt::kNotTaken);
  EXPECT_EQ(lostWith(trace.taken, 22, "not aligned"), LostAt::kNotAligned);
  EXPECT_EQ(lostWith(trace.aligned, 9, "aligned, not verified"), LostAt::kNotVerified);
  EXPECT_EQ(lostWith(trace.verified, 8, "not borne out by the image"), LostAt::kNotBorneOut);
  EXPECT_EQ(lostWith(trace.recorded, 7, "lost after the search"), LostAt::kNotKept);
}

TEST_F(Causes, HypothesesMustLieNearerToASmallObject) {
  // 35 px large; 173 px at 1 m.
  MadeUpRun::truth(&run_.image(1, 0), 1, at(0, 0, 5000));
  traced_ = {farTrace()};
  traced_[0].generated = 21;
  EXPECT_EQ(missed().at(0).lost.stage, LostAt::kNotGenerated);
  traced_[0].generated = 9;
  EXPECT_EQ(missed().at(0).lost.stage, LostAt::kNotTaken);
}

TEST_F(Causes, TheTraceOfAnotherObjectTellsNothing) {
  MadeUpRun::truth(&run_.image(1, 0), 1, at(0, 0, 1000));
  traced_.assign(3, farTrace());
  traced_[0].scene = 2;
  traced_[1].image = 1;
  traced_[2].truth = 1;
  EXPECT_EQ(missed().at(0).lost.stage, LostAt::kNotJudged);
  EXPECT_FALSE(missed().at(0).traced.has_value());
}

TEST_F(Causes, WhatWasJudgedInsteadStandsBesideWhereTheRightOneWasLost) {
  MadeUpRun::truth(&run_.image(1, 0), 1, at(0, 0, 1000));
  traced_ = {farTrace()};
  run_.judge(1, 0, 1, 0.3, at(15, 0, 1000), JudgedPose::kRejected);
  EXPECT_EQ(missed().at(0).cause, "no hypothesis near, one nearly right");
  Rigid3 turned = at(0, 0, 1000);
  turned.rotation = expSO3({0, 0, M_PI / 2});
  run_.judged[0].camera_from_object = turned;
  EXPECT_EQ(missed().at(0).cause, "no hypothesis near, one in its place in a wrong orientation");
}

TEST_F(Causes, ARightCandidateTellsMoreThanTheTrace) {
  MadeUpRun::truth(&run_.image(1, 0), 1, at(0, 0, 1000));
  traced_ = {farTrace()};
  run_.judge(1, 0, 1, 0.3, at(1, 0, 1000), JudgedPose::kRejected);
  EXPECT_EQ(missed().at(0).lost.stage, LostAt::kRejected);
  EXPECT_TRUE(missed().at(0).traced.has_value());
}

TEST_F(Causes, FoundAndHardlyVisibleObjectsAreNotMissed) {
  BopImage& image = run_.image(1, 0);
  MadeUpRun::truth(&image, 1, at(0, 0, 1000));
  MadeUpRun::truth(&image, 2, at(0, 0, 1000), 0.4);
  run_.row(1, 0, 1, 0.9, at(0, 0, 1000));
  EXPECT_TRUE(missed().empty());
}

TEST_F(Causes, LimitsNameThemselves) {
  SearchLimits limits;
  limits.min_distance = 0.25;
  limits.max_distance = 2.5;
  limits.min_size = 32;
  limits.min_in_frame = 0.4;
  for (const double z : {200.0, 1000.0, 3000.0}) MadeUpRun::truth(&run_.image(1, int(z)), 1, at(0, 0, z));
  const auto limitAt = [&](int image, const InFrame& in_frame = {}) {
    for (const MissedObject& one : missed(limits, in_frame))
      if (one.truth.image == image) return one.limit;
    return std::string("not missed");
  };
  EXPECT_EQ(limitAt(200), "nearer than min_distance: 0.2 m of 0.25 m");
  EXPECT_EQ(limitAt(3000), "farther than max_distance: 3 m of 2.5 m");
  EXPECT_EQ(limitAt(1000), "");
  EXPECT_EQ(limitAt(1000, [](const TruthOutcome&) { return 0.3; }),
            "less in the frame than min_in_frame: 0.3 of its contour of 0.4");
  limits.searched_scale = 0.125;  // 173 px are 21.7 px there
  EXPECT_EQ(limitAt(1000), "smaller than min_size: 21.7 px in the searched image of 32 px");

  limits.searched_scale = 1;
  const auto all = missed(limits);
  EXPECT_EQ(all[0].truth.image, 1000) << "what could have been found stands first";
  EXPECT_EQ(all[1].cause, "limit of the search: nearer than min_distance");
}

TEST_F(Causes, AWrongPoseNearItsObject) {
  const WrongAccept wrong = wrongBlock(at(15, 0, 1000));
  EXPECT_EQ(wrong.cause, WrongCause::kNearMiss);
  EXPECT_EQ(wrong.on, 0);
}

TEST_F(Causes, AWrongPoseThatIsATwin) {
  Rigid3 turned = at(0, 0, 1000);
  turned.rotation = expSO3({0, 0, M_PI / 2});
  const WrongAccept wrong = wrongBlock(turned);
  EXPECT_EQ(wrong.cause, WrongCause::kTwin);
  EXPECT_EQ(wrong.on, 0);
  EXPECT_NEAR(wrong.overlap, 1, 1e-3);
}

TEST_F(Causes, AWrongPoseThatIsTooSmall) {
  EXPECT_EQ(wrongBlock(at(0, 0, 1500)).cause, WrongCause::kMisplaced);
}

TEST_F(Causes, AWrongPoseOnAnotherObject) {
  const WrongAccept wrong = wrongBlock(at(145, 0, 1000));
  EXPECT_EQ(wrong.cause, WrongCause::kOtherObject);
  EXPECT_EQ(wrong.on, 1);
  EXPECT_GT(wrong.overlap, 0.9);
}

TEST_F(Causes, AWrongPoseOnClutter) {
  const WrongAccept wrong = wrongBlock(at(-180, 100, 1000));
  EXPECT_EQ(wrong.cause, WrongCause::kClutter);
  EXPECT_EQ(wrong.on, -1);
}

TEST_F(Causes, TheSurestWrongPoseStandsFirstAndFindsItsEvidence) {
  run_.image(1, 0);
  run_.row(1, 0, 1, 0.6, at(0, 0, 1000));
  run_.row(1, 0, 2, 0.8, at(0, 0, 1500));
  run_.judge(1, 0, 1, 0.1, at(0, 0, 1000), JudgedPose::kRejected);
  run_.judge(1, 0, 1, 0.6, at(0, 0, 1000), JudgedPose::kReported);
  const auto all = wrong();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].row.score, 0.8);
  EXPECT_EQ(all[0].judged, -1);
  EXPECT_EQ(all[1].judged, 1);
  const auto counts = causeCounts(all);
  ASSERT_EQ(counts.size(), 1u);
  EXPECT_EQ(counts[0].cause, "on clutter");
  EXPECT_EQ(counts[0].count, 2);

  run_.row(1, 0, 9, 0.7, at(0, 0, 1000));
  EXPECT_THROW(wrong(), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
