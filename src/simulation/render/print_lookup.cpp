#include "simulation/render/print_lookup.h"

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

// Bilinear between the middles of the picture's elements; (u, v) in 0..1 from its top left corner.
cv::Vec2f valueAt(const cv::Mat_<cv::Vec2f>& picture, float u, float v) {
  const float x = std::clamp(u * float(picture.cols) - 0.5f, 0.0f, float(picture.cols - 1));
  const float y = std::clamp(v * float(picture.rows) - 0.5f, 0.0f, float(picture.rows - 1));
  const int left = int(x), top = int(y);
  const int right = std::min(left + 1, picture.cols - 1), bottom = std::min(top + 1, picture.rows - 1);
  const float s = x - float(left), t = y - float(top);
  const cv::Vec2f above = picture(top, left) * (1 - s) + picture(top, right) * s;
  const cv::Vec2f below = picture(bottom, left) * (1 - s) + picture(bottom, right) * s;
  return above * (1 - t) + below * t;
}

}  // namespace

PrintLookup::PrintLookup(const std::vector<Print>& prints, const Rigid3& world_from_object) {
  for (const Print& print : prints) {
    if (print.picture.empty()) throw BadInput("print: it has no picture");
    if (!(print.width > 0 && print.height > 0)) throw BadInput("print: width and height must be positive");
    const Rigid3 print_from_world = (world_from_object * print.object_from_print).inverse();
    sheets_.push_back({print_from_world.rotation.cast<float>(), print_from_world.translation.cast<float>(),
                       float(0.5 * print.width), float(0.5 * print.height), float(print.reach),
                       float(print.facing), print.picture});
  }
}

PrintLookup::Ink PrintLookup::at(float albedo, const Eigen::Vector3f& p,
                                 const Eigen::Vector3f& normal) const {
  Ink out{albedo, 1};
  for (const Sheet& sheet : sheets_) {
    const Eigen::Vector3f q = sheet.rotation * p + sheet.translation;
    if (std::abs(q.z()) > sheet.reach || std::abs(q.x()) > sheet.half_width ||
        std::abs(q.y()) > sheet.half_height)
      continue;
    if (sheet.rotation.row(2).dot(normal) < sheet.facing) continue;
    const cv::Vec2f ink = valueAt(sheet.picture, 0.5f + 0.5f * q.x() / sheet.half_width,
                                  0.5f - 0.5f * q.y() / sheet.half_height);
    out.albedo = out.albedo * (1 - ink[1]) + ink[0];
    out.bare *= 1 - ink[1];
  }
  return out;
}

}  // namespace monocular_eye_hand
