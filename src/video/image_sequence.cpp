#include "monocular_eye_hand/video/image_sequence.h"

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <utility>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/image_files.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;

class FileSequence : public ImageSequence {
 public:
  FileSequence(std::string source, std::vector<std::string> files, bool colour)
      : source_(std::move(source)), files_(std::move(files)), colour_(colour) {}
  bool next(SequenceImage* out) override {
    if (at_ == files_.size()) return false;
    const std::string& file = files_[at_++];
    out->name = file;
    out->image = cv::imread(file, colour_ ? cv::IMREAD_COLOR : cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH);
    if (out->image.empty()) throw BadInput("source: " + file + " cannot be read as an image");
    if (out->image.depth() != CV_8U && out->image.depth() != CV_16U)
      throw BadInput("source: " + file + " is neither an 8-bit nor a 16-bit image");
    return true;
  }
  void rewind() override { at_ = 0; }
  std::string describe() const override {
    return std::to_string(files_.size()) + (files_.size() == 1 ? " image, " : " images of ") + source_;
  }

 private:
  std::string source_;
  std::vector<std::string> files_;
  bool colour_;
  size_t at_ = 0;
};

class VideoSequence : public ImageSequence {
 public:
  VideoSequence(std::string file, bool colour) : file_(std::move(file)), colour_(colour) { rewind(); }
  bool next(SequenceImage* out) override {
    cv::Mat frame;
    if (!video_.read(frame) || frame.empty()) return false;
    out->name = "frame " + std::to_string(++at_) + " of " + file_;
    if (!colour_ && frame.channels() == 3)
      cv::cvtColor(frame, out->image, cv::COLOR_BGR2GRAY);
    else if (colour_ && frame.channels() == 1)
      cv::cvtColor(frame, out->image, cv::COLOR_GRAY2BGR);
    else
      out->image = frame.clone();
    return true;
  }
  void rewind() override {
    at_ = 0;
    if (!video_.open(file_))
      throw BadInput("source: " + file_ + " is neither an image nor a video that OpenCV can read here");
  }
  double rate() const override {
    const double rate = video_.get(cv::CAP_PROP_FPS);
    return rate > 0 && rate < 1000 ? rate : 0;
  }
  std::string describe() const override { return "video " + file_; }

 private:
  std::string file_;
  bool colour_;
  cv::VideoCapture video_;
  int at_ = 0;
};

}  // namespace

std::unique_ptr<ImageSequence> openImageSequence(const std::string& source, bool colour) {
  std::vector<std::string> files;
  try {
    files = imageFiles(source);
  } catch (const BadInput& e) {
    throw BadInput(std::string("source: ") + e.what());
  }
  std::error_code error;
  if (!fs::exists(files.front(), error)) throw BadInput("source: there is no file " + files.front());
  if (!isImageFile(files.front())) return std::make_unique<VideoSequence>(source, colour);
  return std::make_unique<FileSequence>(source, std::move(files), colour);
}

}  // namespace monocular_eye_hand
