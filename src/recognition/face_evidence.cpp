#include "recognition/face_evidence.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/model/ray_scene.h"
#include "recognition/median.h"
#include "recognition/shading.h"

namespace monocular_eye_hand {
namespace {

constexpr int kMaxRays = 900;         // per candidate, unless the widest lattice needs more
constexpr double kContourBand = 4.0;  // pixels nearer a drawn line are not interior [px]
constexpr int kMinFacePixels = 12;

struct FacePixel {
  float u, v, grey;
};

// Outward, unit, object frame.
Eigen::Vector3d normalOf(const Mesh& mesh, int triangle) {
  const std::array<int, 3>& corners = mesh.triangles[size_t(triangle)];
  const Eigen::Vector3d& a = mesh.vertices[size_t(corners[0])];
  const Eigen::Vector3d& b = mesh.vertices[size_t(corners[1])];
  const Eigen::Vector3d& c = mesh.vertices[size_t(corners[2])];
  return (b - a).cross(c - a).normalized();
}

// Share of pixels that depart from a plane (flat face) or quadric (curved face) of grey by more than noise
// and a small share of contrast allow. Three rounds of trimmed least squares.
int countOffShading(const std::vector<FacePixel>& pixels, bool curved) {
  const int unknowns = curved ? 6 : 3, n = int(pixels.size());
  if (n < std::max(kMinFacePixels, 2 * unknowns)) return 0;
  double mu = 0, mv = 0;
  for (const FacePixel& p : pixels) mu += p.u, mv += p.v;
  mu /= n, mv /= n;
  Eigen::MatrixXd a(n, unknowns);
  Eigen::VectorXd g(n);
  for (int i = 0; i < n; ++i) {
    const double x = (pixels[i].u - mu) / 32, y = (pixels[i].v - mv) / 32;
    a(i, 0) = 1, a(i, 1) = x, a(i, 2) = y;
    if (curved) a(i, 3) = x * x, a(i, 4) = x * y, a(i, 5) = y * y;
    g[i] = pixels[i].grey;
  }
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(n), residual(n);
  double tolerance = 0;
  for (int round = 0; round < 4; ++round) {
    const Eigen::MatrixXd wa = weight.asDiagonal() * a;
    Eigen::MatrixXd normal = a.transpose() * wa;
    normal.diagonal().array() += 1e-6;
    const Eigen::VectorXd x = normal.ldlt().solve(wa.transpose() * g);
    residual = (g - a * x).cwiseAbs();
    std::vector<double> sizes(residual.data(), residual.data() + n);
    tolerance = std::max(4.0, 3.5 * 1.4826 * median(&sizes));
    tolerance =
        std::min(tolerance, 14.0);  // a face half covered by something else must not set its own scale
    for (int i = 0; i < n; ++i) weight[i] = residual[i] < tolerance ? 1.0 : 0.02;
  }
  int off = 0;
  for (int i = 0; i < n; ++i) off += residual[i] > tolerance;
  return off;
}

// The drawn area on the lattice of looked-at pixels.
struct DrawnArea {
  cv::Rect box;
  int step = 2;
  cv::Mat_<uint8_t> drawn;

