#include "monocular_eye_hand/io/grey_image.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

// Position of the last occurrence of a two-byte marker, -1 without one.
long lastMarker(const std::vector<uchar>& bytes, uchar first, uchar second) {
  for (size_t i = bytes.size(); i-- > 1;)
    if (bytes[i - 1] == first && bytes[i] == second) return long(i);
  return -1;
}

// In a JPEG's coded data FF is never followed by D9, so a whole file has its end marker (FF D9) behind the
// last start of a scan (FF DA).
bool truncatedJpeg(const std::vector<uchar>& bytes) {
  if (bytes.size() < 4 || bytes[0] != 0xff || bytes[1] != 0xd8) return false;
  return lastMarker(bytes, 0xff, 0xd9) <= lastMarker(bytes, 0xff, 0xda);
}

// A PNG ends with the chunk IEND.
bool truncatedPng(const std::vector<uchar>& bytes) {
  const uchar signature[] = {0x89, 'P', 'N', 'G'};
  if (bytes.size() < 4 || !std::equal(signature, signature + 4, bytes.begin())) return false;
  const std::string end = "IEND";
  return std::search(bytes.begin(), bytes.end(), end.begin(), end.end()) == bytes.end();
}

}  // namespace

cv::Mat loadGreyImage(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  file.peek();
  if (!file.is_open() || file.bad()) throw BadInput(path + ": cannot be read");
  file.clear();
  const std::vector<uchar> bytes{std::istreambuf_iterator<char>(file), {}};
  if (bytes.empty()) throw BadInput(path + ": the file is empty");
  if (truncatedJpeg(bytes) || truncatedPng(bytes))
    throw BadInput(path + ": the file is cut off; copy or record the image again");
  cv::Mat grey;
  try {
    grey = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception& e) {
    throw BadInput(path + ": cannot be decoded: " + e.err);
  }
  if (grey.empty())
    throw BadInput(path + ": cannot be read as an image (PNG, JPEG, TIFF, BMP or PGM expected)");
  return grey;
}

}  // namespace monocular_eye_hand
