// How near the search comes to poses that are known, and that nobody notices when it is asked.
#include <limits>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/geometry/error.h"
#include "recognition/explained_features.h"
#include "same_result.h"
#include "world.h"

namespace monocular_eye_hand {
namespace {

constexpr double kNone = PoseTrace::kNone;

std::vector<PoseProposal> truePoses(const Picture& picture) {
  std::vector<PoseProposal> poses;
  for (const TruthObject& truth : picture.truth)
    poses.push_back({shippedModels().indexOf(truth.name), truth.camera_from_object});
  return poses;
}

RecognitionResult traced(const Picture& picture, const std::vector<PoseProposal>& poses) {
  RecognitionRequest request;
  request.traced = poses;
  return shippedRecognizer().recognize(picture.grey, picture.camera, request);
}

// The picture twice as large, which is wider than what is searched.
Picture enlarged(Picture picture) {
  cv::resize(picture.grey, picture.grey, {}, 2, 2, cv::INTER_CUBIC);
  picture.camera = picture.camera.resized(2);
  return picture;
}

void expectAllStagesWithin(const PoseTrace& trace, double px) {
  EXPECT_GT(trace.groupings, 0);
  EXPECT_LT(trace.generated, px);
  EXPECT_LT(trace.taken, px);
  EXPECT_LT(trace.aligned, px);
  EXPECT_LT(trace.verified, px);
  EXPECT_LT(trace.recorded, px);
}

TEST(SearchTrace, ChangesNoAnswerAndShowsTheWayOfWhatIsFound) {
  const Picture picture = shippedPicture("demo/two_bridges_and_grenade");
  const std::vector<PoseProposal> poses = truePoses(picture);
  const RecognitionResult result = traced(picture, poses);
  expectSame(shippedRecognizer().recognize(picture.grey, picture.camera), result);

  ASSERT_EQ(result.traces.size(), poses.size());
  for (const PoseTrace& trace : result.traces) expectAllStagesWithin(trace, 10);
}

TEST(SearchTrace, OfAStageNothingCanBeNearerThanOfThoseThatItChoosesFrom) {
  const Picture picture = shippedPicture("demo/two_bridges_and_grenade");
  for (const PoseTrace& trace : traced(picture, truePoses(picture)).traces) {
    EXPECT_LE(trace.generated, trace.taken);
    EXPECT_LE(trace.verified, trace.recorded);
  }
}

TEST(SearchTrace, WhereNothingIsTheNearestIsFar) {
  const Picture picture = shippedPicture("golden/grenade");
  Rigid3 elsewhere = picture.truth.at(0).camera_from_object;
  elsewhere.translation = {0.12, 0.1, 0.6};  // where the ground is bare
  const RecognitionResult result = traced(picture, {{shippedModels().indexOf("grenade"), elsewhere}});
  ASSERT_EQ(result.traces.size(), 1u);
  EXPECT_EQ(result.traces[0].groupings, 0);
  EXPECT_GT(result.traces[0].aligned, 20);
  EXPECT_GT(result.traces[0].recorded, 20);
}

TEST(SearchTrace, AnObjectThatIsNotWantedComesNowhere) {
  const Picture picture = shippedPicture("golden/bridge");
  RecognitionRequest request;
  request.only = "grenade";
  request.traced = truePoses(picture);
  const RecognitionResult result = shippedRecognizer().recognize(picture.grey, picture.camera, request);
  ASSERT_EQ(result.traces.size(), 1u);
  EXPECT_GT(result.traces[0].groupings, 0) << "its features are there";
  EXPECT_EQ(result.traces[0].generated, kNone);
  EXPECT_EQ(result.traces[0].recorded, kNone);
}

TEST(SearchTrace, DistancesAreInPixelsOfTheImageGiven) {
  const Picture small = shippedPicture("golden/bridge");
  const Picture large = enlarged(small);
  ASSERT_GT(large.camera.width, RecognitionOptions().search_width);
  const std::vector<PoseProposal> poses = truePoses(small);
  const RecognitionResult result = traced(large, poses);
  expectSame(shippedRecognizer().recognize(large.grey, large.camera), result);
  ASSERT_EQ(result.traces.size(), 1u);
  expectAllStagesWithin(result.traces[0], 20);

  // The images searched are nearly the same, a pose displaced by this much is as far off in both.
  PoseProposal displaced = poses[0];
  displaced.camera_from_object.translation.x() += 0.05;
  const double in_small = traced(small, {displaced}).traces.at(0).recorded;
  const double in_large = traced(large, {displaced}).traces.at(0).recorded;
  ASSERT_LT(in_small, 1000);
  EXPECT_NEAR(in_large / in_small, 2, 0.2);
}

TEST(SearchTrace, WithoutASearchNothingIsKnown) {
  const Picture picture = shippedPicture("golden/bridge");
  RecognitionRequest request;
  request.traced = truePoses(picture);
  request.proposals = request.traced;
  const RecognitionResult result = shippedRecognizer().recognize(picture.grey, picture.camera, request);
  EXPECT_FALSE(result.objects.empty());
  EXPECT_TRUE(result.traces.empty());
}

TEST(SearchTrace, PosesThatCannotBeTracedAreRefused) {
  const Picture picture = shippedPicture("golden/bridge");
  PoseProposal pose = truePoses(picture).at(0);
  EXPECT_THROW(traced(picture, {{int(shippedModels().objects.size()), pose.camera_from_object}}), BadInput);
  EXPECT_THROW(traced(picture, {{-1, pose.camera_from_object}}), BadInput);
  pose.camera_from_object.translation.z() = -1;
  EXPECT_THROW(traced(picture, {pose}), BadInput);
}

// Two traces of ten points; a segment of the first one, and an ellipse of two arcs, one on each.
class Explained : public testing::Test {
 protected:
  Explained() {
    features_.points.resize(20);
    features_.traces = {{0, 10, false}, {10, 10, false}};
    features_.arcs.resize(2);
    features_.arcs[0].first = 0;
    features_.arcs[0].count = 10;
    features_.arcs[1].first = 10;
    features_.arcs[1].count = 10;
    features_.ellipse_arcs = {0, 1};
    segment_.first = 0;
    segment_.count = 10;
    ellipse_.first_arc = 0;
    ellipse_.arc_count = 2;
  }

  FeatureSet features_;
  LineSegment segment_;
  DetectedEllipse ellipse_;
};

TEST_F(Explained, AClaimedPointAnswersForItsNeighboursOnItsTrace) {
  const std::vector<char> explained = explainedPoints(features_, {8});
  for (int i = 0; i < 20; ++i) EXPECT_EQ(bool(explained[size_t(i)]), i >= 5 && i < 10) << i;
}

TEST_F(Explained, AFeatureIsExplainedWhenMostOfItsPointsAre) {
  EXPECT_TRUE(isExplained(segment_, explainedPoints(features_, {3})));    // 0 to 6
  EXPECT_FALSE(isExplained(segment_, explainedPoints(features_, {2})));   // 0 to 5
  EXPECT_FALSE(isExplained(segment_, explainedPoints(features_, {13})));  // on the other trace
  EXPECT_TRUE(isExplained(features_, ellipse_, explainedPoints(features_, {3, 13})));
  EXPECT_FALSE(isExplained(features_, ellipse_, explainedPoints(features_, {3, 4, 5})));
  EXPECT_FALSE(isExplained(features_, DetectedEllipse(), explainedPoints(features_, {})));
}

}  // namespace
}  // namespace monocular_eye_hand
