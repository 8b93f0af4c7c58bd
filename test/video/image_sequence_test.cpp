#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/video/image_sequence.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ImageSequenceTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "image_sequence_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, int value, int type = CV_8UC1) const {
    ASSERT_TRUE(cv::imwrite((folder_ / name).string(), cv::Mat(8, 8, type, cv::Scalar::all(value))));
  }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  std::vector<int> values(const std::string& source) const {
    auto sequence = openImageSequence(source, false);
    std::vector<int> out;
    SequenceImage image;
    while (sequence->next(&image)) out.push_back(image.image.at<uint8_t>(0, 0));
    return out;
  }
  std::string refusal(const std::string& source) const {
    try {
      auto sequence = openImageSequence(source, false);
      SequenceImage image;
      while (sequence->next(&image)) {
      }
    } catch (const BadInput& e) {
      return e.what();
    }
    return "accepted";
  }

  fs::path folder_;
};

using testing::ElementsAre;

TEST_F(ImageSequenceTest, OneImage) {
  write("one.png", 7);
  EXPECT_THAT(values(at("one.png")), ElementsAre(7));
}

TEST_F(ImageSequenceTest, FolderInOrderOfNumbers) {
  write("img10.png", 3);
  write("img2.png", 2);
  write("img1.PNG", 1);
  std::ofstream(at("notes.txt")) << "no image";
  EXPECT_THAT(values(folder_.string()), ElementsAre(1, 2, 3));
}

TEST_F(ImageSequenceTest, PatternTakesWhatMatches) {
  write("left08.png", 8);
  write("left09.png", 9);
  write("left10.png", 10);
  write("left100.png", 100);
  write("left7.png", 7);
  write("leftxx.png", 1);
  write("right08.png", 2);
  EXPECT_THAT(values(at("left%02d.png")), ElementsAre(8, 9, 10, 100));
  EXPECT_THAT(values(at("left%d.png")), ElementsAre(7, 10, 100));
}

TEST_F(ImageSequenceTest, RewindBeginsAgain) {
  write("a1.png", 1);
  write("a2.png", 2);
  auto sequence = openImageSequence(at("a%d.png"), false);
  SequenceImage image;
  while (sequence->next(&image)) {
  }
  sequence->rewind();
  ASSERT_TRUE(sequence->next(&image));
  EXPECT_EQ(image.image.at<uint8_t>(0, 0), 1);
  EXPECT_EQ(image.name, at("a1.png"));
}

TEST_F(ImageSequenceTest, KeepsSixteenBitsAndColour) {
  write("deep.png", 40000, CV_16UC1);
  SequenceImage image;
  ASSERT_TRUE(openImageSequence(at("deep.png"), false)->next(&image));
  EXPECT_EQ(image.image.type(), CV_16UC1);
  EXPECT_EQ(image.image.at<uint16_t>(0, 0), 40000);
  write("grey.png", 9);
  ASSERT_TRUE(openImageSequence(at("grey.png"), true)->next(&image));
  EXPECT_EQ(image.image.type(), CV_8UC3);
}

TEST_F(ImageSequenceTest, Video) {
  cv::VideoWriter writer(at("film.avi"), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 12.5, {64, 48}, true);
  ASSERT_TRUE(writer.isOpened());
  for (int value : {50, 100, 150}) writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(value)));
  writer.release();
  auto sequence = openImageSequence(at("film.avi"), false);
  EXPECT_NEAR(sequence->rate(), 12.5, 0.01);
  for (int round = 0; round < 2; ++round) {
    SequenceImage image;
    for (int value : {50, 100, 150}) {
      ASSERT_TRUE(sequence->next(&image));
      ASSERT_EQ(image.image.type(), CV_8UC1);
      EXPECT_NEAR(image.image.at<uint8_t>(20, 20), value, 4);
    }
    EXPECT_EQ(image.name, "frame 3 of " + at("film.avi"));
    EXPECT_FALSE(sequence->next(&image));
    sequence->rewind();
  }
}

TEST_F(ImageSequenceTest, SaysWhatIsWrong) {
  EXPECT_THAT(refusal(folder_.string()), HasSubstr("holds no image"));
  EXPECT_THAT(refusal(at("none.png")), HasSubstr("there is no file " + at("none.png")));
  EXPECT_THAT(refusal(at("img_%04d.png")), HasSubstr("no file matches"));
  EXPECT_THAT(refusal(at("img_%s.png")), HasSubstr("one %d or %0Nd"));
  EXPECT_THAT(refusal(at("img_%04d_%d.png")), HasSubstr("one %d or %0Nd"));
  EXPECT_THAT(refusal(at("nowhere/img_%d.png")), HasSubstr("cannot be read"));
  std::ofstream(at("broken.png")) << "no image";
  EXPECT_THAT(refusal(at("broken.png")), HasSubstr("cannot be read as an image"));
  std::ofstream(at("broken.avi")) << "no video";
  EXPECT_THAT(refusal(at("broken.avi")), HasSubstr("neither an image nor a video"));
}

}  // namespace
}  // namespace monocular_eye_hand