  // Whether a pixel, or one of its neighbours on the lattice, is drawn.
  bool near(float u, float v) const {
    const int x = int((u - float(box.x)) / float(step)), y = int((v - float(box.y)) / float(step));
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (unsigned(x + dx) < unsigned(drawn.cols) && unsigned(y + dy) < unsigned(drawn.rows) &&
            drawn(y + dy, x + dx))
          return true;
    return false;
  }
};

// Of the face pixels on unexplained edges, how many are on traces that leave the drawing.
int countLeaving(const SearchImage& image, const std::map<int, int>& pixels_of_trace, const DrawnArea& area) {
  constexpr int kStride = 3;
  constexpr int kOutside = 8;  // edge points beyond the drawing that make a trace leave it
  int leaving = 0;
  for (const auto& [trace, pixels] : pixels_of_trace) {
    const EdgeTrace& t = image.features.traces[size_t(trace)];
    int outside = 0;
    for (int i = t.first; i < t.first + t.count && outside * kStride < kOutside; i += kStride) {
      const Eigen::Vector2f& uv = image.features.points[size_t(i)].uv;
      outside += !area.near(uv.x(), uv.y());
    }
    if (outside * kStride >= kOutside) leaving += pixels;
  }
  return leaving;
}

cv::Mat contourBand(const Candidate& candidate, const cv::Rect& box) {
  cv::Mat band = cv::Mat::zeros(box.size(), CV_8U);
  const int radius = int(kContourBand);
  for (const SeenSample& s : candidate.contour) {
    const int x = int(std::lround(s.uv.x())) - box.x, y = int(std::lround(s.uv.y())) - box.y;
    cv::rectangle(band, cv::Rect(x - radius, y - radius, 2 * radius + 1, 2 * radius + 1), 255, cv::FILLED);
  }
  return band;
}

}  // namespace

void faceTerms(const ObjectModel& model, const SearchImage& context, Candidate* candidate) {
  EvidenceTerms& terms = candidate->terms;
  const cv::Rect box = candidate->bounding_box;
  if (box.area() <= 0) return;
  const Rigid3 object_from_camera = candidate->pose.camera_from_object.inverse();
  const cv::Mat band = contourBand(*candidate, box);
  int step = 2;  // a lattice common to all candidates, so that covered cells compare
  while (step < kCoverCell && box.area() / (step * step) > kMaxRays) step *= 2;
  const auto firstOnLattice = [step](int start, int origin) {
    return start + ((origin - start) % step + step) % step;
  };
  DrawnArea area{box, step, cv::Mat_<uint8_t>::zeros(box.height / step + 2, box.width / step + 2)};
  std::map<int, int> pixels_of_trace;
  std::map<int, std::vector<FacePixel>> by_surface;
  std::vector<cv::Point2f> drawn;
  std::vector<ShadedPixel> shaded;
  int interior = 0, unexplained = 0, hits = 0;
  const int cells_x = (context.domain.width + kCoverCell - 1) / kCoverCell;
  for (int v = firstOnLattice(box.y, context.domain.v0); v < box.y + box.height; v += step)
    for (int u = firstOnLattice(box.x, context.domain.u0); u < box.x + box.width; u += step) {
      const Eigen::Vector3d ray =
          (object_from_camera.rotation * context.camera.ray({double(u), double(v)})).normalized();
      const RayScene::Hit hit = model.rays->cast(object_from_camera.translation, ray);
      if (!hit.hit) continue;
      ++hits;
      area.drawn((v - box.y) / step, (u - box.x) / step) = 1;
      drawn.emplace_back(float(u), float(v));
      const auto hides = [&](const Occluder& o) {
        return o.hides(context.camera, {double(u), double(v)}, hit.distance);
      };
      if (std::any_of(candidate->occluders.begin(), candidate->occluders.end(), hides)) continue;
      const int x = u - context.domain.u0, y = v - context.domain.v0;
      candidate->covered.push_back((y / kCoverCell) * cells_x + x / kCoverCell);
      const int surface = model.surface_of_triangle[hit.triangle];
      if (!context.domain.contains(u, v)) continue;
      const float grey = float(context.rect_grey.at<uint8_t>(y, x));
      const Eigen::Vector3d normal =
          candidate->pose.camera_from_object.rotation * normalOf(model.mesh, hit.triangle);
      shaded.push_back({normal.cast<float>(), grey});
      auto& pixels = by_surface[surface];
      if (band.at<uint8_t>(v - box.y, u - box.x)) continue;
      pixels.push_back({float(u), float(v), grey});
      ++interior;
      int edge = -1;
      for (int dy = -1; dy <= 1 && edge < 0; ++dy)
        for (int dx = -1; dx <= 1 && edge < 0; ++dx) edge = context.raster.indexAt(u + dx, v + dy);
      if (edge < 0) continue;
      ++unexplained;
      ++pixels_of_trace[context.trace_of_point[size_t(edge)]];
    }
  std::sort(candidate->covered.begin(), candidate->covered.end());
  candidate->covered.erase(std::unique(candidate->covered.begin(), candidate->covered.end()),
                           candidate->covered.end());
  terms.shading = shadingExplained(shaded);
  int off = 0;
  for (const auto& [surface, pixels] : by_surface)
    off += countOffShading(pixels, model.surfaces[surface].kind != Surface::Kind::kPlane);
  terms.faces = double(by_surface.size());
  terms.interior = interior > 0 ? double(unexplained) / interior : 0;
  const int leaving = countLeaving(context, pixels_of_trace, area);
  terms.through = interior > 0 ? double(leaving) / interior : 0;
  terms.print = interior > 0 ? double(unexplained - leaving) / interior : 0;
  terms.off_face = interior > 0 ? double(off) / interior : 0;
  terms.size = std::sqrt(double(hits)) * step;
  if (drawn.size() >= 3) {
    std::vector<cv::Point2f> hull;
    cv::convexHull(drawn, hull);
    const double area = cv::contourArea(hull) + step * cv::arcLength(hull, true) / 2 + step * step;
    terms.solidity = std::min(1.0, double(hits) * step * step / area);
  }
}

}  // namespace monocular_eye_hand
