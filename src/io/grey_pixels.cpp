#include "monocular_eye_hand/io/grey_pixels.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace monocular_eye_hand {
namespace {

/// How pixels of an encoding become grey: by cv::cvtColor, or as one of the channels.
struct Encoding {
  const char* name;
  int type;         // of the pixels, for cv::Mat
  int colour = -1;  // code of cv::cvtColor; -1: by `channel`
  int channel = 0;  // the grey one
};

// A Bayer pattern is named by ROS from its first pixel, by OpenCV from the second pixel of the second row.
const std::array<Encoding, 25>& encodings() {
  static const std::array<Encoding, 25> all{{
      // grey
      {"mono8", CV_8UC1},
      {"8UC1", CV_8UC1},
      {"mono16", CV_16UC1},

      // colour
      {"bgr8", CV_8UC3, cv::COLOR_BGR2GRAY},
      {"rgb8", CV_8UC3, cv::COLOR_RGB2GRAY},
      {"bgra8", CV_8UC4, cv::COLOR_BGRA2GRAY},
      {"rgba8", CV_8UC4, cv::COLOR_RGBA2GRAY},
      {"bgr16", CV_16UC3, cv::COLOR_BGR2GRAY},
      {"rgb16", CV_16UC3, cv::COLOR_RGB2GRAY},
      {"bgra16", CV_16UC4, cv::COLOR_BGRA2GRAY},
      {"rgba16", CV_16UC4, cv::COLOR_RGBA2GRAY},

      // one colour per pixel
      {"bayer_rggb8", CV_8UC1, cv::COLOR_BayerBG2GRAY},
      {"bayer_bggr8", CV_8UC1, cv::COLOR_BayerRG2GRAY},
      {"bayer_gbrg8", CV_8UC1, cv::COLOR_BayerGR2GRAY},
      {"bayer_grbg8", CV_8UC1, cv::COLOR_BayerGB2GRAY},
      {"bayer_rggb16", CV_16UC1, cv::COLOR_BayerBG2GRAY},
      {"bayer_bggr16", CV_16UC1, cv::COLOR_BayerRG2GRAY},
      {"bayer_gbrg16", CV_16UC1, cv::COLOR_BayerGR2GRAY},
      {"bayer_grbg16", CV_16UC1, cv::COLOR_BayerGB2GRAY},

      // packed YUV: a grey per pixel, colours per two
      {"yuv422", CV_8UC2, -1, 1},
      {"yuv422_yuy2", CV_8UC2, -1, 0},
      {"yuyv", CV_8UC2, -1, 0},
      {"yuyv422", CV_8UC2, -1, 0},
      {"yuy2", CV_8UC2, -1, 0},
      {"uyvy", CV_8UC2, -1, 1},
  }};
  return all;
}

const Encoding& encodingOf(const std::string& name) {
  const auto& all = encodings();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Encoding& e) { return name == e.name; });
  if (found != all.end()) return *found;

  std::string text = "encoding '" + name + "' is not supported";
  if (name == "16UC1" || name == "32FC1")
    text += " (by REP-118 it is a depth image; a 16-bit grey camera says mono16)";
  text += "; supported:";
  for (const Encoding& known : all) text += std::string(" ") + known.name;
  throw BadImage(text);
}

std::string size(const RawImage& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height);
}

bool hostIsBigEndian() {
  const uint16_t one = 1;
  uint8_t first = 0;
  std::memcpy(&first, &one, 1);
  return first == 0;
}

cv::Mat swappedBytes(const cv::Mat& pixels) {
  cv::Mat swapped = pixels.clone();
  for (int y = 0; y < swapped.rows; ++y) {
    uint8_t* row = swapped.ptr<uint8_t>(y);
    for (size_t i = 0; i + 1 < size_t(swapped.cols) * swapped.elemSize(); i += 2)
      std::swap(row[i], row[i + 1]);
  }
  return swapped;
}

/// The bytes as pixels, in the host's order.
cv::Mat pixelsOf(const RawImage& image, int type) {
  const size_t row = size_t(image.width) * CV_ELEM_SIZE(type);
  if (image.step < row || image.size < image.step * size_t(image.height))
    throw BadImage("the image cannot be read as '" + image.encoding + "': " + std::to_string(image.size) +
                   " bytes in rows of " + std::to_string(image.step) + ", which " + size(image) +
                   " pixels of " + std::to_string(CV_ELEM_SIZE(type)) + " bytes do not fit");

  const cv::Mat pixels(image.height, image.width, type, const_cast<uint8_t*>(image.data), image.step);
  const bool swap = CV_MAT_DEPTH(type) == CV_16U && image.big_endian != hostIsBigEndian();
  return swap ? swappedBytes(pixels) : pixels;
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

}  // namespace

cv::Mat greyPixels(const RawImage& image) {
  if (image.width <= 0 || image.height <= 0 || image.size == 0)
    throw BadImage("the image is empty (" + size(image) + ", " + std::to_string(image.size) + " bytes)");
  const Encoding& encoding = encodingOf(image.encoding);

  try {
    cv::Mat grey = pixelsOf(image, encoding.type);
    if (encoding.colour >= 0)
      cv::cvtColor(grey, grey, encoding.colour);
    else if (grey.channels() > 1)
      cv::extractChannel(grey, grey, encoding.channel);
    return grey.depth() == CV_16U ? eightBits(grey) : grey;
  } catch (const cv::Exception& e) {
    throw BadImage("the image cannot be read as '" + image.encoding + "': " + e.what());
  }
}

}  // namespace monocular_eye_hand
