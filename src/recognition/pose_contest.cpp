#include "recognition/pose_contest.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "recognition/drawn_pixels.h"

namespace monocular_eye_hand {
namespace {

// Lines that both draw.
constexpr double kMaxAcross = 3, kMaxAlongEdge = 4.5;  // apart, measured from a sample [px]
constexpr double kSameWay = 0.85;                      // |cos| of the angle between

// Lines of one's own. The shares are drawn towards what is usual, as if so many more samples were there.
constexpr double kAnswersWithin = 0.75;  // from its edge [px]
constexpr double kMinEdgeCosine = 0.96;  // |cos| of the angle to its edge
constexpr double kUsualPrecise = 0.25;
constexpr double kPriorPrecise = 4, kPriorContrast = 3;  // [samples]
constexpr double kMaxStrength = 6;                       // standard deviations of the noise
constexpr double kMinNoise = 0.7;                        // of the 8 bits [grey levels]

// Faces.
constexpr size_t kMinTurnedPixels = 40;
constexpr float kOtherWay = 0.94f;  // cos of the angle between faces that look different ways
constexpr double kMinResidual = 2;  // [grey levels]
constexpr double kPriorArea = 20;   // [px^2]
constexpr double kManySamples = 5;  // from which on more of the same says less

// Grey of the rectified image between its pixels; `beside` tells what lies outside.
double greyAt(const SearchImage& image, const Eigen::Vector2d& uv, double beside) {
  const double x = uv.x() - image.domain.u0, y = uv.y() - image.domain.v0;
  const int i = int(std::floor(x)), j = int(std::floor(y));
  if (i < 0 || j < 0 || i + 1 >= image.rect_grey.cols || j + 1 >= image.rect_grey.rows) return beside;
  const double a = x - i, b = y - j;
  const auto* upper = image.rect_grey.ptr<uint8_t>(j) + i;
  const auto* lower = image.rect_grey.ptr<uint8_t>(j + 1) + i;
  return (1 - b) * ((1 - a) * upper[0] + a * upper[1]) + b * ((1 - a) * lower[0] + a * lower[1]);
}

// Largest step of grey across a line parallel to the drawn one, `from` to `to` px beside it.
double largestStep(const SearchImage& image, const SeenSample& s, double from, double to) {
  const Eigen::Vector2d normal = s.normal();
  const double middle = greyAt(image, s.uv, 0);
  double largest = 0;
  for (double across = from; across <= to; across += 0.5) {
    double step = 0;
    for (double along = -1.5; along <= 1.5; along += 1) {
      const Eigen::Vector2d uv = s.uv + across * normal + along * s.direction;
      step += greyAt(image, uv + normal, middle) - greyAt(image, uv - normal, middle);
    }
    largest = std::max(largest, std::abs(step) / 4);
  }
  return largest;
}

bool drawnBy(const std::vector<SeenSample>& contour, const SeenSample& s) {
  return std::any_of(contour.begin(), contour.end(), [&](const SeenSample& other) {
    const Eigen::Vector2d apart = other.uv - s.uv;
    return std::abs(apart.dot(s.direction)) < kMaxAlongEdge && std::abs(apart.dot(s.normal())) < kMaxAcross &&
           std::abs(other.direction.dot(s.direction)) > kSameWay;
  });
}

bool preciselyAnswered(const SearchImage& image, const SeenSample& s) {
  if (s.edge_point < 0) return false;
  const EdgePoint& point = image.raster.point(s.edge_point);
  return std::abs(s.normal().dot(point.uv.cast<double>() - s.uv)) <= kAnswersWithin &&
         std::abs(s.normal().dot(point.normal.cast<double>())) >= kMinEdgeCosine;
}

// How the image answers the lines that one pose draws and the other does not.
struct OwnLines {
  int samples = 0, precise = 0;
  double contrast = 0, strength = 0;  // sums over the samples

  double preciseShare() const {
    return (precise + kUsualPrecise * kPriorPrecise) / (samples + kPriorPrecise);
  }
  double meanContrast() const { return contrast / (samples + kPriorContrast); }
  double meanStrength() const { return strength / (samples + kPriorContrast); }
};

OwnLines ownLines(const SearchImage& image, const Candidate& candidate, const Candidate& other) {
  const double noise = std::max(kMinNoise, 0.7 * image.grey_noise);
  OwnLines own;
  for (const SeenSample& s : candidate.contour) {
    if (!s.inside || drawnBy(other.contour, s)) continue;
    const double on = largestStep(image, s, -1, 1);
    const double beside = std::max(largestStep(image, s, -4, -2.5), largestStep(image, s, 2.5, 4));
    ++own.samples;
    own.precise += preciselyAnswered(image, s);
    own.contrast += std::log((on * on + noise * noise) / (beside * beside + noise * noise));
    own.strength += std::min(kMaxStrength, on / noise);
  }
  return own;
}

// How much less of the greys `a` leaves unexplained than `b`, where the two look different ways.
double shadingContest(const LitFaces& a, const LitFaces& b) {
  if (std::min(a.by_pixel.size(), b.by_pixel.size()) < kMinTurnedPixels) return 0;
  const double scale = std::max(kMinResidual, 1.4826 * std::min(a.light.residual, b.light.residual));
  const auto misfit = [scale](const LitFaces& faces, const ShadedPixel& pixel) {
    const double residual = (pixel.grey - faces.light.grey(pixel.normal)) / scale;
    return std::log(1 + residual * residual / 2);
  };

  double less = 0, pixels = 0;
  for (const auto& [place, in_a] : a.by_pixel) {
    const auto in_b = b.by_pixel.find(place);
    if (in_b == b.by_pixel.end() || in_a.normal.dot(in_b->second.normal) > kOtherWay) continue;
    less += misfit(b, in_b->second) - misfit(a, in_a);
    ++pixels;
  }
  const double area = a.step * a.step;
  const double standardised = less * area / std::sqrt(pixels * area + kPriorArea);
  return std::copysign(std::log1p(std::abs(standardised) / kManySamples), standardised);
}

}  // namespace

LitFaces litFaces(const ObjectModel& model, const SearchImage& image, const Candidate& candidate, int step) {
  LitFaces faces;
  faces.step = step;
  std::vector<ShadedPixel> pixels;
  for (const DrawnPixel& p : unhidden(drawnPixels(model, image, candidate, step), image, candidate)) {
    if (!image.domain.contains(p.u, p.v)) continue;
    const float grey = image.rect_grey.at<uint8_t>(p.v - image.domain.v0, p.u - image.domain.u0);
    pixels.push_back({normalInCamera(model, candidate, p), grey});
    faces.by_pixel.emplace(std::make_pair(p.v, p.u), pixels.back());
  }
  if (pixels.size() >= kMinTurnedPixels) faces.light = fitLight(pixels);
  return faces;
}

PoseContest contestBetween(const SearchImage& image, const Contestant& first, const Contestant& second) {
  const OwnLines firsts = ownLines(image, first.candidate, second.candidate);
  const OwnLines seconds = ownLines(image, second.candidate, first.candidate);
  PoseContest contest;
  contest.log_odds = first.log_odds - second.log_odds;
  contest.precise = firsts.preciseShare() - seconds.preciseShare();
  contest.contrast = firsts.meanContrast() - seconds.meanContrast();
  contest.strength = firsts.meanStrength() - seconds.meanStrength();
  contest.shading = shadingContest(first.faces, second.faces);
  return contest;
}

}  // namespace monocular_eye_hand
