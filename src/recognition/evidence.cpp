#include "recognition/evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "recognition/shared_work.h"

namespace monocular_eye_hand {
namespace {

// Distance classes of the nearest edge point of the right direction: <= 1, <= 2, <= 4, <= 8, more [px].
constexpr int kClasses = 5;
// How visible contours of known parts fall into the classes (measured on rendered training scenes).
constexpr std::array<double, kClasses> kGivenObject{0.66, 0.12, 0.07, 0.05, 0.10};
constexpr int kBlock = 16;        // side of a statistics block [px]
constexpr int kWindowBlocks = 2;  // the background window reaches this many blocks to every side
constexpr double kLocalShare = 0.6;

using Histogram = std::array<float, kClasses>;
using EvidenceTable = std::array<int8_t, kClasses>;  // of a class, in map units

cv::Mat distanceClasses(const cv::Mat& edges) {
  // Nested dilations give the class by counting: 4 = far from every edge, 0 = within a pixel.
  cv::Mat classes(edges.size(), CV_8U, cv::Scalar(kClasses - 1)), grown = edges, next;
  for (int radius : {1, 1, 2, 4}) {  // cumulative 1, 2, 4, 8
    cv::dilate(grown, next, cv::getStructuringElement(cv::MORPH_RECT, {2 * radius + 1, 2 * radius + 1}));
    cv::subtract(classes, cv::Scalar(1), classes, next);
    grown = next.clone();
  }
  return classes;
}

EvidenceTable evidenceTable(const Histogram& background) {
  EvidenceTable table;
  for (int c = 0; c < kClasses; ++c) {
    const double nats = std::log(kGivenObject[c] / background[c]);
    table[c] = int8_t(std::clamp(std::lround(nats * kEvidenceUnit), -127L, 127L));
  }
  return table;
}

// Flags where the image covers a row of the domain; nullptr: everywhere.
const uint8_t* validRow(const RectDomain& domain, int y) {
  return domain.valid.empty() ? nullptr : domain.valid.ptr<uint8_t>(y);
}

// A mask for each orientation bin; every point counts for the two bins nearest its direction.
std::vector<cv::Mat> edgesByOrientation(const FeatureSet& features, const RectDomain& domain) {
  std::vector<cv::Mat> edges(kOrientationBins);
  for (cv::Mat& mask : edges) mask = cv::Mat::zeros(domain.height, domain.width, CV_8U);
  for (const EdgePoint& point : features.points) {
    const int x = int(std::lround(point.uv.x())) - domain.u0;
    const int y = int(std::lround(point.uv.y())) - domain.v0;
    if (unsigned(x) >= unsigned(domain.width) || unsigned(y) >= unsigned(domain.height)) continue;
    // Of the edge: the normal turned by 90 degrees.
    double angle = std::atan2(point.normal.x(), -point.normal.y());
    if (angle < 0) angle += M_PI;
    const int low = int(angle / M_PI * kOrientationBins) % kOrientationBins;
    edges[size_t(low)].at<uint8_t>(y, x) = 255;
    edges[size_t(low + 1) % kOrientationBins].at<uint8_t>(y, x) = 255;
  }
  return edges;
}

// What the classes of one orientation say, block by block, measured in a window around the block.
class Blocks {
 public:
  Blocks(const cv::Mat& classes, const RectDomain& domain)
      : columns_((domain.width + kBlock - 1) / kBlock),
        rows_((domain.height + kBlock - 1) / kBlock),
        counts_(size_t(columns_) * size_t(rows_)),
        tables_(counts_.size()) {
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x) count(classes, domain, x, y);
    const Histogram all = overall();
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x) tables_[index(x, y)] = evidenceTable(around(x, y, all));
  }

  // Of the blocks that a row of pixels passes.
  const EvidenceTable* tablesOfRow(int y) const { return &tables_[index(0, y / kBlock)]; }

 private:
  size_t index(int x, int y) const { return size_t(y) * size_t(columns_) + size_t(x); }

  void count(const cv::Mat& classes, const RectDomain& domain, int block_x, int block_y) {
    Histogram& histogram = counts_[index(block_x, block_y)];
    histogram.fill(0);
    for (int y = block_y * kBlock; y < std::min(domain.height, (block_y + 1) * kBlock); ++y) {
      const uint8_t* row = classes.ptr<uint8_t>(y);
      const uint8_t* valid = validRow(domain, y);
      for (int x = block_x * kBlock; x < std::min(domain.width, (block_x + 1) * kBlock); ++x)
        if (!valid || valid[x]) histogram[row[x]] += 1;
    }
  }

