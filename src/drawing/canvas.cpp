#include "monocular_eye_hand/drawing/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

constexpr int kShift = 4;             // OpenCV draws in 1/16 of a pixel
constexpr double kTextHeight = 0.55;  // in units of OpenCV's font
constexpr int kMargin = 4;            // of a text's plate [px]

cv::Point fixedPoint(const Eigen::Vector2d& p) {
  // Far outside points are pulled in so that the fixed-point numbers do not overflow; lines are cut before.
  const auto fix = [](double v) { return int(std::lround(std::clamp(v, -3e4, 6e4) * (1 << kShift))); };
  return {fix(p.x()), fix(p.y())};
}

// From where on the radius in the raw image no longer grows with the rectified one (barrel lenses fold back).
double foldingRadius(const Camera& camera) {
  const double reach = 3.0 * std::hypot(camera.width, camera.height);
  if (!camera.distorted()) return 1e9;
  double last = 0;
  for (double r = 4; r < reach; r += 4) {
    // The least favourable of eight directions: tangential terms make the lens uneven.
    double min_reach = 1e9;
    for (int k = 0; k < 8; ++k) {
      const Eigen::Vector2d d(std::cos(k * M_PI / 4), std::sin(k * M_PI / 4)), c(camera.cx, camera.cy);
      min_reach = std::min(min_reach, (camera.distort(c + r * d) - c).dot(d));
    }
    if (min_reach <= last) return r - 4;
    last = min_reach;
  }
  return reach;
}

}  // namespace

Colour paletteColour(int index) {
  static const Colour kColours[] = {{75, 180, 255},  {255, 190, 60}, {90, 230, 120}, {220, 120, 255},
                                    {70, 90, 255},   {255, 240, 90}, {60, 240, 250}, {255, 130, 130},
                                    {140, 255, 220}, {180, 160, 255}};
  const int count = int(sizeof(kColours) / sizeof(kColours[0]));
  return kColours[((index % count) + count) % count];
}

Canvas::Canvas(const cv::Mat& grey, const Camera& camera, double dim, const PictureSize& size)
    : camera_(camera) {
  if (grey.empty() || (grey.type() != CV_8UC1 && grey.type() != CV_8UC3))
    throw BadInput("drawing: an 8-bit image with one or three channels is needed");
  if (grey.cols != camera.width || grey.rows != camera.height)
    throw BadInput(fmt::format(
        "drawing: the image is {}x{} but the camera {}x{}: use the calibration of this image size", grey.cols,
        grey.rows, camera.width, camera.height));
  scale_ = std::clamp((size.min_width + grey.cols - 1) / grey.cols, 1, 8);
  cv::Mat colour = grey;
  if (grey.channels() == 1) cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGR);
  cv::resize(colour, picture_, cv::Size(), scale_, scale_, cv::INTER_LINEAR);
  text_height_ = kTextHeight * std::max(1.0, double(picture_.cols) / size.text_width);
  if (dim < 1) picture_.convertTo(picture_, -1, dim, 40 * (1 - dim));
  far_ = foldingRadius(camera);
}

Eigen::Vector2d Canvas::at(const Eigen::Vector2d& uv_rect) const {
  const Eigen::Vector2d raw = camera_.distort(uv_rect);
  return (raw.array() + 0.5) * scale_ - 0.5;
}

void Canvas::polyline(const std::vector<Eigen::Vector2d>& points, bool closed, const Colour& colour,
                      int width) {
  const Eigen::Vector2d principal(camera_.cx, camera_.cy);
  const size_t count = points.size();
  if (count < 2) return;
  for (size_t k = 0; k + (closed ? 0 : 1) < count; ++k) {
    const Eigen::Vector2d &p = points[k], &q = points[(k + 1) % count];
    if (!p.allFinite() || !q.allFinite()) continue;
    // Straight lines are bent by the lens: short steps.
    const int steps = camera_.distorted() ? std::clamp(int((q - p).norm() / 8) + 1, 1, 400) : 1;
    for (int i = 0; i < steps; ++i) {
      const Eigen::Vector2d a = p + (q - p) * (double(i) / steps), b = p + (q - p) * (double(i + 1) / steps);
      if ((a - principal).norm() > far_ || (b - principal).norm() > far_) continue;
      cv::line(picture_, fixedPoint(at(a)), fixedPoint(at(b)), colour, width, cv::LINE_AA, kShift);
    }
  }
}

