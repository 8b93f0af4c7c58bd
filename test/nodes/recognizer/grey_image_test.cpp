#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sensor_msgs/image_encodings.h>
#include <boost/make_shared.hpp>

#include <opencv2/imgproc.hpp>

#include "nodes/recognizer/grey_image.h"

namespace monocular_eye_hand {
namespace {

namespace enc = sensor_msgs::image_encodings;
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

sensor_msgs::ImagePtr message(const std::string& encoding, const cv::Mat& image) {
  return cv_bridge::CvImage(std_msgs::Header(), encoding, image).toImageMsg();
}

std::string refusal(const sensor_msgs::ImageConstPtr& image) {
  try {
    greyImage(image);
  } catch (const BadImage& e) {
    return e.what();
  }
  return "accepted";
}

TEST(GreyImage, Mono8SharesTheMessage) {
  for (const std::string& encoding : {enc::MONO8, enc::TYPE_8UC1}) {
    const sensor_msgs::ImageConstPtr image = message(encoding, ramp(CV_8UC1));
    const uint8_t* bytes = image->data.data();
    const long uses = image.use_count();
    const auto grey = greyImage(image);
    EXPECT_EQ(grey->image.data, bytes) << encoding;
    EXPECT_EQ(grey->image.type(), CV_8UC1) << encoding;
    EXPECT_GT(image.use_count(), uses) << encoding << ": the message must live as long as the image";
  }
}

TEST(GreyImage, GreyImageInColourStaysTheSame) {
  const cv::Mat grey = ramp(CV_8UC1);
  for (const std::string& encoding : {enc::BGR8, enc::RGB8}) {
    cv::Mat colour;
    cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGR);
    EXPECT_LE(cv::norm(greyImage(message(encoding, colour))->image, grey, cv::NORM_INF), 1) << encoding;
  }
  for (const std::string& encoding : {enc::BGRA8, enc::RGBA8}) {
    cv::Mat colour;
    cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGRA);
    EXPECT_LE(cv::norm(greyImage(message(encoding, colour))->image, grey, cv::NORM_INF), 1) << encoding;
  }
}

TEST(GreyImage, ChannelsAreNotSwapped) {
  const cv::Mat blue(8, 8, CV_8UC3, cv::Scalar(255, 0, 0));
  const int as_blue = greyImage(message(enc::BGR8, blue))->image.at<uint8_t>(4, 4);
  const int as_red = greyImage(message(enc::RGB8, blue))->image.at<uint8_t>(4, 4);
  EXPECT_NEAR(as_blue, 29, 2);  // luma of blue and red
  EXPECT_NEAR(as_red, 76, 2);
}

TEST(GreyImage, SixteenBitsAreScaledFromTheBitsInUse) {
  const cv::Mat full = ramp(CV_16UC1), grey = ramp(CV_8UC1);
  EXPECT_LE(cv::norm(greyImage(message(enc::MONO16, full))->image, grey, cv::NORM_INF), 1);
  cv::Mat twelve;
  full.convertTo(twelve, CV_16U, 4095.0 / 65535.0);
  EXPECT_LE(cv::norm(greyImage(message(enc::MONO16, twelve))->image, grey, cv::NORM_INF), 1);
}

TEST(GreyImage, BigEndianIsUnderstood) {
  const cv::Mat full = ramp(CV_16UC1);
  sensor_msgs::ImagePtr image = message(enc::MONO16, full);
  const cv::Mat expected = greyImage(image)->image.clone();
  for (size_t i = 0; i + 1 < image->data.size(); i += 2) std::swap(image->data[i], image->data[i + 1]);
  image->is_bigendian = 1;
  EXPECT_EQ(cv::norm(greyImage(image)->image, expected, cv::NORM_INF), 0);
}

TEST(GreyImage, BayerBecomesGrey) {
  const cv::Mat flat8(48, 64, CV_8UC1, cv::Scalar(100)), flat16(48, 64, CV_16UC1, cv::Scalar(65535));
  for (const std::string& encoding :
       {enc::BAYER_RGGB8, enc::BAYER_BGGR8, enc::BAYER_GBRG8, enc::BAYER_GRBG8}) {
    const cv::Mat grey = greyImage(message(encoding, flat8))->image;
    ASSERT_EQ(grey.type(), CV_8UC1) << encoding;
    EXPECT_NEAR(grey.at<uint8_t>(20, 20), 100, 1) << encoding;
  }
  for (const std::string& encoding :
       {enc::BAYER_RGGB16, enc::BAYER_BGGR16, enc::BAYER_GBRG16, enc::BAYER_GRBG16}) {
    const cv::Mat grey = greyImage(message(encoding, flat16))->image;
    ASSERT_EQ(grey.type(), CV_8UC1) << encoding;
    EXPECT_NEAR(grey.at<uint8_t>(20, 20), 255, 1) << encoding;
  }
}

