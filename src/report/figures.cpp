#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/drawing/overlays.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/report/explanation.h"
#include "monocular_eye_hand/report/result_drawing.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;

// "a" .. "z", "aa", "ab", ...
std::string letters(size_t index) {
  const std::string last(1, char('a' + index % 26));
  return index < 26 ? last : letters(index / 26 - 1) + last;
}

// Names come from the model base's file and may hold anything.
std::string asFileName(const std::string& name) {
  std::string out;
  for (const char c : name.substr(0, 60)) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    out += plain ? c : '_';
  }
  return out;
}

void removeEarlierFigures(const fs::path& folder) {
  std::vector<fs::path> earlier;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("figure_11", 0) == 0 && entry.path().extension() == ".png")
      earlier.push_back(entry.path());
  }
  for (const fs::path& path : earlier) fs::remove(path);
}

}  // namespace

cv::Mat searchImage(const cv::Mat& grey, const Camera& searched) {
  if (grey.empty() || searched.width <= 0 || searched.height <= 0 || grey.cols <= searched.width) return grey;
  cv::Mat smaller;
  cv::resize(grey, smaller, {searched.width, searched.height}, 0, 0, cv::INTER_AREA);
  return smaller;
}

std::vector<std::string> writeFigures(const std::string& folder, const cv::Mat& grey, const Camera& camera,
                                      const ModelBase& models, const RecognitionResult& result) {
  const fs::path into(folder);
  try {
    fs::create_directories(into);
    removeEarlierFigures(into);
  } catch (const fs::filesystem_error& e) {
    throw BadInput(folder + ": cannot be written (" + e.code().message() + ")");
  }

  std::vector<std::string> paths;
  const auto write = [&](const std::string& name, const cv::Mat& picture) {
    paths.push_back((into / name).string());
    writePicture(paths.back(), picture);
  };

  const cv::Mat searched = searchImage(grey, result.features.camera);
  write("figure_09_scene.png", Canvas(grey, camera).picture());
  write("figure_10a_line_groups.png", lineGroupsPicture(searched, result.features, result.groupings));
  write("figure_10b_ellipses.png", ellipsesPicture(searched, result.features));

  const std::vector<cv::Mat> projections = drawBackProjections(grey, camera, models, result);
  for (size_t k = 0; k < projections.size(); ++k)
    write("figure_11" + letters(k) + "_" + asFileName(result.objects[k].name) + ".png", projections[k]);
  return paths;
}

}  // namespace monocular_eye_hand
