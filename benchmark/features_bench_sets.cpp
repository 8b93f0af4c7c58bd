#include "features_bench_sets.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgproc.hpp>

namespace monocular_eye_hand {
namespace {

constexpr int kWidth = 640, kHeight = 480;
constexpr int kShift = 4;  // fractional bits of cv::fillPoly's corners

using Random = std::mt19937_64;
double uniform(Random* random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(*random);
}

// A grey level `contrast` or more away from all others.
int otherGrey(Random* random, double low, double high, const std::vector<int>& others, int contrast) {
  for (;;) {
    const int v = int(uniform(random, low, high));
    bool apart = true;
    for (int other : others) apart = apart && std::abs(v - other) >= contrast;
    if (apart) return v;
  }
}

// Pixel centres lie at integers in the small image; `samples` of the big one make a pixel.
cv::Point fixedPoint(const Eigen::Vector2d& p, int samples) {
  const Eigen::Vector2d big = (p.array() + 0.5) * samples - 0.5;
  return {cvRound(big.x() * (1 << kShift)), cvRound(big.y() * (1 << kShift))};
}
void fillSampled(const Corners& corners, int grey, int samples, cv::Mat* big) {
  std::vector<cv::Point> points;
  for (const Eigen::Vector2d& c : corners) points.push_back(fixedPoint(c, samples));
  cv::fillPoly(*big, std::vector<std::vector<cv::Point>>{points}, grey, cv::LINE_8, kShift);
}

cv::Mat withNoise(cv::Mat image, double noise, Random* random) {
  std::normal_distribution<double> normal;
  for (size_t i = 0; i < image.total(); ++i)
    image.data[i] = cv::saturate_cast<uchar>(image.data[i] + noise * normal(*random));
  return image;
}
cv::Mat sampledPhotograph(const cv::Mat& big, double blur, double noise, Random* random) {
  cv::Mat image;
  cv::resize(big, image, {kWidth, kHeight}, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(image, image, {0, 0}, blur);
  return withNoise(image, noise, random);
}

double farthestCorner(const Corners& corners, Eigen::Vector2d* middle) {
  *middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& c : corners) *middle += c / double(corners.size());
  double max_distance = 0;
  for (const Eigen::Vector2d& c : corners) max_distance = std::max(max_distance, (c - *middle).norm());
  return max_distance;
}

PolygonImage polygonImage(double noise, bool exact, Random* random) {
  constexpr int kSamples = 8;
  const int ground = int(uniform(random, 40, 215));
  cv::Mat big(kHeight * kSamples, kWidth * kSamples, CV_8U, cv::Scalar(ground));
  cv::Mat area(kHeight, kWidth, CV_32F, cv::Scalar(ground));
  PolygonImage out;

  for (int tries = 0; out.polygons.size() < 4 && tries < 500; ++tries) {
    const double r = uniform(random, 35, 95), x = uniform(random, r + 8, kWidth - r - 8),
                 y = uniform(random, r + 8, kHeight - r - 8);
    bool apart = true;
    for (const Corners& other : out.polygons) {
      Eigen::Vector2d middle;
      const double reach = farthestCorner(other, &middle);
      apart = apart && (middle - Eigen::Vector2d(x, y)).norm() >= r + reach + 10;
    }
    if (!apart) continue;

    const int n = 3 + int(uniform(random, 0, 3));
    const double turn = uniform(random, 0, 2 * M_PI);
    Corners corners;
    for (int i = 0; i < n; ++i) {
      const double angle = turn + 2 * M_PI * (i + uniform(random, -.2, .2)) / n;
      corners.emplace_back(x + r * std::cos(angle), y + r * std::sin(angle));
    }
    const int grey = otherGrey(random, 10, 245, {ground}, 25);
    exact ? fillByArea(corners, grey, &area) : fillSampled(corners, grey, kSamples, &big);
    out.polygons.push_back(corners);
  }
  out.grey = exact ? photograph(area, 0.8, noise, random) : sampledPhotograph(big, 0.8, noise, random);
  return out;
}

bool clear(const std::vector<Ellipse>& ellipses, const Eigen::Vector2d& at, double reach) {
  for (const Ellipse& e : ellipses)
    if ((e.centre - at).norm() < e.a + reach + 6) return false;
  return true;
}
bool lineClear(const std::vector<Ellipse>& ellipses, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d ab = b - a;
  for (const Ellipse& e : ellipses) {
    const double t = std::min(1.0, std::max(0.0, (e.centre - a).dot(ab) / ab.squaredNorm()));
    if ((a + t * ab - e.centre).norm() < e.a + 6) return false;
  }
  return true;
}

void drawDistractors(const std::vector<Ellipse>& ellipses, int ground, int samples, Random* random,
                     cv::Mat* big) {
  for (int drawn = 0, tries = 0; drawn < 4 && tries < 300; ++tries) {
    const double r = uniform(random, 15, 60);
    const double x = uniform(random, r, kWidth - r), y = uniform(random, r, kHeight - r);
    if (!clear(ellipses, {x, y}, r)) continue;
    const double height = r * uniform(random, .5, 1.4), turn = uniform(random, 0, 180);
    const cv::RotatedRect box(cv::Point2f(float(x * samples), float(y * samples)),
                              cv::Size2f(float(r * 1.4 * samples), float(height * samples)), float(turn));
    cv::Point2f corners[4];
    box.points(corners);
    cv::fillConvexPoly(*big, std::vector<cv::Point>(corners, corners + 4),
                       otherGrey(random, 20, 235, {ground}, 30));
    ++drawn;
  }
  for (int drawn = 0, tries = 0; drawn < 4 && tries < 200; ++tries) {
    Eigen::Vector2d ends[2];
    for (Eigen::Vector2d& end : ends) {
      end.x() = uniform(random, 0, kWidth);
      end.y() = uniform(random, 0, kHeight);
    }
    if (!lineClear(ellipses, ends[0], ends[1])) continue;
    const auto big_point = [&](const Eigen::Vector2d& p) {
      return cv::Point(int(p.x()) * samples, int(p.y()) * samples);
    };
    cv::line(*big, big_point(ends[0]), big_point(ends[1]), int(uniform(random, 0, 255)), 2 * samples);
    ++drawn;
  }
}

// Covers a share of the ellipse by a rectangle whose one side lies on the chord between the two ends.
void drawOccluder(const Ellipse& e, double share, int grey, int samples, Random* random, cv::Mat* big) {
  const double from = uniform(random, 0, 2 * M_PI), sweep = share * 2 * M_PI;
  const Eigen::Vector2d a = e.at(from), u = (e.at(from + sweep) - a).normalized();
  Eigen::Vector2d n(-u.y(), u.x());
  if (n.dot(e.at(from + sweep / 2) - a) < 0) n = -n;
  double far = 0, low = 0, high = 0;
  for (int i = 0; i <= 100; ++i) {
    const Eigen::Vector2d d = e.at(from + sweep * i / 100) - a;
    far = std::max(far, d.dot(n));
    low = std::min(low, d.dot(u));
    high = std::max(high, d.dot(u));
  }
  std::vector<cv::Point> points;
  for (const Eigen::Vector2d& p :
       {Eigen::Vector2d(a + u * low), Eigen::Vector2d(a + u * high),
        Eigen::Vector2d(a + u * high + n * (far + 5)), Eigen::Vector2d(a + u * low + n * (far + 5))})
    points.emplace_back(cvRound((p.x() + .5) * samples), cvRound((p.y() + .5) * samples));
  cv::fillConvexPoly(*big, points, grey);
}

EllipseImage ellipseImage(double occlusion, double noise, Random* random) {
  constexpr int kSamples = 4;
  EllipseImage out;
  out.occlusion = occlusion;
  out.noise = noise;
  const int ground = int(uniform(random, 40, 215));
  cv::Mat big(kHeight * kSamples, kWidth * kSamples, CV_8U, cv::Scalar(ground));
  const size_t wanted = size_t(1 + int(uniform(random, 0, 5)));

  for (int tries = 0; out.ellipses.size() < wanted && tries < 300; ++tries) {
    Ellipse e;
    e.a = uniform(random, 12, 80);
    e.b = e.a * uniform(random, .3, 1);
    if (e.b < 7) continue;
    e.angle = uniform(random, 0, M_PI);
    e.centre.x() = uniform(random, e.a + 4, kWidth - e.a - 4);
    e.centre.y() = uniform(random, e.a + 4, kHeight - e.a - 4);
    if (clear(out.ellipses, e.centre, e.a)) out.ellipses.push_back(e);
  }

  drawDistractors(out.ellipses, ground, kSamples, random, &big);
  for (const Ellipse& e : out.ellipses) {
    const int grey = otherGrey(random, 10, 245, {ground}, 25);
    Corners corners;
    for (int i = 0; i < 720; ++i) corners.push_back(e.at(i * M_PI / 360));
    fillSampled(corners, grey, kSamples, &big);
    if (occlusion > 0)
      drawOccluder(e, occlusion, otherGrey(random, 10, 245, {ground, grey}, 25), kSamples, random, &big);
  }
  out.grey = sampledPhotograph(big, 0.7, noise, random);
  return out;
}

// Twice the signed area.
double doubleArea(const Corners& c) {
  double sum = 0;
  for (size_t i = 0; i < c.size(); ++i) {
    const Eigen::Vector2d &a = c[i], &b = c[(i + 1) % c.size()];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}
// The part of a polygon where sign * p[axis] <= sign * limit.
void clip(int axis, double sign, double limit, const Corners& in, Corners* out) {
  out->clear();
  for (size_t i = 0; i < in.size(); ++i) {
    const Eigen::Vector2d &a = in[i], &b = in[(i + 1) % in.size()];
    const double da = sign * (limit - a[axis]), db = sign * (limit - b[axis]);
    if (da >= 0) out->push_back(a);
    if ((da < 0) != (db < 0)) out->push_back(a + (b - a) * (da / (da - db)));
  }
}

}  // namespace

std::vector<PolygonImage> polygonSet(double noise, bool exact) {
  Random random(21);
  std::vector<PolygonImage> out;
  for (int i = 0; i < 60; ++i) out.push_back(polygonImage(noise, exact, &random));
  return out;
}

std::vector<EllipseImage> ellipseSet() {
  Random random(99);
  std::vector<EllipseImage> out;
  for (double occlusion : {0., .1, .2, .3, .4, .5})
    for (double noise : {2., 8.})
      for (int i = 0; i < 25; ++i) out.push_back(ellipseImage(occlusion, noise, &random));
  return out;
}

void fillByArea(const Corners& corners, double grey, cv::Mat* image) {
  double low = 1e9, high = -1e9;
  for (const Eigen::Vector2d& c : corners) {
    low = std::min(low, c.y());
    high = std::max(high, c.y());
  }
  Corners above, row, left, pixel;
  for (int y = std::max(0, int(low)); y <= std::min(image->rows - 1, int(high) + 1); ++y) {
    clip(1, -1, y - 0.5, corners, &above);
    clip(1, 1, y + 0.5, above, &row);
    if (row.empty()) continue;
    double x0 = 1e9, x1 = -1e9;
    for (const Eigen::Vector2d& c : row) {
      x0 = std::min(x0, c.x());
      x1 = std::max(x1, c.x());
    }
    for (int x = std::max(0, int(x0)); x <= std::min(image->cols - 1, int(x1) + 1); ++x) {
      clip(0, -1, x - 0.5, row, &left);
      clip(0, 1, x + 0.5, left, &pixel);
      float& v = image->at<float>(y, x);
      v += float(0.5 * std::fabs(doubleArea(pixel)) * (grey - v));
    }
  }
}

cv::Mat photograph(const cv::Mat& image, double blur, double noise, std::mt19937_64* random) {
  cv::Mat blurred;
  cv::GaussianBlur(image, blurred, {0, 0}, blur);
  std::normal_distribution<double> normal;
  cv::Mat out(image.size(), CV_8U);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      out.at<uchar>(y, x) = cv::saturate_cast<uchar>(blurred.at<float>(y, x) + noise * normal(*random));
  return out;
}

std::vector<BenchDataset> benchDatasets() {
  const char* root = std::getenv("MONOCULAR_EYE_HAND_DATA");
  std::vector<BenchDataset> out;
  if (!root) return out;
  for (auto [name, split] : {std::pair("workcell", "dev"), {"real/cabinet", "test"}, {"real/cube", "test"}}) {
    const std::string folder = std::string(root) + "/" + name;
    if (!std::filesystem::is_directory(folder)) continue;
    BenchDataset set{name, split, loadBopModels(folder + "/models"), loadBopSplit(folder, split)};
    out.push_back(std::move(set));
  }
  return out;
}

}  // namespace monocular_eye_hand
