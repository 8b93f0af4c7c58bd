#include "recognition/face_evidence.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/geometry/median.h"
#include "recognition/drawn_pixels.h"
#include "recognition/shading.h"

namespace monocular_eye_hand {
namespace {

constexpr int kMaxRays = 900;         // per candidate, unless the widest lattice needs more
constexpr double kContourBand = 4.0;  // pixels nearer a drawn line are not interior [px]
constexpr int kMinFacePixels = 12;

struct FacePixel {
  float u, v, grey;
};

// Powers of a pixel's place: of a plane of grey (3) or of a quadric (6).
template <int kPowers>
Eigen::Matrix<double, kPowers, 1> powersOf(double x, double y) {
  Eigen::Matrix<double, kPowers, 1> powers;
  if constexpr (kPowers == 3) powers << 1, x, y;
  if constexpr (kPowers == 6) powers << 1, x, y, x * x, x * y, y * y;
  return powers;
}

// How many pixels depart from a polynomial of grey by more than noise and a small share of contrast allow.
// Four rounds of trimmed least squares.
template <int kPowers>
int countOffPolynomial(const std::vector<FacePixel>& pixels) {
  using Powers = Eigen::Matrix<double, kPowers, 1>;
  const size_t n = pixels.size();
  if (n < size_t(std::max(kMinFacePixels, 2 * kPowers))) return 0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const FacePixel& p : pixels) mean += Eigen::Vector2d(p.u, p.v);
  mean /= double(n);
  std::vector<Powers> powers;
  powers.reserve(n);
  for (const FacePixel& p : pixels)
    powers.push_back(powersOf<kPowers>((p.u - mean.x()) / 32, (p.v - mean.y()) / 32));

