#include "recognition/outline_sides.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace monocular_eye_hand {
namespace {

constexpr int kCells = 200;  // of a grid, along the object's diameter
constexpr int kGap = 9;      // gaps between crests below this are closed [cells]
// Shares of the object's diameter.
constexpr double kShortest = 0.3;      // side: longer than what is straight of a circle
constexpr double kCrests = 0.008;      // the outline departs so far from it
constexpr double kOwnSamples = 0.015;  // samples within this of it are its own

// The cells that samples lie in, and those between neighbours.
cv::Mat coveredCells(const FlatView& flat, double cell) {
  const int middle = kCells + kGap;  // perspective makes a view at most twice as large as the diameter
  cv::Mat covered = cv::Mat::zeros(2 * middle, 2 * middle, CV_8UC1);
  for (const Eigen::Vector2d& p : flat.place) {
    const cv::Point at(middle + int(std::floor(p.x() / cell)), middle + int(std::floor(p.y() / cell)));
    if (cv::Rect(kGap, kGap, 2 * kCells, 2 * kCells).contains(at)) covered.at<uint8_t>(at) = 255;
  }
  cv::morphologyEx(covered, covered, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {kGap, kGap}));
  return covered;
}

std::vector<char> ownSamples(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const FlatView& flat,
                             double beside) {
  const Eigen::Vector2d along = (b - a).normalized(), across(-along.y(), along.x());
  std::vector<char> own;
  for (const Eigen::Vector2d& p : flat.place) {
    const double t = along.dot(p - a);
    own.push_back(t >= 0 && t <= (b - a).norm() && std::abs(across.dot(p - a)) < beside);
  }
  return own;
}

}  // namespace

std::vector<BaseEdge> outlineSides(const FlatView& flat, double diameter) {
  const double cell = diameter / kCells;
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(coveredCells(flat, cell), outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  const auto place = [&](const cv::Point& p) -> Eigen::Vector2d {
    return Eigen::Vector2d(p.x - kCells - kGap + 0.5, p.y - kCells - kGap + 0.5) * cell;
  };

  std::vector<BaseEdge> sides;
  for (const std::vector<cv::Point>& outline : outlines) {
    std::vector<cv::Point> corners;
    cv::approxPolyDP(outline, corners, kCrests * kCells, true);
    for (size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector2d a = place(corners[i]), b = place(corners[(i + 1) % corners.size()]);
      if ((b - a).norm() < kShortest * diameter) continue;
      sides.push_back({a, b, ownSamples(a, b, flat, kOwnSamples * diameter)});
    }
  }
  return sides;
}

}  // namespace monocular_eye_hand