TEST(GreyImage, OtherSupportedEncodingsConvert) {
  EXPECT_EQ(greyImage(message(enc::BGR16, ramp(CV_16UC3)))->image.type(), CV_8UC1);
  EXPECT_EQ(greyImage(message(enc::RGBA16, ramp(CV_16UC4)))->image.type(), CV_8UC1);
  EXPECT_EQ(greyImage(message(enc::YUV422, ramp(CV_8UC2)))->image.type(), CV_8UC1);
}

// Packed YUV: Y U Y V of USB cameras and U Y V Y. The grey is the Y, as it is.
TEST(GreyImage, PackedYuvGivesItsY) {
  const cv::Mat grey = ramp(CV_8UC1), chroma(grey.size(), CV_8UC1, cv::Scalar(90));
  cv::Mat y_first, y_last;
  cv::merge(std::vector<cv::Mat>{grey, chroma}, y_first);
  cv::merge(std::vector<cv::Mat>{chroma, grey}, y_last);
  const auto of = [](const std::string& encoding, const cv::Mat& pixels) {
    sensor_msgs::ImagePtr image = message(enc::YUV422, pixels);
    image->encoding = encoding;
    return image;
  };
  for (const char* encoding : {"yuv422_yuy2", "yuyv", "yuyv422", "yuy2"})
    EXPECT_EQ(cv::norm(greyImage(of(encoding, y_first))->image, grey, cv::NORM_INF), 0) << encoding;
  for (const char* encoding : {"yuv422", "uyvy"})
    EXPECT_EQ(cv::norm(greyImage(of(encoding, y_last))->image, grey, cv::NORM_INF), 0) << encoding;
  sensor_msgs::ImagePtr padded = of("yuyv", y_first);  // rows may be longer than their pixels
  sensor_msgs::Image wide = *padded;
  wide.step = padded->step + 6;
  wide.data.assign(size_t(wide.step) * wide.height, 7);
  for (uint32_t row = 0; row < wide.height; ++row)
    std::copy_n(padded->data.begin() + row * padded->step, padded->step, wide.data.begin() + row * wide.step);
  EXPECT_EQ(cv::norm(greyImage(boost::make_shared<sensor_msgs::Image>(wide))->image, grey, cv::NORM_INF), 0);
}

TEST(GreyImage, RefusesDamagedPackedYuv) {
  for (const std::string encoding : {"yuyv", "yuv422"}) {
    sensor_msgs::ImagePtr image = message(enc::YUV422, ramp(CV_8UC2));
    image->encoding = encoding;
    image->data.resize(image->data.size() - 1);
    EXPECT_THAT(refusal(image), HasSubstr("cannot be read as '" + encoding + "'"));
    image = message(enc::YUV422, ramp(CV_8UC2));
    image->encoding = encoding;
    image->step = image->width;
    EXPECT_THAT(refusal(image), HasSubstr("cannot be read as '" + encoding + "'"));
  }
}

TEST(GreyImage, RefusesOtherEncodingsAndNamesTheKnown) {
  EXPECT_THAT(
      refusal(message(enc::TYPE_32FC1, cv::Mat(4, 4, CV_32FC1, cv::Scalar(1)))),
      testing::AllOf(HasSubstr("'32FC1' is not supported"), HasSubstr("depth image"), HasSubstr("mono8")));
  EXPECT_THAT(refusal(message(enc::TYPE_16UC1, cv::Mat(4, 4, CV_16UC1, cv::Scalar(1)))),
              HasSubstr("says mono16"));
  sensor_msgs::ImagePtr image = message(enc::MONO8, ramp(CV_8UC1));
  image->encoding = "grey";
  EXPECT_THAT(refusal(image), HasSubstr("'grey' is not supported; supported: mono8"));
  image->encoding = "";
  EXPECT_THAT(refusal(image), HasSubstr("'' is not supported"));
}

TEST(GreyImage, RefusesEmptyAndDamagedImages) {
  const sensor_msgs::ImagePtr empty = boost::make_shared<sensor_msgs::Image>();
  empty->encoding = enc::MONO8;
  EXPECT_THAT(refusal(empty), HasSubstr("the image is empty (0x0, 0 bytes)"));
  sensor_msgs::ImagePtr image = message(enc::MONO8, ramp(CV_8UC1));
  image->data.resize(100);
  EXPECT_THAT(refusal(image), HasSubstr("cannot be read as 'mono8'"));
  image = message(enc::MONO8, ramp(CV_8UC1));
  image->step = 10;
  EXPECT_THAT(refusal(image), HasSubstr("cannot be read as 'mono8'"));
}

}  // namespace
}  // namespace monocular_eye_hand
