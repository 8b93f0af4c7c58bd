#include "execution/drop_zone.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace monocular_eye_hand {
namespace {

double wrapped(double angle) { return std::remainder(angle, 2 * M_PI); }

Rigid3 turnAbout(const Eigen::Vector2d& from, const DropPlace& place, double turn, double raise) {
  Rigid3 motion;
  motion.rotation = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  motion.translation =
      Eigen::Vector3d(place.x, place.y, raise) - motion.rotation * Eigen::Vector3d(from.x(), from.y(), 0);
  return motion;
}

}  // namespace

FootprintBox footprintOf(const Mesh& mesh, const Rigid3& base_from_object) {
  std::vector<cv::Point2f> points;  // about the object's origin: floats are exact enough there
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    const Eigen::Vector3d p = base_from_object.rotation * vertex;
    points.emplace_back(float(p.x()), float(p.y()));
  }

  const cv::RotatedRect rectangle = cv::minAreaRect(points);
  cv::Point2f corners[4];
  rectangle.points(corners);
  cv::Point2f a = corners[1] - corners[0], b = corners[2] - corners[1];
  if (cv::norm(a) < cv::norm(b)) std::swap(a, b);

  FootprintBox footprint;
  footprint.centre = {rectangle.center.x, rectangle.center.y};
  footprint.centre += base_from_object.translation.head<2>();
  footprint.length = cv::norm(a);
  footprint.width = cv::norm(b);
  footprint.yaw = std::atan2(double(a.y), double(a.x));
  if (footprint.yaw < 0) footprint.yaw += M_PI;
  return footprint;
}

std::vector<DropTarget> dropTargets(const DropPlace& place, const FootprintBox& footprint,
                                    const Rigid3& base_from_grasp, double gap, double above) {
  std::vector<DropTarget> drops;
  for (double base : {0.0, M_PI / 2, M_PI / 4, -M_PI / 4}) {
    double one = wrapped(place.yaw + base - footprint.yaw), other = wrapped(one + M_PI);
    if (std::abs(other) < std::abs(one)) std::swap(one, other);
    for (double turn : {one, other})
      drops.push_back({turnAbout(footprint.centre, place, turn, above) * base_from_grasp,
                       turnAbout(footprint.centre, place, turn, gap) * base_from_grasp});
  }
  return drops;
}

}  // namespace monocular_eye_hand
