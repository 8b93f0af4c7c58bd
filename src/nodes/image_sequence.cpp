#include "nodes/image_sequence.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <utility>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;

bool isDigit(char c) { return c >= '0' && c <= '9'; }

bool isImageFile(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  for (const char* known :
       {".png", ".jpg", ".jpeg", ".bmp", ".pgm", ".ppm", ".pnm", ".tif", ".tiff", ".webp"})
    if (extension == known) return true;
  return false;
}

// img2 before img10: runs of digits compare by value.
bool naturalLess(const std::string& a, const std::string& b) {
  size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (isDigit(a[i]) && isDigit(b[j])) {
      const auto number = [](const std::string& s, size_t& at) {
        while (at < s.size() && s[at] == '0') ++at;
        const size_t begin = at;
        while (at < s.size() && isDigit(s[at])) ++at;
        return s.substr(begin, at - begin);
      };
      const std::string x = number(a, i), y = number(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
    }
  }
  if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
  return a < b;
}

// "left%02d.jpg" taken apart. The pattern comes from a user: it never reaches printf.
struct Pattern {
  std::string before, after;
  size_t width = 0;  // digits at least, zeros in front
};

bool parsePattern(const std::string& name, Pattern* pattern) {
  const size_t percent = name.find('%');
  if (percent == std::string::npos) return false;
  size_t end = percent + 1;
  while (end < name.size() && isDigit(name[end])) ++end;
  const std::string width = name.substr(percent + 1, end - percent - 1);
  const bool good = end < name.size() && name[end] == 'd' && name.find('%', end) == std::string::npos &&
                    width.size() <= 2 && (width.empty() || width[0] == '0');
  if (!good)
    throw BadInput("source: '" + name +
                   "' is no pattern that is understood: use one %d or %0Nd, as img_%04d.png");
  pattern->before = name.substr(0, percent);
  pattern->after = name.substr(end + 1);
  pattern->width = width.empty() ? 0 : size_t(std::stoi(width));
  return true;
}

// The digits that stand for %d, empty when the name does not match.
std::string matchedDigits(const std::string& name, const Pattern& pattern) {
  const size_t fixed = pattern.before.size() + pattern.after.size();
  if (name.size() <= fixed || name.compare(0, pattern.before.size(), pattern.before) != 0 ||
      name.compare(name.size() - pattern.after.size(), pattern.after.size(), pattern.after) != 0)
    return "";
  const std::string digits = name.substr(pattern.before.size(), name.size() - fixed);
  if (!std::all_of(digits.begin(), digits.end(), isDigit)) return "";
  if (digits.size() < pattern.width ||
      (digits.size() > std::max<size_t>(1, pattern.width) && digits[0] == '0'))
    return "";
  return digits;
}

template <class Wanted>
std::vector<std::string> filesIn(const fs::path& folder, Wanted wanted) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->is_regular_file(error) && wanted(it->path())) names.push_back(it->path().filename().string());
  if (error) throw BadInput("source: the folder " + folder.string() + " cannot be read: " + error.message());
  std::sort(names.begin(), names.end(), naturalLess);
  for (std::string& name : names) name = (folder / name).string();
  return names;
}

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

std::vector<std::string> imageFiles(const std::string& source) {
  const fs::path path(source);
  std::error_code error;
  if (fs::is_directory(path, error)) {
    std::vector<std::string> files = filesIn(path, isImageFile);
    if (files.empty()) throw BadInput("source: the folder " + source + " holds no image file");
    return files;
  }
  if (fs::exists(path, error))
    return isImageFile(path) ? std::vector<std::string>{source} : std::vector<std::string>{};
  Pattern pattern;
  if (!parsePattern(path.filename().string(), &pattern)) throw BadInput("source: there is no file " + source);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::vector<std::string> files = filesIn(folder, [&](const fs::path& file) {
    return !matchedDigits(file.filename().string(), pattern).empty();
  });
  if (files.empty()) throw BadInput("source: no file matches " + source);
  return files;
}

std::unique_ptr<ImageSequence> openImageSequence(const std::string& source, bool colour) {
  std::vector<std::string> files = imageFiles(source);
  if (files.empty()) return std::make_unique<VideoSequence>(source, colour);
  return std::make_unique<FileSequence>(source, std::move(files), colour);
}

}  // namespace monocular_eye_hand