  // Shares of the classes in the whole image.
  Histogram overall() const {
    Histogram all{};
    for (const Histogram& histogram : counts_)
      for (int c = 0; c < kClasses; ++c) all[size_t(c)] += histogram[size_t(c)];
    float total = 0;
    for (float n : all) total += n;
    for (float& n : all) n = (n + 1.0f) / (total + kClasses);
    return all;
  }

  // Shares of the classes around a block.
  Histogram around(int block_x, int block_y, const Histogram& all) const {
    Histogram local{};
    float n = 0;
    for (int y = std::max(0, block_y - kWindowBlocks); y <= std::min(rows_ - 1, block_y + kWindowBlocks); ++y)
      for (int x = std::max(0, block_x - kWindowBlocks); x <= std::min(columns_ - 1, block_x + kWindowBlocks);
           ++x)
        for (int c = 0; c < kClasses; ++c) {
          local[size_t(c)] += counts_[index(x, y)][size_t(c)];
          n += counts_[index(x, y)][size_t(c)];
        }
    for (int c = 0; c < kClasses; ++c) {
      float& share = local[size_t(c)];
      const float here = n > 0 ? share / n : all[size_t(c)];
      // Half a percent is kept for every class: an empty neighbourhood must not make one edge decisive.
      share = float(kLocalShare) * here + float(1 - kLocalShare) * all[size_t(c)];
      share = 0.975f * share + 0.005f;
    }
    return local;
  }

  int columns_, rows_;
  std::vector<Histogram> counts_;
  std::vector<EvidenceTable> tables_;
};

}  // namespace

RectDomain rectDomain(const Camera& camera) {
  RectDomain domain;
  domain.width = camera.width;
  domain.height = camera.height;
  if (!camera.distorted()) return domain;
  // The image's border, rectified; kept within half an image of it, where any calibration is extrapolating.
  double lo_u = 1e9, lo_v = 1e9, hi_u = -1e9, hi_v = -1e9;
  const auto include = [&](double u, double v) {
    const Eigen::Vector2d p = camera.undistort({u, v});
    if (!p.allFinite()) return;
    lo_u = std::min(lo_u, p.x()), hi_u = std::max(hi_u, p.x());
    lo_v = std::min(lo_v, p.y()), hi_v = std::max(hi_v, p.y());
  };
  for (int u = 0; u < camera.width; u += 8) include(u, 0), include(u, camera.height - 1);
  for (int v = 0; v < camera.height; v += 8) include(0, v), include(camera.width - 1, v);
  include(camera.width - 1, camera.height - 1);
  const double w = camera.width, h = camera.height;

  domain.u0 = int(std::floor(std::max(lo_u, -w / 2)));
  domain.v0 = int(std::floor(std::max(lo_v, -h / 2)));
  domain.width = int(std::ceil(std::min(hi_u, 1.5 * w))) - domain.u0 + 1;
  domain.height = int(std::ceil(std::min(hi_v, 1.5 * h))) - domain.v0 + 1;
  domain.valid.create(domain.height, domain.width, CV_8UC1);
  for (int y = 0; y < domain.height; ++y)
    for (int x = 0; x < domain.width; ++x) {
      const Eigen::Vector2d raw = camera.distort({double(x + domain.u0), double(y + domain.v0)});
      const bool inside = raw.x() >= 0 && raw.y() >= 0 && raw.x() <= w - 1 && raw.y() <= h - 1;
      domain.valid.at<uint8_t>(y, x) = inside ? 255 : 0;
    }
  return domain;
}