void Canvas::line(const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Colour& colour, int width) {
  polyline({p, q}, false, colour, width);
}

void Canvas::arc(const Ellipse& ellipse, double start, double sweep, const Colour& colour, int width) {
  const int steps = std::clamp(int(std::abs(sweep) * std::sqrt(std::max(ellipse.a, 1.0)) * 4), 8, 400);
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k <= steps; ++k) points.push_back(ellipse.at(start + sweep * k / steps));
  polyline(points, false, colour, width);
}

void Canvas::ellipse(const Ellipse& ellipse, const Colour& colour, int width) {
  arc(ellipse, 0, 2 * M_PI, colour, width);
}

void Canvas::dot(const Eigen::Vector2d& p, double radius, const Colour& colour) {
  if (!p.allFinite() || (p - Eigen::Vector2d(camera_.cx, camera_.cy)).norm() > far_) return;
  cv::circle(picture_, fixedPoint(at(p)), int(std::lround(radius * (1 << kShift))), colour, cv::FILLED,
             cv::LINE_AA, kShift);
}

void Canvas::arrow(const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Colour& colour, int width) {
  line(p, q, colour, width);
  const double length = (q - p).norm();
  if (!(length > 1e-6)) return;
  const double head = std::min(0.35 * length, 9.0 / scale_ + 2.0);
  const Eigen::Vector2d back = (p - q) / length * head, side(-back.y(), back.x());
  line(q, q + back + 0.45 * side, colour, width);
  line(q, q + back - 0.45 * side, colour, width);
}

int Canvas::strokeWidth() const { return std::max(1, int(std::lround(text_height_ / kTextHeight))); }

cv::Size Canvas::textSize(const std::string& text) const {
  int below = 0;
  cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, text_height_, strokeWidth(), &below);
  size.height += below;
  return size;
}

void Canvas::textPlate(cv::Point lower_left, const std::string& text, const Colour& colour) {
  const cv::Size size = textSize(text);
  cv::Rect plate(lower_left.x, lower_left.y - size.height - 2 * kMargin, size.width + 2 * kMargin,
                 size.height + 2 * kMargin);
  plate.x = std::max(0, std::min(plate.x, picture_.cols - plate.width));
  plate.y = std::max(0, std::min(plate.y, picture_.rows - plate.height));
  const cv::Rect seen = plate & cv::Rect(0, 0, picture_.cols, picture_.rows);
  if (seen.empty()) return;
  cv::Mat area = picture_(seen);
  area.convertTo(area, -1, 0.25);
  int below = 0;
  const int above =
      cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, text_height_, strokeWidth(), &below).height;
  cv::putText(picture_, text, {plate.x + kMargin, plate.y + kMargin + above}, cv::FONT_HERSHEY_SIMPLEX,
              text_height_, colour, strokeWidth(), cv::LINE_AA);
}

void Canvas::label(const Eigen::Vector2d& p, const std::string& text, const Colour& colour) {
  if (!p.allFinite()) return;
  const Eigen::Vector2d at_picture = at(p);
  const auto clip = [](double v) { return int(std::lround(std::clamp(v, -1e5, 1e5))); };
  textPlate({clip(at_picture.x()), clip(at_picture.y())}, text, colour);
}

void Canvas::caption(const std::string& text) {
  std::istringstream words(text);
  std::string line;
  int bottom = 0;
  const auto write = [&] {
    bottom += textSize(line).height + 2 * kMargin;
    textPlate({0, bottom}, line, {255, 255, 255});
  };
  for (std::string word; words >> word;) {
    const std::string longer = line.empty() ? word : line + " " + word;
    const bool fits = textSize(longer).width + 2 * kMargin <= picture_.cols;
    if (!fits && !line.empty()) write();
    line = fits || line.empty() ? longer : word;
  }
  if (!line.empty()) write();
}

void writePicture(const std::string& path, const cv::Mat& picture) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) throw BadInput(path + ": the folder cannot be made: " + error.message());
  bool written = false;
  try {
    written = cv::imwrite(path, picture);
  } catch (const cv::Exception& e) {
    throw BadInput(path + ": cannot be written as a picture (" + e.err + ")");
  }
  if (!written) throw BadInput(path + ": cannot be written; is there space, and may this user write there?");
}

}  // namespace monocular_eye_hand
