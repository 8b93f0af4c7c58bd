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
  cv::Mat classes(edges.size(), CV_8U, cv::Scalar(kClasses - 1)), grown = edges.clone();
  for (int radius : {1, 1, 2, 4}) {  // cumulative 1, 2, 4, 8
    cv::dilate(grown, grown, cv::getStructuringElement(cv::MORPH_RECT, {2 * radius + 1, 2 * radius + 1}));
    cv::subtract(classes, grown, classes);
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

// A mask, 1 at an edge, for each orientation bin; every point counts for the two bins nearest its direction.
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
    edges[size_t(low)].at<uint8_t>(y, x) = 1;
    edges[size_t(low + 1) % kOrientationBins].at<uint8_t>(y, x) = 1;
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
    // The counters of all classes stand in one word: a pixel adds to it once, whatever its class.
    constexpr unsigned kBits = 12;
    static_assert(kBlock * kBlock < 1 << kBits && kClasses * kBits <= 64);
    uint64_t counters = 0;
    for (int y = block_y * kBlock; y < std::min(domain.height, (block_y + 1) * kBlock); ++y) {
      const uint8_t* row = classes.ptr<uint8_t>(y);
      const uint8_t* valid = validRow(domain, y);
      for (int x = block_x * kBlock; x < std::min(domain.width, (block_x + 1) * kBlock); ++x)
        if (!valid || valid[x]) counters += uint64_t(1) << (kBits * row[x]);
    }

    Histogram& histogram = counts_[index(block_x, block_y)];
    for (size_t c = 0; c < size_t(kClasses); ++c)
      histogram[c] = float((counters >> (kBits * c)) & ((1U << kBits) - 1));
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

// What the classes say, each where it is.
void fillPlane(int bin, const cv::Mat& classes, const Blocks& blocks, const RectDomain& domain,
               EvidencePlanes* planes) {
  constexpr int kRun = EvidencePlanes::kTile;
  static_assert(kBlock % kRun == 0);
  for (int y = 0; y < domain.height; ++y) {
    const uint8_t* row = classes.ptr<uint8_t>(y);
    const uint8_t* valid = validRow(domain, y);
    const EvidenceTable* tables = blocks.tablesOfRow(y);
    for (int first = 0; first < domain.width; first += kRun) {
      int8_t* values = planes->run(bin, first, y);
      const EvidenceTable& said = tables[first / kBlock];
      const int count = std::min(kRun, domain.width - first);
      for (int i = 0; i < count; ++i)
        if (!valid || valid[first + i]) values[i] = said[row[first + i]];
    }
  }
}

// Every second pixel of every second row.
void halvePlane(int bin, const EvidencePlanes& full, EvidencePlanes* half) {
  constexpr int kRun = EvidencePlanes::kTile;
  for (int y = 0; y < half->height(); ++y)
    for (int first = 0; first < half->width(); first += kRun) {
      int8_t* values = half->run(bin, first, y);
      for (int part = 0; part < 2; ++part) {
        const int from = 2 * first + part * kRun;
        if (from >= full.width()) break;
        const int8_t* wide = full.run(bin, from, 2 * y);
        for (int i = 0; i < kRun / 2; ++i) values[part * kRun / 2 + i] = wide[2 * i];
      }
    }
}

}  // namespace

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
    fillPlane(bin, classes, blocks, domain, &full_);
    halvePlane(bin, full_, &half_);
  });
}

}  // namespace monocular_eye_hand
