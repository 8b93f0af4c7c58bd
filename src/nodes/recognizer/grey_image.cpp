#include "nodes/recognizer/grey_image.h"

#include <sensor_msgs/image_encodings.h>
#include <boost/make_shared.hpp>

#include <algorithm>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

namespace monocular_eye_hand {
namespace {

namespace enc = sensor_msgs::image_encodings;

const std::vector<std::string>& convertible() {
  static const std::vector<std::string> encodings{
      // grey
      enc::MONO8, enc::TYPE_8UC1, enc::MONO16,

      // colour
      enc::BGR8, enc::RGB8, enc::BGRA8, enc::RGBA8, enc::BGR16, enc::RGB16, enc::BGRA16, enc::RGBA16,

      // one colour per pixel
      enc::BAYER_RGGB8, enc::BAYER_BGGR8, enc::BAYER_GBRG8, enc::BAYER_GRBG8, enc::BAYER_RGGB16,
      enc::BAYER_BGGR16, enc::BAYER_GBRG16, enc::BAYER_GRBG16,

      // a grey per pixel, colours per two
      enc::YUV422, "yuv422_yuy2", "yuyv", "yuyv422", "yuy2", "uyvy"};
  return encodings;
}

/// Which of two bytes is the pixel's grey: 0 or 1 in packed YUV 4:2:2, -1 in other encodings.
int greyByte(const std::string& encoding) {
  for (const char* first : {"yuv422_yuy2", "yuyv", "yuyv422", "yuy2"})
    if (encoding == first) return 0;
  return encoding == enc::YUV422 || encoding == "uyvy" ? 1 : -1;
}

std::string refusal(const std::string& encoding) {
  std::string text = "encoding '" + encoding + "' is not supported";
  if (encoding == enc::TYPE_16UC1 || encoding == enc::TYPE_32FC1)
    text += " (by REP-118 it is a depth image; a 16-bit grey camera says mono16)";
  text += "; supported:";
  for (const std::string& known : convertible()) text += " " + known;
  return text;
}

// Scales by the smallest usual depth that holds the brightest pixel.
cv::Mat eightBits(const cv::Mat& grey16) {
  double brightest = 0;
  cv::minMaxLoc(grey16, nullptr, &brightest);
  int bits = 8;
  while (bits < 16 && brightest >= double(1 << bits)) bits += 2;
  cv::Mat grey;
  grey16.convertTo(grey, CV_8U, 255.0 / double((1 << bits) - 1));
  return grey;
}

bool hostIsBigEndian() {
  const uint16_t one = 1;
  uint8_t first = 0;
  std::memcpy(&first, &one, 1);
  return first == 0;
}

// cv_bridge mistakes swapped 16-bit pixels for two channels: it is given the host's order of bytes.
sensor_msgs::ImageConstPtr inHostOrder(const sensor_msgs::ImageConstPtr& message) {
  if (bool(message->is_bigendian) == hostIsBigEndian()) return message;
  auto swapped = boost::make_shared<sensor_msgs::Image>(*message);
  for (size_t i = 0; i + 1 < swapped->data.size(); i += 2) std::swap(swapped->data[i], swapped->data[i + 1]);
  swapped->is_bigendian = hostIsBigEndian();
  return swapped;
}

// By hand: not every cv_bridge knows both orders.
cv_bridge::CvImageConstPtr fromPackedYuv(const sensor_msgs::Image& message, int byte) {
  const size_t row = size_t(message.width) * 2;
  if (message.step < row || message.data.size() < size_t(message.step) * message.height)
    throw BadImage("the image cannot be read as '" + message.encoding +
                   "': " + std::to_string(message.data.size()) + " bytes in rows of " +
                   std::to_string(message.step) + ", which " + std::to_string(message.width) + "x" +
                   std::to_string(message.height) + " pixels of 2 bytes do not fit");
  const cv::Mat packed(int(message.height), int(message.width), CV_8UC2,
                       const_cast<uint8_t*>(message.data.data()), message.step);
  auto grey = boost::make_shared<cv_bridge::CvImage>(message.header, enc::MONO8);
  cv::extractChannel(packed, grey->image, byte);
  return grey;
}

cv_bridge::CvImageConstPtr convert(const sensor_msgs::ImageConstPtr& message) {
  if (message->encoding == enc::MONO8) return cv_bridge::toCvShare(message);
  if (message->encoding == enc::TYPE_8UC1) {
    const auto shared = cv_bridge::toCvShare(message);  // the same bytes; `shared` lives on in the deleter
    auto grey = new cv_bridge::CvImage(message->header, enc::MONO8, shared->image);
    return cv_bridge::CvImageConstPtr(grey, [shared](const cv_bridge::CvImage* image) { delete image; });
  }
  if (const int byte = greyByte(message->encoding); byte >= 0) return fromPackedYuv(*message, byte);
  if (enc::bitDepth(message->encoding) == 16) {
    const auto grey16 = cv_bridge::toCvShare(inHostOrder(message), enc::MONO16);
    return boost::make_shared<cv_bridge::CvImage>(message->header, enc::MONO8, eightBits(grey16->image));
  }
  return cv_bridge::toCvShare(message, enc::MONO8);
}

}  // namespace

cv_bridge::CvImageConstPtr greyImage(const sensor_msgs::ImageConstPtr& message) {
  if (message->width == 0 || message->height == 0 || message->data.empty())
    throw BadImage("the image is empty (" + std::to_string(message->width) + "x" +
                   std::to_string(message->height) + ", " + std::to_string(message->data.size()) + " bytes)");
  const auto& known = convertible();
  if (std::find(known.begin(), known.end(), message->encoding) == known.end())
    throw BadImage(refusal(message->encoding));
  try {
    return convert(message);
  } catch (const cv_bridge::Exception& e) {
    throw BadImage("the image cannot be read as '" + message->encoding + "': " + e.what());
  } catch (const cv::Exception& e) {
    throw BadImage("the image cannot be read as '" + message->encoding + "': " + e.what());
  }
}

}  // namespace monocular_eye_hand
