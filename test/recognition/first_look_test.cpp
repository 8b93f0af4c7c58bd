// A large model base: what a first look at the image leaves to be searched for to the end.
#include "recognition/first_look.h"

#include <algorithm>

#include "same_result.h"
#include "verified.h"
#include "world.h"

namespace monocular_eye_hand {
namespace {

using testing::UnorderedElementsAre;

RecognitionResult recognized(const Picture& picture, int thorough_models) {
  RecognitionOptions options;
  options.thorough_models = thorough_models;
  return Recognizer(shippedModels(), options).recognize(picture.grey, picture.camera);
}

const StageReport* stage(const RecognitionResult& result, const std::string& name) {
  const auto it = std::find_if(result.stages.begin(), result.stages.end(),
                               [&](const StageReport& report) { return report.name == name; });
  return it == result.stages.end() ? nullptr : &*it;
}

std::vector<std::string> names(const RecognitionResult& result) {
  std::vector<std::string> all;
  for (const ObjectEstimate& o : result.objects) all.push_back(o.name);
  return all;
}

TEST(FirstLook, ASmallBaseIsSearchedWithoutOne) {
  const Picture picture = shippedPicture("demo/frame_and_flange");
  EXPECT_EQ(stage(shippedRecognizer().recognize(picture.grey, picture.camera), "first look"), nullptr);
}

TEST(FirstLook, WhatIsInTheImageIsWhatItFindsPromising) {
  const Picture picture = shippedPicture("demo/frame_and_flange");  // no grenade
  const RecognitionResult result = recognized(picture, 4);  // fewer than there are: half of 4 are promising
  ASSERT_NE(stage(result, "first look"), nullptr);
  EXPECT_EQ(stage(result, "first look")->counts.at("models"), 5);
  EXPECT_EQ(stage(result, "first look")->counts.at("promising"), 2);
  EXPECT_THAT(names(result), UnorderedElementsAre("frame", "bridge", "flange", "bracket"));
}

TEST(FirstLook, TheAnswerIsTheSameEveryTime) {
  const Picture picture = shippedPicture("demo/two_bridges_and_grenade");
  const RecognitionResult first = recognized(picture, 2), second = recognized(picture, 2);
  expectSameObjects(first.objects, second.objects);
  expectSameObjects(first.rejected, second.rejected);
}

}  // namespace
}  // namespace monocular_eye_hand
