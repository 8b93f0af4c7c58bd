#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/io/grey_pixels.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

cv::Mat ramp(int type) {
  cv::Mat image(48, 64, type);
  const int top = image.depth() == CV_16U ? 65535 : 255;
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const int value = top * (x + y) / (image.rows + image.cols - 2);
      for (int c = 0; c < image.channels(); ++c) {
        if (image.depth() == CV_16U)
          image.ptr<uint16_t>(y)[x * image.channels() + c] = uint16_t(value);
        else
          image.ptr<uint8_t>(y)[x * image.channels() + c] = uint8_t(value);
      }
    }
  return image;
}

/// An image with bytes of its own, which a test may damage.
struct OwnImage : RawImage {
  OwnImage(const std::string& name, const cv::Mat& pixels) {
    encoding = name;
    width = pixels.cols;
    height = pixels.rows;
    step = size_t(pixels.cols) * pixels.elemSize();
    for (int y = 0; y < pixels.rows; ++y)
      bytes.insert(bytes.end(), pixels.ptr<uint8_t>(y), pixels.ptr<uint8_t>(y) + step);
  }
  RawImage raw() const {
    RawImage image = *this;
    image.data = bytes.data();
    image.size = bytes.size();
    return image;
  }
  std::vector<uint8_t> bytes;
};

cv::Mat greyOf(const OwnImage& image) { return greyPixels(image.raw()).clone(); }

std::string refusal(const OwnImage& image) {
  try {
    greyPixels(image.raw());
  } catch (const BadImage& e) {
    return e.what();
  }
  return "accepted";
}

TEST(GreyPixels, EightBitGreySharesTheBytes) {
  for (const char* encoding : {"mono8", "8UC1"}) {
    const OwnImage image(encoding, ramp(CV_8UC1));
    const cv::Mat grey = greyPixels(image.raw());
    EXPECT_EQ(grey.data, image.bytes.data()) << encoding;
    EXPECT_EQ(grey.type(), CV_8UC1) << encoding;
  }
}

TEST(GreyPixels, GreyImageInColourStaysTheSame) {
  const cv::Mat grey = ramp(CV_8UC1);
  for (const char* encoding : {"bgr8", "rgb8"}) {
    cv::Mat colour;
    cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGR);
    EXPECT_LE(cv::norm(greyOf(OwnImage(encoding, colour)), grey, cv::NORM_INF), 1) << encoding;
  }
  for (const char* encoding : {"bgra8", "rgba8"}) {
    cv::Mat colour;
    cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGRA);
    EXPECT_LE(cv::norm(greyOf(OwnImage(encoding, colour)), grey, cv::NORM_INF), 1) << encoding;
  }
}

TEST(GreyPixels, ChannelsAreNotSwapped) {
  const cv::Mat blue(8, 8, CV_8UC3, cv::Scalar(255, 0, 0));
  const int as_blue = greyOf(OwnImage("bgr8", blue)).at<uint8_t>(4, 4);
  const int as_red = greyOf(OwnImage("rgb8", blue)).at<uint8_t>(4, 4);
  EXPECT_NEAR(as_blue, 29, 2);  // luma of blue and red
  EXPECT_NEAR(as_red, 76, 2);
}

TEST(GreyPixels, SixteenBitsAreScaledFromTheBitsInUse) {
  const cv::Mat full = ramp(CV_16UC1), grey = ramp(CV_8UC1);
  EXPECT_LE(cv::norm(greyOf(OwnImage("mono16", full)), grey, cv::NORM_INF), 1);
  cv::Mat twelve;
  full.convertTo(twelve, CV_16U, 4095.0 / 65535.0);
  EXPECT_LE(cv::norm(greyOf(OwnImage("mono16", twelve)), grey, cv::NORM_INF), 1);
}

TEST(GreyPixels, BigEndianIsUnderstood) {
  const cv::Mat full = ramp(CV_16UC1);
  OwnImage image("mono16", full);
  const cv::Mat expected = greyOf(image);
  for (size_t i = 0; i + 1 < image.bytes.size(); i += 2) std::swap(image.bytes[i], image.bytes[i + 1]);
  image.big_endian = true;
  EXPECT_EQ(cv::norm(greyOf(image), expected, cv::NORM_INF), 0);
}

TEST(GreyPixels, BayerBecomesGrey) {
  const cv::Mat flat8(48, 64, CV_8UC1, cv::Scalar(100)), flat16(48, 64, CV_16UC1, cv::Scalar(65535));
  for (const char* encoding : {"bayer_rggb8", "bayer_bggr8", "bayer_gbrg8", "bayer_grbg8"}) {
    const cv::Mat grey = greyOf(OwnImage(encoding, flat8));
    ASSERT_EQ(grey.type(), CV_8UC1) << encoding;
    EXPECT_NEAR(grey.at<uint8_t>(20, 20), 100, 1) << encoding;
  }
  for (const char* encoding : {"bayer_rggb16", "bayer_bggr16", "bayer_gbrg16", "bayer_grbg16"}) {
    const cv::Mat grey = greyOf(OwnImage(encoding, flat16));
    ASSERT_EQ(grey.type(), CV_8UC1) << encoding;
    EXPECT_NEAR(grey.at<uint8_t>(20, 20), 255, 1) << encoding;
  }
}

