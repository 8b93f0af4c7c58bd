#pragma once
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace monocular_eye_hand {

/// One picture of a sequence.
struct SequenceImage {
  cv::Mat image;     ///< CV_8UC1, CV_16UC1 or (colour) CV_8UC3, blue first
  std::string name;  ///< file, or "frame N of VIDEO", for messages
};

/// Images from an image file, a folder (its image files in the order of their names, numbers by value), a
/// printf pattern with one integer ("left%02d.jpg": all files that match, by number), or a video.
class ImageSequence {
 public:
  virtual ~ImageSequence() = default;
  /// False after the last image. Throws BadInput when a file cannot be read as an image.
  virtual bool next(SequenceImage* out) = 0;
  /// Begins again.
  virtual void rewind() = 0;
  /// Images per second of a video; 0 when the source has none.
  virtual double rate() const { return 0; }
  /// "30 images of FOLDER".
  virtual std::string describe() const = 0;
};

/// Throws BadInput when there is no such file, no file matches, a folder holds no image, or a video cannot be
/// opened.
std::unique_ptr<ImageSequence> openImageSequence(const std::string& source, bool colour);

}  // namespace monocular_eye_hand