cv::Mat rectifiedGrey(const cv::Mat& grey, const Camera& camera, const RectDomain& domain) {
  if (!camera.distorted()) return grey;
  cv::Mat map_u(domain.height, domain.width, CV_32F), map_v(domain.height, domain.width, CV_32F), out;
  for (int y = 0; y < domain.height; ++y)
    for (int x = 0; x < domain.width; ++x) {
      const Eigen::Vector2d raw = camera.distort({double(x + domain.u0), double(y + domain.v0)});
      map_u.at<float>(y, x) = float(raw.x());
      map_v.at<float>(y, x) = float(raw.y());
    }
  cv::remap(grey, out, map_u, map_v, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return out;
}

EvidencePlanes::EvidencePlanes(int width, int height)
    : width_(width),
      height_(height),
      tiles_x_((unsigned(width) + kTile - 1) / kTile),
      tiles_y_((unsigned(height) + kTile - 1) / kTile),
      values_(size_t(kOrientationBins) * tiles_x_ * tiles_y_ * kTile * kTile, kOutside) {}

EvidenceMap::EvidenceMap(const FeatureSet& features, const RectDomain& domain)
    : u0_(domain.u0),
      v0_(domain.v0),
      full_(domain.width, domain.height),
      half_((domain.width + 1) / 2, (domain.height + 1) / 2) {
  const std::vector<cv::Mat> edges = edgesByOrientation(features, domain);
  atOnce(kOrientationBins, [&](int bin) {
    const cv::Mat classes = distanceClasses(edges[size_t(bin)]);
    const Blocks blocks(classes, domain);
    for (int y = 0; y < domain.height; ++y) {
      const uint8_t* row = classes.ptr<uint8_t>(y);
      const uint8_t* valid = validRow(domain, y);
      const EvidenceTable* table = blocks.tablesOfRow(y);
      for (int x = 0; x < domain.width; ++x)
        if (!valid || valid[x]) full_.value(full_.index(bin, x, y)) = table[x / kBlock][row[x]];
    }
    for (int y = 0; y < half_.height(); ++y)
      for (int x = 0; x < half_.width(); ++x)
        half_.value(half_.index(bin, x, y)) = full_.at(bin, 2 * x, 2 * y);
  });
}

EdgeRaster::EdgeRaster(const FeatureSet& features, const RectDomain& domain)
    : points_(features.points.data()),
      u0_(domain.u0),
      v0_(domain.v0),
      width_(domain.width),
      height_(domain.height),
      index_(size_t(domain.width) * domain.height, -1) {
  const auto put = [&](int x, int y, int index, bool own) {
    if (unsigned(x) >= unsigned(width_) || unsigned(y) >= unsigned(height_)) return;
    int32_t& cell = index_[size_t(y) * width_ + x];
    if (cell < 0 || own) cell = index;
  };
  const auto& points = features.points;
  for (int pass = 0; pass < 2; ++pass)  // thickening first, so that a point's own pixel wins
    for (size_t i = 0; i < points.size(); ++i) {
      const int x = int(std::lround(points[i].uv.x())) - u0_, y = int(std::lround(points[i].uv.y())) - v0_;
      if (pass == 0) {
        put(x + 1, y, int(i), false);
        put(x, y + 1, int(i), false);
      } else {
        put(x, y, int(i), true);
      }
    }
}

int EdgeRaster::indexAt(double u, double v) const {
  const int x = int(std::lround(u)) - u0_, y = int(std::lround(v)) - v0_;
  if (unsigned(x) >= unsigned(width_) || unsigned(y) >= unsigned(height_)) return -1;
  return index_[size_t(y) * width_ + x];
}

int EdgeRaster::find(const Eigen::Vector2d& uv, const Eigen::Vector2d& normal, double range) const {
  const float nx = float(normal.x()), ny = float(normal.y());
  const float x0 = float(uv.x()) - u0_ + 0.5f, y0 = float(uv.y()) - v0_ + 0.5f;
  const int steps = int(std::lround(range));
  int best = -1, last = -1;
  float best_score = 0;
  const float inverse_range = 1.0f / float(range + 1.0);

  for (int k = -steps; k <= steps; ++k) {
    const float fx = x0 + nx * float(k), fy = y0 + ny * float(k);
    if (!(fx >= 0 && fy >= 0 && fx < float(width_) && fy < float(height_))) continue;
    const int index = index_[size_t(int(fy)) * width_ + int(fx)];
    if (index < 0 || index == last) continue;
    last = index;

    const EdgePoint& p = points_[index];
    const float along = std::fabs(p.normal.x() * nx + p.normal.y() * ny);
    if (along < 0.906f) continue;
    const float d = ((p.uv.x() - float(uv.x())) * nx + (p.uv.y() - float(uv.y())) * ny) * inverse_range;
    const float score = p.gradient * along * (1.05f - d * d);
    if (score > best_score) best_score = score, best = index;
  }
  return best;
}

}  // namespace monocular_eye_hand
