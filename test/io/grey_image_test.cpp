#include "monocular_eye_hand/io/grey_image.h"

#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "support/refusal.h"
#include "temp_folder.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

cv::Mat picture() {
  cv::Mat image(60, 80, CV_8UC1);
  cv::randu(image, 0, 255);
  cv::GaussianBlur(image, image, {}, 3);
  return image;
}

std::string refusalOf(const std::string& path) {
  return refusal([&] { loadGreyImage(path); });
}

TEST(GreyImage, EveryFormatIsRead) {
  TempFolder folder;
  for (const char* name : {"a.png", "a.tif", "a.bmp", "a.pgm"}) {
    cv::imwrite(folder.path(name), picture());
    EXPECT_EQ(loadGreyImage(folder.path(name)).size(), cv::Size(80, 60)) << name;
  }
  cv::Mat colour;
  cv::cvtColor(picture(), colour, cv::COLOR_GRAY2BGR);
  cv::imwrite(folder.path("c.jpg"), colour);
  EXPECT_EQ(loadGreyImage(folder.path("c.jpg")).type(), CV_8UC1);
}

TEST(GreyImage, AFileCutOffAnywhereIsRefused) {
  TempFolder folder;
  for (const char* name : {"a.png", "a.jpg"}) {
    cv::imwrite(folder.path(name), picture());
    const auto size = std::filesystem::file_size(folder.path(name));
    for (const double share : {0.02, 0.3, 0.7, 0.99}) {
      const std::string cut = folder.path(std::string("cut_") + name);
      std::filesystem::copy_file(folder.path(name), cut, std::filesystem::copy_options::overwrite_existing);
      std::filesystem::resize_file(cut, std::uintmax_t(double(size) * share));
      EXPECT_THAT(refusalOf(cut), HasSubstr(cut)) << share;
    }
  }
}

TEST(GreyImage, WhatIsNoImageIsRefused) {
  TempFolder folder;
  folder.write("empty.png", "");
  folder.write("text.png", "a picture, honestly");
  EXPECT_THAT(refusalOf(folder.path("empty.png")), HasSubstr("empty.png: the file is empty"));
  EXPECT_THAT(refusalOf(folder.path("text.png")), HasSubstr("text.png: cannot be read as an image"));
  EXPECT_THAT(refusalOf(folder.path("missing.png")), HasSubstr("missing.png: cannot be read"));
  EXPECT_THAT(refusalOf(folder.path()), HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace monocular_eye_hand
