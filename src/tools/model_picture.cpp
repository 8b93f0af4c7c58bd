#include "tools/model_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/mesh/ray_scene.h"
#include "monocular_eye_hand/model/contour.h"

namespace monocular_eye_hand {
namespace {

constexpr int kWidth = 1280, kHeight = 720, kTextWidth = 440;
const cv::Scalar kEdge(0, 215, 255), kCircle(255, 60, 255), kSilhouette(255, 230, 0), kCorner(80, 80, 255),
    kAxis(90, 220, 90), kText(235, 235, 235);

/// A pinhole view of the whole model from above and aside.
struct View {
  Eigen::Vector3d eye;
  Eigen::Matrix3d camera_from_object;  // rotation
  double focal;
  Eigen::Vector2d centre{0.5 * (kWidth + kTextWidth), 0.5 * kHeight};

  explicit View(const ObjectModel& model) {
    const Eigen::Vector3d back = Eigen::Vector3d(0.55, -0.75, 0.5).normalized();
    eye = model.centre() + 3.0 * model.diameter * back;
    const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(back).normalized();
    camera_from_object.row(0) = right;
    camera_from_object.row(1) = -back.cross(right);
    camera_from_object.row(2) = -back;
    focal = 1;
    double reach = 0;
    for (const Eigen::Vector3d& v : model.mesh.vertices) {
      const Eigen::Vector2d p = project(v) - centre;
      reach = std::max({reach, std::abs(p.x()) / (kWidth - kTextWidth), std::abs(p.y()) / kHeight});
    }
    focal = 0.45 / reach;
  }
  Eigen::Vector2d project(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d c = camera_from_object * (p - eye);
    return centre + focal * c.head<2>() / c.z();
  }
  Eigen::Vector3d ray(double u, double v) const {
    const Eigen::Vector3d c((u - centre.x()) / focal, (v - centre.y()) / focal, 1);
    return (camera_from_object.transpose() * c).normalized();
  }
};

cv::Point fixed(const Eigen::Vector2d& p) {  // in 1/16 pixel
  return {int(std::lround(16 * p.x())), int(std::lround(16 * p.y()))};
}

void shade(const ObjectModel& model, const View& view, cv::Mat* picture) {
  std::vector<Eigen::Vector3d> normals;
  for (const auto& t : model.mesh.triangles) {
    const auto &a = model.mesh.vertices[t[0]], &b = model.mesh.vertices[t[1]], &c = model.mesh.vertices[t[2]];
    normals.push_back((b - a).cross(c - a).normalized());
  }
  const Eigen::Vector3d light =
      view.camera_from_object.transpose() * Eigen::Vector3d(-0.5, -0.7, -0.6).normalized();
  for (int v = 0; v < kHeight; ++v) {
    for (int u = kTextWidth; u < kWidth; ++u) {
      const RayScene::Hit hit = model.rays->cast(view.eye, view.ray(u, v));
      if (!hit.hit) continue;
      const double grey = 70 + 90 * std::max(0.0, std::abs(normals[hit.triangle].dot(light)));
      picture->at<cv::Vec3b>(v, u) = cv::Vec3b::all(cv::saturate_cast<uchar>(grey));
    }
  }
}

void drawFeatures(const ObjectModel& model, const View& view, cv::Mat* picture) {
  ContourOptions options;
  options.step = model.diameter / 250;
  options.min_dihedral = 0;
  for (const ContourSample& s : visibleContour(model, view.eye, options)) {
    const Eigen::Vector3d half = 0.55 * options.step * s.tangent;
    const bool edge = s.feature < model.featureOfCircle(0),
               circle = !edge && s.feature < model.featureOfSilhouette(0);
    cv::line(*picture, fixed(view.project(s.p - half)), fixed(view.project(s.p + half)),
             edge     ? kEdge
             : circle ? kCircle
                      : kSilhouette,
             2, cv::LINE_AA, 4);
  }

  for (const ModelCorner& c : model.corners) {
    const Eigen::Vector3d start = c.p + 0.01 * (view.eye - model.centre()) / 3.0;
    if (model.rays->occluded(start, view.eye)) continue;
    cv::circle(*picture, fixed(view.project(c.p)), 4 * 16, kCorner, cv::FILLED, cv::LINE_AA, 4);
  }

  if (model.symmetries.axis) {
    const SymmetryAxis& a = *model.symmetries.axis;
    const Eigen::Vector3d middle = a.point + a.direction * a.direction.dot(model.centre() - a.point);
    const Eigen::Vector3d half = 0.6 * model.diameter * a.direction;
    cv::line(*picture, fixed(view.project(middle - half)), fixed(view.project(middle + half)), kAxis, 1,
             cv::LINE_AA, 4);
  }
}

}  // namespace

cv::Mat modelPicture(const ObjectModel& model, const std::vector<std::string>& text) {
  cv::Mat picture(kHeight, kWidth, CV_8UC3, cv::Scalar(40, 36, 32));
  const View view(model);
  shade(model, view, &picture);
  drawFeatures(model, view, &picture);

  int y = 30;
  const auto write = [&](const std::string& line, const cv::Scalar& colour) {
    constexpr size_t kColumns = 54;
    for (size_t k = 0; k < line.size();) {
      size_t end = line.size();
      if (end - k > kColumns) {
        end = line.rfind(' ', k + kColumns);
        if (end == std::string::npos || end <= k) end = k + kColumns;
      }
      cv::putText(picture, line.substr(k, end - k), {14, y}, cv::FONT_HERSHEY_SIMPLEX, 0.43, colour, 1,
                  cv::LINE_AA);
      y += 20;
      k = end;
    }
  };

  for (const std::string& line : text) write(line, kText);
  y += 10;
  write("straight edges", kEdge);
  write("circles and arcs", kCircle);
  write("silhouettes of curved surfaces", kSilhouette);
  write("corners", kCorner);
  if (model.symmetries.axis) write("symmetry axis", kAxis);
  return picture;
}

}  // namespace monocular_eye_hand
