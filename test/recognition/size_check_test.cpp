#include "monocular_eye_hand/recognition/size_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace monocular_eye_hand {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Camera camera(int width, double focal) {
  const int height = width * 3 / 4;
  return {width, height, focal, focal, width / 2.0, height / 2.0, DistortionModel::kNone, {}};
}

ModelBase partOf(double diameter) {
  ModelBase base;
  base.objects.emplace_back();
  base.objects.front().model.name = "part";
  base.objects.front().model.diameter = diameter;
  return base;
}

TEST(SizeCheck, PartsThatCanBeSeenAreFine) {
  for (const double diameter : {0.02, 0.08, 0.4, 2.0})
    EXPECT_THAT(sizeWarnings(partOf(diameter), camera(640, 700), {}), IsEmpty()) << diameter;
}

TEST(SizeCheck, WrongUnitsAreNoticed) {
  // 80 mm read as 80 m and as 0.08 mm; a washer of 2 mm.
  EXPECT_THAT(sizeWarnings(partOf(80), camera(640, 700), {}),
              ElementsAre(AllOf(HasSubstr("part: "), HasSubstr("max_distance (2.5 m)"), HasSubstr("unit"))));
  EXPECT_THAT(sizeWarnings(partOf(8e-5), camera(640, 700), {}),
              ElementsAre(AllOf(HasSubstr("min_distance (0.05 m)"), HasSubstr("min_size (32 px)"))));
  EXPECT_THAT(sizeWarnings(partOf(0.002), camera(640, 700), {}).size(), 1u);
}

TEST(SizeCheck, FollowsCameraAndOptions) {
  EXPECT_THAT(sizeWarnings(partOf(0.002), camera(640, 2000), {}), IsEmpty());
  // Small parts are searched for in the full image, however wide.
  EXPECT_THAT(sizeWarnings(partOf(0.002), camera(1280, 1400), {}), IsEmpty());
  EXPECT_THAT(sizeWarnings(partOf(0.002), camera(1280, 700), {}).size(), 1u);
  RecognitionOptions far;
  far.min_distance = 0.25;
  EXPECT_THAT(sizeWarnings(partOf(0.008), camera(640, 700), far).size(), 1u);
  EXPECT_THAT(sizeWarnings(partOf(0.008), camera(640, 700), {}), IsEmpty());
}

}  // namespace
}  // namespace monocular_eye_hand
