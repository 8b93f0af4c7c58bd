// What is asked of one recognition, what it refuses, and that the same question has the same answer.
#include <tbb/global_control.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "monocular_eye_hand/geometry/error.h"
#include "same_result.h"
#include "support/refusal.h"
#include "verified.h"
#include "world.h"

namespace monocular_eye_hand {
namespace {

using testing::AllOf;
using testing::HasSubstr;

RecognitionRequest onlyFor(const std::string& name) {
  RecognitionRequest request;
  request.only = name;
  return request;
}

Recognizer recognizerWith(const RecognitionOptions& options) { return {shippedModels(), options}; }

TEST(Only, TheWantedObjectIsFoundAndNoOtherReported) {
  const Picture picture = shippedPicture("demo/two_bridges_and_grenade");
  const RecognitionResult all = shippedRecognizer().recognize(picture.grey, picture.camera);
  for (const char* name : {"grenade", "bridge"}) {
    const RecognitionResult result =
        shippedRecognizer().recognize(picture.grey, picture.camera, onlyFor(name));
    ASSERT_FALSE(result.objects.empty()) << name << ": " << result.reason;
    for (const ObjectEstimate& o : result.objects) EXPECT_EQ(o.name, name);
    for (const ObjectEstimate& o : result.rejected) EXPECT_EQ(o.name, name);
    double nearest = 1e9;
    for (const TruthObject& truth : picture.truth)
      if (truth.name == name)
        nearest = std::min(nearest, poseError(shippedModel(name), picture.camera,
                                              result.objects[0].camera_from_object, truth.camera_from_object)
                                        .image);
    EXPECT_LT(nearest, 3) << name;
    EXPECT_LT(scored(result), scored(all) / 2) << name << ": the search did not stop early";
  }
}

TEST(Only, WhatIsNotThereIsNothingWithAReason) {
  const Picture picture = shippedPicture("golden/grenade");
  const RecognitionResult result =
      shippedRecognizer().recognize(picture.grey, picture.camera, onlyFor("bridge"));
  EXPECT_TRUE(result.objects.empty()) << listed(result);
  EXPECT_FALSE(result.reason.empty());
}

TEST(BadInputs, AnUnknownNameIsRefusedWithTheKnownOnes) {
  const Picture picture = shippedPicture("golden/bridge");
  EXPECT_THAT(
      refusal([&] { shippedRecognizer().recognize(picture.grey, picture.camera, onlyFor("brigde")); }),
      AllOf(HasSubstr("brigde"), HasSubstr("bridge"), HasSubstr("grenade"), HasSubstr("frame"),
            HasSubstr("flange"), HasSubstr("bracket")));
}

TEST(BadInputs, AnEmptyModelBaseOrABadOptionIsRefusedAtOnce) {
  EXPECT_THAT(refusal([] { Recognizer(ModelBase{}); }), HasSubstr("model base is empty"));
  RecognitionOptions options;
  options.accept_probability = 2;
  EXPECT_THAT(refusal([&] { recognizerWith(options); }), HasSubstr("accept_probability"));
}

TEST(BadInputs, ImagesThatAreEmptyColouredDeepOrOfAnotherSizeAreRefused) {
  const Camera camera = testCamera();
  const auto refusalOf = [&](const cv::Mat& image) {
    return refusal([&] { shippedRecognizer().recognize(image, camera); });
  };
  EXPECT_THAT(refusalOf({}), HasSubstr("empty"));
  EXPECT_THAT(refusalOf(cv::Mat(480, 640, CV_8UC3, cv::Scalar(9, 9, 9))), HasSubstr("8-bit grey"));
  EXPECT_THAT(refusalOf(cv::Mat(480, 640, CV_16UC1, cv::Scalar(9))), HasSubstr("8-bit grey"));
  EXPECT_THAT(refusalOf(cv::Mat(640, 480, CV_8UC1, cv::Scalar(9))),
              AllOf(HasSubstr("480 x 640"), HasSubstr("640 x 480")));
}

TEST(BadInputs, ACameraWithoutCalibrationIsRefused) {
  const cv::Mat image(480, 640, CV_8UC1, cv::Scalar(100));
  const auto refusalOf = [&](auto&& spoil) {
    Camera camera = testCamera();
    spoil(&camera);
    return refusal([&] { shippedRecognizer().recognize(image, camera); });
  };
  EXPECT_THAT(refusalOf([](Camera* c) { c->fx = 0; }), HasSubstr("fx"));
  EXPECT_THAT(refusalOf([](Camera* c) { c->fy = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("fy"));
  EXPECT_THAT(refusalOf([](Camera* c) { c->cx = -100; }), HasSubstr("cx"));
  EXPECT_THAT(refusalOf([](Camera* c) { c->width = 0; }), HasSubstr("width"));
}

TEST(SameQuestion, SameAnswerBitByBitAgainAndFromTwoThreadsAtOnce) {
  const Picture picture = shippedPicture("demo/two_bridges_and_grenade");
  const RecognitionResult first = shippedRecognizer().recognize(picture.grey, picture.camera);
  ASSERT_FALSE(first.objects.empty());
  RecognitionResult left, right;
  std::thread other([&] { left = shippedRecognizer().recognize(picture.grey, picture.camera); });
  right = shippedRecognizer().recognize(picture.grey, picture.camera);
  other.join();
  expectSame(first, left);
  expectSame(first, right);
}

TEST(SameQuestion, SameAnswerBitByBitOnAnyNumberOfThreads) {
  const Picture picture = shippedPicture("demo/frame_and_flange");
  RecognitionOptions options;
  options.threads = 1;
  const RecognitionResult alone = recognizerWith(options).recognize(picture.grey, picture.camera);
  ASSERT_FALSE(alone.objects.empty());
  for (int threads : {2, 7}) {
    options.threads = threads;
    const Recognizer shared = recognizerWith(options);
    expectSame(alone, shared.recognize(picture.grey, picture.camera));
    expectSame(alone, shared.recognize(picture.grey, picture.camera));
  }
}

TEST(Threads, TheRayTracerLeavesThemToTheRecogniser) {
  ASSERT_FALSE(shippedRecognizer().models().objects.empty());  // with their ray scenes
  EXPECT_GE(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism),
            std::thread::hardware_concurrency());
}

TEST(SameQuestion, SameAnswerBitByBitOnAnyNumberOfThreadsWithABudgetOrOneWantedObject) {
  const Picture picture = shippedPicture("demo/two_bridges_and_grenade");
  RecognitionOptions alone;
  alone.threads = 1;
  alone.budget = 100000;
  RecognitionOptions shared = alone;
  shared.threads = 3;
  for (const RecognitionRequest& request : {RecognitionRequest{}, onlyFor("grenade")})
    expectSame(recognizerWith(alone).recognize(picture.grey, picture.camera, request),
               recognizerWith(shared).recognize(picture.grey, picture.camera, request));
}

TEST(SameQuestion, TheImageMayBeAPartOfALargerOne) {
  const Picture picture = shippedPicture("golden/bracket");
  cv::Mat framed;
  cv::copyMakeBorder(picture.grey, framed, 10, 20, 30, 40, cv::BORDER_CONSTANT, 255);
  const cv::Mat view = framed(cv::Rect(30, 10, picture.grey.cols, picture.grey.rows));
  ASSERT_FALSE(view.isContinuous());
  expectSame(shippedRecognizer().recognize(picture.grey, picture.camera),
             shippedRecognizer().recognize(view, picture.camera));
}

TEST(Budget, BoundsTheWorkAndAnswersTheSameEachTime) {
  const Picture picture = shippedPicture("golden/bridge");
  const RecognitionResult whole = shippedRecognizer().recognize(picture.grey, picture.camera);
  RecognitionOptions options;
  options.budget = int(scored(whole) / 4);
  const Recognizer limited = recognizerWith(options);
  const RecognitionResult once = limited.recognize(picture.grey, picture.camera);
  expectSame(once, limited.recognize(picture.grey, picture.camera));
  EXPECT_LT(scored(once), scored(whole) / 2);
  EXPECT_TRUE(once.budget_spent);
  EXPECT_FALSE(whole.budget_spent);
  EXPECT_FALSE(once.truncated) << "only the wall clock makes results that may differ";
}

TEST(Budget, IsDealtOutToAllObjectsWhateverTheirOrder) {
  for (const char* name :
       {"golden/bridge", "golden/flange", "golden/bracket"}) {  // first and last of the base
    const Picture picture = shippedPicture(name);
    RecognitionOptions options;
    options.budget = 60000;
    const RecognitionResult result = recognizerWith(options).recognize(picture.grey, picture.camera);
    ASSERT_EQ(result.objects.size(), 1u) << name << "\n" << listed(result);
    EXPECT_EQ(result.objects[0].name, picture.truth.at(0).name);
  }
}

TEST(Budget, ATinyOneEndsEarly) {
  const Picture picture = shippedPicture("golden/bridge");
  RecognitionOptions options;
  options.budget = 1;
  const RecognitionResult result = recognizerWith(options).recognize(picture.grey, picture.camera);
  EXPECT_LT(scored(result), 1000);
  EXPECT_TRUE(result.budget_spent);
  ASSERT_TRUE(result.objects.empty());
  EXPECT_THAT(result.reason, HasSubstr("the budget of 1 hypotheses was spent"));
}

TEST(TimeLimit, CutsTheSearchAndSaysSo) {
  const Picture picture = shippedPicture("demo/frame_and_flange");
  RecognitionOptions options;
  options.time_limit = 1e-6;
  const RecognitionResult result = recognizerWith(options).recognize(picture.grey, picture.camera);
  EXPECT_TRUE(result.truncated);
  EXPECT_EQ(scored(result), 0);
  EXPECT_TRUE(result.objects.empty());
  EXPECT_THAT(result.reason, HasSubstr("time limit"));
}

TEST(TimeLimit, AGenerousOneChangesNothing) {
  const Picture picture = shippedPicture("golden/bracket");
  RecognitionOptions options;
  options.time_limit = 3600;
  expectSame(recognizerWith(options).recognize(picture.grey, picture.camera),
             shippedRecognizer().recognize(picture.grey, picture.camera));
}

RecognitionRequest judgedToo() {
  RecognitionRequest request;
  request.judged = true;
  return request;
}

// Index of the candidate that suppresses each one, -1: chosen. As JudgedCandidate says.
std::vector<int> chosenAgain(const std::vector<JudgedCandidate>& judged) {
  std::vector<int> order(judged.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return judged[a].rank_score > judged[b].rank_score; });

  std::vector<int> chosen, suppressed_by(judged.size(), -1);
  for (int i : order) {
    const std::vector<int>& conflicts = judged[i].conflicts;
    const auto winner = std::find_if(chosen.begin(), chosen.end(), [&](int c) {
      return std::binary_search(conflicts.begin(), conflicts.end(), c);
    });
    if (winner == chosen.end())
      chosen.push_back(i);
    else
      suppressed_by[i] = *winner;
  }
  return suppressed_by;
}

class JudgedOn : public testing::TestWithParam<const char*> {
 protected:
  // Recognised once for all tests.
  static const RecognitionResult& judgedResult(const std::string& path) {
    static std::map<std::string, RecognitionResult> results;
    const auto known = results.find(path);
    if (known != results.end()) return known->second;
    const Picture picture = shippedPicture(path);
    return results[path] = shippedRecognizer().recognize(picture.grey, picture.camera, judgedToo());
  }
  const RecognitionResult& result_ = judgedResult(GetParam());
};

TEST_P(JudgedOn, AskingForTheCandidatesChangesNoAnswer) {
  const Picture picture = shippedPicture(GetParam());
  const RecognitionResult plain = shippedRecognizer().recognize(picture.grey, picture.camera);
  expectSame(plain, result_);
  EXPECT_TRUE(plain.judged.empty());
  EXPECT_GT(result_.judged.size(), result_.objects.size() + result_.rejected.size());
}

TEST_P(JudgedOn, TheChoiceCanBeMadeAgain) {
  const std::vector<int> suppressed_by = chosenAgain(result_.judged);
  for (size_t i = 0; i < result_.judged.size(); ++i)
    EXPECT_EQ(result_.judged[i].suppressed_by, suppressed_by[i]) << i;
}

TEST_P(JudgedOn, TheChosenOnesAreThoseThatAreReported) {
  std::vector<const ObjectEstimate*> reported;
  for (const auto* objects : {&result_.objects, &result_.rejected})
    for (const ObjectEstimate& object : *objects) reported.push_back(&object);

  size_t chosen = 0;
  for (const JudgedCandidate& judged : result_.judged) {
    EXPECT_EQ(judged.fate == Fate::kSuppressed, judged.suppressed_by >= 0);
    if (judged.fate == Fate::kSuppressed) continue;
    ++chosen;
    const auto same = std::find_if(reported.begin(), reported.end(), [&](const ObjectEstimate* object) {
      return object->camera_from_object.translation == judged.camera_from_object.translation &&
             object->camera_from_object.rotation == judged.camera_from_object.rotation;
    });
    ASSERT_NE(same, reported.end()) << judged.name;
    EXPECT_EQ((*same)->object, judged.object);
    EXPECT_EQ((*same)->name, judged.name);
    EXPECT_EQ((*same)->probability, judged.probability);
    EXPECT_EQ((*same)->plausibility, judged.plausibility);
    EXPECT_EQ((*same)->reliability, judged.reliability);
    EXPECT_EQ((*same)->evidence, judged.evidence);
    EXPECT_EQ(toString((*same)->decision), toString(judged.fate));
    EXPECT_EQ((*same)->spoke_against.empty(), judged.strongest_against.empty());
    if (!judged.strongest_against.empty()) {
      EXPECT_THAT((*same)->spoke_against.front(), testing::StartsWith(judged.strongest_against + " "));
    }
  }
  EXPECT_EQ(chosen, reported.size());
}

TEST_P(JudgedOn, RankScoresAreWhatTheHeaderSays) {
  for (const JudgedCandidate& judged : result_.judged) {
    const double score =
        std::sqrt(judged.evidence.at("sum")) * (judged.probability / judged.winners_share + 0.05);
    EXPECT_NEAR(judged.rank_score, score, 1e-9 * std::abs(score));
    EXPECT_FALSE(judged.kind.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Pictures, JudgedOn,
                         testing::Values("demo/two_bridges_and_grenade", "demo/nothing_known"),
                         [](const auto& info) { return std::string(info.param).substr(5); });

// A part of a third of the size at a third of the distance gives the same image.
TEST(Options, SmallPartsAreFoundFromNear) {
  const Picture picture = shippedPicture("golden/grenade");  // stands at 0.45 m
  const ObjectModel& full_size = shippedModel("grenade");
  Mesh mesh = full_size.mesh;
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex /= 3;
  ModelBase models;
  models.objects.push_back(known("small grenade", mesh));
  const RecognitionResult result = Recognizer(models, {}).recognize(picture.grey, picture.camera);
  ASSERT_EQ(result.objects.size(), 1u) << result.reason;
  const Eigen::Vector3d centre = result.objects[0].camera_from_object * models.objects[0].model.centre();
  const Eigen::Vector3d truth = picture.truth.at(0).camera_from_object * full_size.centre() / 3;
  EXPECT_LT((centre - truth).norm(), 0.002);
}

TEST(Options, NothingIsLookedForNearerThanItsDiameter) {
  RecognitionOptions options;
  EXPECT_EQ(options.nearest(0.02), options.min_distance);
  EXPECT_EQ(options.nearest(0.3), 0.3);
}

TEST(Options, DistancesAndSizesThatAreNotConsideredAreNotFound) {
  const Picture picture = shippedPicture("golden/grenade");  // stands at 0.45 m
  RecognitionOptions far;
  far.min_distance = 0.7;
  far.max_distance = 2;
  for (const ObjectEstimate& o : recognizerWith(far).recognize(picture.grey, picture.camera).objects)
    EXPECT_GE(o.camera_from_object.translation.norm(), 0.6);
  RecognitionOptions strict;
  strict.accept_probability = 0.99999;
  const RecognitionResult doubted = recognizerWith(strict).recognize(picture.grey, picture.camera);
  EXPECT_TRUE(doubted.objects.empty());
  ASSERT_FALSE(doubted.rejected.empty());
  EXPECT_THAT(doubted.reason, HasSubstr(doubted.rejected[0].name));
}

}  // namespace
}  // namespace monocular_eye_hand
