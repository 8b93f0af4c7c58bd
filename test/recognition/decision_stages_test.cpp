// What stands between the search and the verdict: proposals, nearby poses, twins, hidden parts, larger sizes
// of the image.
#include <limits>
#include <opencv2/imgproc.hpp>

#include "model/build_model.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/simulation/render/render.h"
#include "recognition/hypotheses.h"
#include "recognition/judging.h"
#include "recognition/nearby_poses.h"
#include "recognition/occlusion.h"
#include "recognition/twins.h"
#include "support/camera.h"
#include "verified.h"

namespace monocular_eye_hand {
namespace {

int indexOf(const std::string& name) { return shippedModels().indexOf(name); }

RecognitionRequest proposing(const std::string& name, const Rigid3& pose) {
  RecognitionRequest request;
  request.proposals = std::vector<PoseProposal>{{indexOf(name), pose}};
  return request;
}

// The search of a picture for one of the shipped models.
struct SearchOf {
  SearchOf(const std::string& name, const Picture& picture)
      : image(looked(picture.grey, picture.camera)), wanted{indexOf(name)} {
    for (const KnownObject& object : shippedModels().objects) models.emplace_back(object);
  }

  const RecognitionOptions options;
  const SearchImage image;
  std::vector<SearchModel> models;
  const std::vector<int> wanted;
  const SearchTask task{image, models, wanted, options};
};

// How near the best of the hypotheses from so many segments comes to the picture's object [px].
double nearestFromSegments(const std::string& name, const Picture& picture, size_t max_segments) {
  const SearchOf search(name, picture);
  const int object = search.wanted[0];
  HypothesisPool pool(search.task, object);
  WorkBudget no_limit;
  const std::vector<char> all(search.image.features.segments.size(), 1);
  hypothesesFromEdges(search.task, object, mostTellingSegments(search.image, all, max_segments), &pool,
                      &no_limit);

  double nearest = std::numeric_limits<double>::max();
  for (const Hypothesis& h : pool.take(100))
    nearest = std::min(nearest, poseError(shippedModel(name), picture.camera, h.camera_from_object,
                                          picture.truth.at(0).camera_from_object)
                                    .image);
  return nearest;
}

TEST(HypothesesFromEdges, FewSegmentsSufficeThatTellMost) {
  const Picture picture = shippedPicture("golden/bracket");
  EXPECT_EQ(nearestFromSegments("bracket", picture, 0), std::numeric_limits<double>::max());
  EXPECT_LT(nearestFromSegments("bracket", picture, 30), 15);
}

TEST(Proposals, AreJudgedInsteadOfSearching) {
  const Picture picture = shippedPicture("golden/bracket");
  const Rigid3 truth = picture.truth.at(0).camera_from_object;
  Rigid3 near = truth;
  near.translation.x() += 0.001;
  const RecognitionResult result =
      shippedRecognizer().recognize(picture.grey, picture.camera, proposing("bracket", near));
  ASSERT_EQ(result.objects.size(), 1u) << listed(result);
  EXPECT_LT(
      poseError(shippedModel("bracket"), picture.camera, result.objects[0].camera_from_object, truth).image,
      2);
  for (const StageReport& stage : result.stages) EXPECT_NE(stage.name, "hypotheses from groupings");
}

TEST(Proposals, ThatNothingBearsOutAreNotReported) {
  const Picture picture = shippedPicture("golden/bracket");
  Rigid3 away = picture.truth.at(0).camera_from_object;
  away.translation.x() += 0.12;
  EXPECT_THAT(shippedRecognizer().recognize(picture.grey, picture.camera, proposing("bracket", away)).objects,
              testing::IsEmpty());
  RecognitionRequest none;
  none.proposals.emplace();
  EXPECT_THAT(shippedRecognizer().recognize(picture.grey, picture.camera, none).objects, testing::IsEmpty());
}

TEST(Proposals, OfAnUnknownObjectAreRefused) {
  const Picture picture = shippedPicture("golden/bracket");
  RecognitionRequest request;
  request.proposals = std::vector<PoseProposal>{{17, Rigid3{}}};
  EXPECT_THROW(shippedRecognizer().recognize(picture.grey, picture.camera, request), BadInput);
}

TEST(BoxTurns, LeaveTheBoxWhereItIsAndAreNoSymmetries) {
  const auto frame = size_t(indexOf("frame"));
  EXPECT_THAT(SearchModel(shippedModels().objects.at(frame)).boxRotations(), testing::IsEmpty())
      << "all its half turns are symmetries";
  for (const char* name : {"bridge", "grenade", "flange", "bracket"}) {
    const SearchModel model(shippedModels().objects.at(size_t(indexOf(name))));
    const Symmetries& symmetries = model.model().symmetries;
    EXPECT_GE(model.boxRotations().size(), 1u) << name;
    for (const Rigid3& turn : model.boxRotations()) {
      EXPECT_LT((turn * model.model().centre() - model.model().centre()).norm(), 1e-9) << name;
      const Rigid3 equal = nearestEqualPose(model.model(), turn, Rigid3{});
      EXPECT_GT(angleBetween(equal.rotation, Eigen::Matrix3d::Identity()), 0.1)
          << name << " has this symmetry";
    }
    if (symmetries.axis) {
      EXPECT_EQ(model.boxRotations().size(), 1u) << name << ": only the flip is a twin";
    }
  }
}

TEST(Twins, OfAPoseThatIsWrongByAHalfTurnTheRightOneIsFound) {
  const Picture picture = shippedPicture("golden/bracket");
  const ObjectModel& bracket = shippedModel("bracket");
  const Rigid3 truth = picture.truth.at(0).camera_from_object;
  const Rigid3 turned =
      truth *
      rotationAbout(bracket.centre(), Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()).toRotationMatrix());