// Each pattern is named by its pixels row by row: red alone is lit where the name has its R.
TEST(GreyPixels, BayerPatternsAreToldApart) {
  const std::vector<std::pair<std::string, cv::Point>> red{
      {"rggb", {0, 0}}, {"grbg", {1, 0}}, {"gbrg", {0, 1}}, {"bggr", {1, 1}}};
  for (const auto& [pattern, first] : red) {
    cv::Mat mosaic(16, 16, CV_8UC1, cv::Scalar(0));
    for (int y = first.y; y < mosaic.rows; y += 2)
      for (int x = first.x; x < mosaic.cols; x += 2) mosaic.at<uint8_t>(y, x) = 200;
    const cv::Mat grey = greyOf(OwnImage("bayer_" + pattern + "8", mosaic));
    EXPECT_NEAR(grey.at<uint8_t>(8, 8), 0.299 * 200, 2) << pattern;
    EXPECT_NEAR(grey.at<uint8_t>(7, 8), 0.299 * 200, 2) << pattern;
  }
}

TEST(GreyPixels, OtherSupportedEncodingsConvert) {
  EXPECT_EQ(greyOf(OwnImage("bgr16", ramp(CV_16UC3))).type(), CV_8UC1);
  EXPECT_EQ(greyOf(OwnImage("rgba16", ramp(CV_16UC4))).type(), CV_8UC1);
  EXPECT_EQ(greyOf(OwnImage("yuv422", ramp(CV_8UC2))).type(), CV_8UC1);
}

// Packed YUV: Y U Y V of USB cameras and U Y V Y. The grey is the Y, as it is.
TEST(GreyPixels, PackedYuvGivesItsY) {
  const cv::Mat grey = ramp(CV_8UC1), chroma(grey.size(), CV_8UC1, cv::Scalar(90));
  cv::Mat y_first, y_last;
  cv::merge(std::vector<cv::Mat>{grey, chroma}, y_first);
  cv::merge(std::vector<cv::Mat>{chroma, grey}, y_last);
  for (const char* encoding : {"yuv422_yuy2", "yuyv", "yuyv422", "yuy2"})
    EXPECT_EQ(cv::norm(greyOf(OwnImage(encoding, y_first)), grey, cv::NORM_INF), 0) << encoding;
  for (const char* encoding : {"yuv422", "uyvy"})
    EXPECT_EQ(cv::norm(greyOf(OwnImage(encoding, y_last)), grey, cv::NORM_INF), 0) << encoding;
}

TEST(GreyPixels, RowsMayBeLongerThanTheirPixels) {
  const cv::Mat grey = ramp(CV_8UC1);
  const OwnImage narrow("mono8", grey);
  OwnImage wide = narrow;
  wide.step = narrow.step + 6;
  wide.bytes.assign(wide.step * size_t(wide.height), 7);
  for (size_t row = 0; row < size_t(wide.height); ++row)
    std::copy_n(narrow.bytes.data() + row * narrow.step, narrow.step, wide.bytes.data() + row * wide.step);
  EXPECT_EQ(cv::norm(greyOf(wide), grey, cv::NORM_INF), 0);
}

TEST(GreyPixels, RefusesDamagedImages) {
  const std::vector<std::pair<std::string, int>> types{
      {"yuyv", CV_8UC2}, {"yuv422", CV_8UC2}, {"mono8", CV_8UC1}, {"bgr8", CV_8UC3}};
  for (const auto& [encoding, type] : types) {
    OwnImage image(encoding, ramp(type));
    image.bytes.pop_back();
    EXPECT_THAT(refusal(image), HasSubstr("cannot be read as '" + encoding + "'"));
    image = OwnImage(encoding, ramp(type));
    image.step -= 1;
    EXPECT_THAT(refusal(image), HasSubstr("cannot be read as '" + encoding + "'"));
  }
}

TEST(GreyPixels, RefusesOtherEncodingsAndNamesTheKnown) {
  EXPECT_THAT(
      refusal(OwnImage("32FC1", cv::Mat(4, 4, CV_32FC1, cv::Scalar(1)))),
      testing::AllOf(HasSubstr("'32FC1' is not supported"), HasSubstr("depth image"), HasSubstr("mono8")));
  EXPECT_THAT(refusal(OwnImage("16UC1", cv::Mat(4, 4, CV_16UC1, cv::Scalar(1)))), HasSubstr("says mono16"));
  OwnImage image("mono8", ramp(CV_8UC1));
  image.encoding = "grey";
  EXPECT_THAT(refusal(image), HasSubstr("'grey' is not supported; supported: mono8"));
  image.encoding = "";
  EXPECT_THAT(refusal(image), HasSubstr("'' is not supported"));
}

TEST(GreyPixels, RefusesEmptyImages) {
  EXPECT_THAT(refusal(OwnImage("mono8", cv::Mat(0, 0, CV_8UC1))),
              HasSubstr("the image is empty (0x0, 0 bytes)"));
}

}  // namespace
}  // namespace monocular_eye_hand