  std::vector<double> weight(n, 1.0), residual(n), sizes;
  double tolerance = 0;
  for (int round = 0; round < 4; ++round) {
    Eigen::Matrix<double, kPowers, kPowers> normal = Eigen::Matrix<double, kPowers, kPowers>::Zero();
    Powers right = Powers::Zero();
    for (size_t i = 0; i < n; ++i) {
      const Powers weighted = weight[i] * powers[i];
      normal.noalias() += weighted * powers[i].transpose();
      right += double(pixels[i].grey) * weighted;
    }
    normal.diagonal().array() += 1e-6;
    const Powers grey = normal.ldlt().solve(right);
    for (size_t i = 0; i < n; ++i) residual[i] = std::abs(pixels[i].grey - powers[i].dot(grey));

    // A face half covered by something else must not set its own scale.
    sizes = residual;
    tolerance = std::clamp(3.5 * 1.4826 * median(&sizes), 4.0, 14.0);
    for (size_t i = 0; i < n; ++i) weight[i] = residual[i] < tolerance ? 1.0 : 0.02;
  }
  return int(std::count_if(residual.begin(), residual.end(), [&](double r) { return r > tolerance; }));
}

int countOffShading(const std::vector<FacePixel>& pixels, bool curved) {
  return curved ? countOffPolynomial<6>(pixels) : countOffPolynomial<3>(pixels);
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

// Pixels near a drawn line, within the box.
cv::Mat contourBand(const Candidate& candidate, const cv::Rect& box) {
  const int radius = int(kContourBand);
  cv::Mat lines = cv::Mat::zeros(box.height + 2 * radius, box.width + 2 * radius, CV_8U), band;
  for (const SeenSample& s : candidate.contour) {
    const int x = int(std::lround(s.uv.x())) - box.x + radius;
    const int y = int(std::lround(s.uv.y())) - box.y + radius;
    if (unsigned(x) < unsigned(lines.cols) && unsigned(y) < unsigned(lines.rows)) lines.at<uint8_t>(y, x) = 1;
  }
  cv::dilate(lines, band, cv::getStructuringElement(cv::MORPH_RECT, {2 * radius + 1, 2 * radius + 1}));
  return band(cv::Rect(radius, radius, box.width, box.height));
}

DrawnArea drawnArea(const std::vector<DrawnPixel>& pixels, const cv::Rect& box, int step) {
  DrawnArea area{box, step, cv::Mat_<uint8_t>::zeros(box.height / step + 2, box.width / step + 2)};
  for (const DrawnPixel& p : pixels) area.drawn((p.v - box.y) / step, (p.u - box.x) / step) = 1;
  return area;
}

// Drawn area over that of its convex hull.
double solidityOf(const std::vector<DrawnPixel>& pixels, int step) {
  if (pixels.size() < 3) return 0;
  std::vector<cv::Point2f> points, hull;
  for (const DrawnPixel& p : pixels) points.emplace_back(float(p.u), float(p.v));
  cv::convexHull(points, hull);
  const double area = cv::contourArea(hull) + step * cv::arcLength(hull, true) / 2 + step * step;
  return std::min(1.0, double(pixels.size()) * step * step / area);
}

// Cells of kCoverCell px, ascending.
std::vector<int> coveredCells(const std::vector<DrawnPixel>& pixels, const RectDomain& domain) {
  const int cells_x = (domain.width + kCoverCell - 1) / kCoverCell;
  std::vector<int> cells;
  cells.reserve(pixels.size());
  for (const DrawnPixel& p : pixels)
    cells.push_back(((p.v - domain.v0) / kCoverCell) * cells_x + (p.u - domain.u0) / kCoverCell);
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

// The image edge under a pixel or beside it; -1: none.
int edgeAt(const SearchImage& image, int u, int v) {
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const int edge = image.raster.indexAt(u + dx, v + dy);
      if (edge >= 0) return edge;
    }
  return -1;
}

// What the visible faces show inside the image.
struct FaceLook {
  std::map<int, std::vector<FacePixel>> by_surface;  // pixels away from drawn lines
  std::vector<ShadedPixel> shaded;                   // all
  std::map<int, int> pixels_of_trace;                // on edges that the model does not explain
  int interior = 0, unexplained = 0;
};

FaceLook lookAtFaces(const ObjectModel& model, const SearchImage& image, const Candidate& candidate,
                     const std::vector<DrawnPixel>& pixels) {
  const cv::Rect& box = candidate.bounding_box;
  const cv::Mat band = contourBand(candidate, box);
  FaceLook look;
  for (const DrawnPixel& p : pixels) {
    if (!image.domain.contains(p.u, p.v)) continue;
    const float grey = float(image.rect_grey.at<uint8_t>(p.v - image.domain.v0, p.u - image.domain.u0));
    look.shaded.push_back({normalInCamera(model, candidate, p), grey});
    std::vector<FacePixel>& face = look.by_surface[model.surface_of_triangle[p.triangle]];
    if (band.at<uint8_t>(p.v - box.y, p.u - box.x)) continue;

    face.push_back({float(p.u), float(p.v), grey});
    ++look.interior;
    const int edge = edgeAt(image, p.u, p.v);
    if (edge < 0) continue;
    ++look.unexplained;
    ++look.pixels_of_trace[image.trace_of_point[size_t(edge)]];
  }
  return look;
}

}  // namespace

void faceTerms(const ObjectModel& model, const SearchImage& image, Candidate* candidate) {
  const cv::Rect& box = candidate->bounding_box;
  if (box.area() <= 0) return;
  const int step = latticeStep(box, kMaxRays);
  const std::vector<DrawnPixel> drawn = drawnPixels(model, image, *candidate, step);
  const std::vector<DrawnPixel> seen = unhidden(drawn, image, *candidate);
  const FaceLook look = lookAtFaces(model, image, *candidate, seen);
  candidate->covered = coveredCells(seen, image.domain);

  int off = 0;
  for (const auto& [surface, pixels] : look.by_surface)
    off += countOffShading(pixels, model.surfaces[surface].kind != Surface::Kind::kPlane);
  const int leaving = countLeaving(image, look.pixels_of_trace, drawnArea(drawn, box, step));
  const auto ofInterior = [&](int count) { return look.interior > 0 ? double(count) / look.interior : 0; };

  EvidenceTerms& terms = candidate->terms;
  terms.faces = double(look.by_surface.size());
  terms.interior = ofInterior(look.unexplained);
  terms.through = ofInterior(leaving);
  terms.print = ofInterior(look.unexplained - leaving);
  terms.off_face = ofInterior(off);
  terms.shading = shadingExplained(look.shaded);
  terms.size = std::sqrt(double(drawn.size())) * step;
  terms.solidity = solidityOf(drawn, step);
}

}  // namespace monocular_eye_hand