  const SearchOf search("bracket", picture);
  Candidate wrong;
  wrong.object = indexOf("bracket");
  wrong.pose.camera_from_object = turned;
  wrong.probability = 0.6;
  StageLog log;
  const std::vector<Candidate> all = addTwins(search.task, {{wrong}, {Explanation{0, {}}}}, &log);
  ASSERT_GE(all.size(), 2u);
  const bool found = std::any_of(all.begin() + 1, all.end(), [&](const Candidate& c) {
    return poseError(bracket, picture.camera, c.pose.camera_from_object, truth).image < 3;
  });
  EXPECT_TRUE(found);

  wrong.probability = 0.01;
  EXPECT_EQ(addTwins(search.task, {{wrong}, {Explanation{0, {}}}}, &log).size(), 1u) << "not worth it";
}

TEST(NearbyPoses, ADoubtfulCandidateThatIsTiltedGivesWayToTheRightPose) {
  const Picture picture = shippedPicture("golden/bracket");
  const ObjectModel& bracket = shippedModel("bracket");
  const Rigid3 truth = picture.truth.at(0).camera_from_object;
  const Eigen::AngleAxisd tilt(0.15, Eigen::Vector3d(0.6, 0.8, 0));
  const Rigid3 tilted = truth * rotationAbout(bracket.centre(), tilt.toRotationMatrix());

  const SearchOf search("bracket", picture);
  Candidate doubt;
  doubt.object = indexOf("bracket");
  doubt.pose.camera_from_object = tilted;
  doubt.kind = GroupingKind::kQuad;
  doubt.probability = 0.3;
  StageLog log;
  const std::vector<Candidate> found = tryNearbyPoses(search.task, {doubt}, &log);
  ASSERT_EQ(found.size(), 1u) << "it gives way, nothing is added";
  EXPECT_LT(poseError(bracket, picture.camera, found[0].pose.camera_from_object, truth).image, 2);
  EXPECT_GT(found[0].probability, 0.5);
  EXPECT_EQ(found[0].kind, GroupingKind::kQuad) << "what it came from stays known";

  for (double probability : {0.01, 0.99}) {
    doubt.probability = probability;
    EXPECT_EQ(tryNearbyPoses(search.task, {doubt}, &log)[0].pose.camera_from_object.rotation, tilted.rotation)
        << probability << " is no doubt";
  }
}

// A bracket behind a box that hides a part of it.
TEST(HiddenParts, AreNotHeldAgainstWhatLiesBehind) {
  const Rigid3 world_from_camera = lookFrom(-M_PI / 2, 0.45, 0.6, {0, 0, 0.03});
  const Mesh box = boxMesh({0.03, 0.02, 0.05});
  SceneObject before = standing("box", box);
  before.world_from_object.translation = {-0.03, -0.08, 0};
  Scene scene = plainScene({standing("bracket", shippedModel("bracket").mesh), before}, world_from_camera);
  scene.table.material = {0.2, 0.0, 20, {}};
  RenderOptions render;
  render.shadows = false;
  const SearchImage image = looked(renderScene(scene, testCamera(), render).grey, testCamera());

  const ObjectModel box_model = buildModel("box", box);
  const SearchModel bracket(shippedModels().objects.at(size_t(indexOf("bracket"))));
  Candidate candidate;
  candidate.pose.camera_from_object = bracket.canonical(world_from_camera.inverse(), &candidate.view);
  verify(bracket, image, &candidate);
  const EvidenceTerms seen = candidate.terms;
  const Rigid3 camera_from_box = world_from_camera.inverse() * before.world_from_object;
  candidate.occluders = {{&box_model, camera_from_box.inverse(), cv::Rect(0, 0, 640, 480)}};
  verify(bracket, image, &candidate);
  const EvidenceTerms excused = candidate.terms;

  EXPECT_EQ(seen.hidden, 0);
  EXPECT_GT(excused.hidden, 0.05);
  EXPECT_LT(excused.hidden, 0.5);
  EXPECT_GT(excused.hit_ratio, seen.hit_ratio + 0.03);
  EXPECT_NEAR(excused.in_frame, 1, 1e-9);
  EXPECT_GT(candidate.contour.size(), 0u);
  EXPECT_TRUE(candidate.occluders[0].hides(
      testCamera(), testCamera().project(camera_from_box * Eigen::Vector3d(0, 0, 0.025)), 2));
  EXPECT_FALSE(candidate.occluders[0].hides(
      testCamera(), testCamera().project(camera_from_box * Eigen::Vector3d(0, 0, 0.025)), 0.3));
}

RecognitionResult searchedAtHalfSize(const cv::Mat& grey, const Camera& camera) {
  RecognitionOptions options;
  options.search_width = camera.width / 2;
  return Recognizer(someModels({"bracket"}), options).recognize(grey, camera);
}

TEST(FinerLevels, WhatWasSearchedAtHalfSizeIsDecidedInFull) {
  const Picture picture = shippedPicture("golden/bracket");
  const Camera camera = picture.camera.resized(2);
  Scene scene = plainScene({standing("bracket", shippedModel("bracket").mesh)},
                           lookFrom(-1.1, 0.75, 0.45, {0, 0, 0.02}));
  const cv::Mat sharp = renderScene(scene, camera).grey;
  const RecognitionResult result = searchedAtHalfSize(sharp, camera);
  ASSERT_EQ(result.objects.size(), 1u) << listed(result);
  EXPECT_EQ(result.features.camera.width, camera.width / 2) << "the features are those of the search";
  const double diameter = shippedModel("bracket").diameter * camera.fx /
                          (result.objects[0].camera_from_object * shippedModel("bracket").centre()).norm();
  EXPECT_NEAR(result.objects[0].evidence.at("diameter"), diameter, 1) << "not seen in full";

  cv::Mat blurred;
  cv::GaussianBlur(sharp, blurred, {}, 5);
  const RecognitionResult small = searchedAtHalfSize(blurred, camera);
  ASSERT_FALSE(small.objects.empty() && small.rejected.empty());
  const ObjectEstimate& best = small.objects.empty() ? small.rejected[0] : small.objects[0];
  EXPECT_GT(best.bounding_box.area(), 0);
}

TEST(FinerLevels, ReductionsAreWholeNumbers) {
  for (const auto& [width, reduction] :
       {std::pair(640, 1), {960, 1}, {961, 2}, {1280, 2}, {1920, 2}, {2592, 3}, {4000, 5}})
    EXPECT_EQ(searchReduction(width, 960), reduction) << width;
}

TEST(FinerLevels, FindPartsThatTheSearchAtHalfSizeCannotSee) {
  const Camera camera = centredCamera(1280, 960, 900);
  const ObjectModel& bracket = shippedModel("bracket");
  const double distance = bracket.diameter * camera.fx / 44;  // 22 px wide in half
  ASSERT_LT(distance, RecognitionOptions().max_distance);
  const Scene scene =
      plainScene({standing("bracket", bracket.mesh)}, lookFrom(-1.1, 0.75, distance, {0, 0, 0.02}));
  const RenderedImage image = renderScene(scene, camera);
  const std::vector<TruthObject> truth = truthOf(scene, image);
  ASSERT_EQ(truth.size(), 1u);

  const Recognizer recognizer(someModels({"bracket", "bridge"}));
  const RecognitionResult result = recognizer.recognize(image.grey, camera);
  ASSERT_EQ(result.objects.size(), 1u) << listed(result);
  EXPECT_LT(
      poseError(bracket, camera, result.objects[0].camera_from_object, truth[0].camera_from_object).image, 4);

  cv::Mat half;
  cv::resize(image.grey, half, {}, 0.5, 0.5, cv::INTER_AREA);
  EXPECT_THAT(recognizer.recognize(half, camera.resized(0.5)).objects, testing::IsEmpty());
}

// How many of the picture's objects are found within 4 px of its own size.
int foundOf(const Picture& picture, int enlarged) {
  const Camera camera = picture.camera.resized(enlarged);
  cv::Mat grey;
  cv::resize(picture.grey, grey, cv::Size(camera.width, camera.height), 0, 0, cv::INTER_LINEAR);
  const RecognitionResult result = shippedRecognizer().recognize(grey, camera);
  int found = 0;
  for (const TruthObject& truth : picture.truth)
    found += std::any_of(result.objects.begin(), result.objects.end(), [&](const ObjectEstimate& object) {
      return object.name == truth.name && poseError(shippedModel(object.name), picture.camera,
                                                    object.camera_from_object, truth.camera_from_object)
                                                  .image < 4;
    });
  return found;
}

TEST(FinerLevels, AreNotTakenWhereTheyResolveNoMore) {
  for (const char* name : {"demo/two_bridges_and_grenade", "demo/frame_and_flange"}) {
    const Picture picture = shippedPicture(name);
    ASSERT_GT(foundOf(picture, 1), 1) << name;
    EXPECT_GE(foundOf(picture, 2), foundOf(picture, 1)) << name;
  }
}

}  // namespace
}  // namespace monocular_eye_hand
