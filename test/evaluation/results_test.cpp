#include "monocular_eye_hand/evaluation/results.h"

#include <gmock/gmock.h>

#include "monocular_eye_hand/geometry/error.h"
#include "small_dataset.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

const char* kIdentity = "1 0 0 0 1 0 0 0 1";

std::string refusalOf(const std::string& text) {
  TempFolder folder;
  folder.write("r.csv", text);
  return refusal([&] { readBopResults(folder.path("r.csv")); });
}

TEST(Results, ReadBackWhatWasWritten) {
  TempFolder folder;
  std::vector<BopResult> results(2);
  results[0] = {3, 17, 2, 1.0 / 3, {expSO3({0.3, -2, 1}), {0.1, -0.2, 1.0 / 7}}, 0.123456789012};
  results[1] = {3, 18, 5, -1, {}, -1};
  writeBopResults(folder.path("r.csv"), results);
  const auto back = readBopResults(folder.path("r.csv"));
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(back[0].scene, 3);
  EXPECT_EQ(back[0].image, 17);
  EXPECT_EQ(back[0].object, 2);
  EXPECT_EQ(back[0].score, 1.0 / 3);
  EXPECT_EQ(back[0].time, 0.123456789012);
  EXPECT_EQ(back[0].camera_from_object.rotation, results[0].camera_from_object.rotation);
  EXPECT_TRUE(
      back[0].camera_from_object.translation.isApprox(results[0].camera_from_object.translation, 1e-15));
  EXPECT_EQ(back[1].time, -1);
}

TEST(Results, MillimetresInTheFileMetresOutside) {
  TempFolder folder;
  folder.write("r.csv", std::string("scene_id,im_id,obj_id,score,R,t,time\n1,2,3,0.5,") + kIdentity +
                            ",10 -20 1500,0.25\n");
  const auto rows = readBopResults(folder.path("r.csv"));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_TRUE(rows[0].camera_from_object.translation.isApprox(Eigen::Vector3d(0.01, -0.02, 1.5), 1e-15));
}

TEST(Results, FaultsAreNamedWithTheirLine) {
  const std::string row = std::string("1,2,3,0.5,") + kIdentity + ",0 0 1,0.25\n";
  EXPECT_EQ(refusalOf(row + row), "accepted");
  EXPECT_EQ(refusalOf("\r\n" + row), "accepted");
  EXPECT_THAT(refusalOf(row + "1,2,3,0.5," + kIdentity + ",0 0 1\n"), HasSubstr("r.csv:2: has 6 fields, 7"));
  EXPECT_THAT(refusalOf("1,2,3,0.5,1 0 0 0 1 0 0 0,0 0 1,0.2\n"), HasSubstr("r.csv:1: R = "));
  EXPECT_THAT(refusalOf(std::string("1,2,3,0.5,") + kIdentity + ",0 0 x,0.2\n"),
              HasSubstr("t = '0 0 x': 3 numbers"));
  EXPECT_THAT(refusalOf("1,2,3,0.5,1 0 0 0 1 0 0 0 -1,0 0 1,0.2\n"), HasSubstr("R is not a rotation"));
  EXPECT_THAT(refusalOf("1,2,3,0.5,2 0 0 0 1 0 0 0 1,0 0 1,0.2\n"), HasSubstr("R is not a rotation"));
  EXPECT_THAT(refusalOf(std::string("1,2.5,3,0.5,") + kIdentity + ",0 0 1,0.2\n"),
              HasSubstr("im_id = '2.5'"));
  EXPECT_THAT(refusalOf(std::string("1,2,3,,") + kIdentity + ",0 0 1,0.2\n"), HasSubstr("score = ''"));
  EXPECT_THAT(refusalOf(row + "1,2,3,0.5," + kIdentity + ",0 0 1,0.26\n"),
              HasSubstr("r.csv:2: time differs"));
  EXPECT_THROW(readBopResults("/nowhere/r.csv"), BadInput);
  EXPECT_THROW(writeBopResults("/nowhere/r.csv", {}), BadInput);
}

TEST(Results, TimesBesideResults) {
  TempFolder folder;
  EXPECT_EQ(imageTimesPath("a/r.csv"), "a/r.times.csv");
  const ImageTimes times{{{1, 2}, 0.25}, {{1, 10}, 1e-3}};
  writeImageTimes(folder.path("r.times.csv"), times);
  EXPECT_EQ(readImageTimes(folder.path("r.times.csv")), times);
}

}  // namespace
}  // namespace monocular_eye_hand
