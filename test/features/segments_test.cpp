#include <gtest/gtest.h>

#include "monocular_eye_hand/features/features.h"
#include "support/camera.h"
#include "synthetic.h"

namespace monocular_eye_hand {
namespace {

struct Truth {
  Eigen::Vector2d a, b;
};

struct SegmentScore {
  int edges = 0, found = 0, fragments = 0, detected = 0, right = 0;
  std::vector<double> offset, corner;
  std::vector<double> normalized_offset;  // offset error over the reported standard deviation
};

// A detected segment lies on a true edge: within 3 degrees (more when short), 2 px, and overlapping it.
bool matches(const LineSegment& s, const Truth& t, double* from, double* to, double* offset) {
  const Eigen::Vector2d d = (t.b - t.a).normalized(), n(-d.y(), d.x()), w = s.direction();
  const double length = (t.b - t.a).norm();
  const double angle = std::asin(std::min(1.0, std::fabs(d.x() * w.y() - d.y() * w.x())));
  *offset = n.dot(0.5 * (s.p + s.q) - t.a);
  *from = std::min(d.dot(s.p - t.a), d.dot(s.q - t.a));
  *to = std::max(d.dot(s.p - t.a), d.dot(s.q - t.a));
  return angle < 0.05 * std::max(1.0, 30 / s.length()) && std::fabs(*offset) < 2 && *to > 2 &&
         *from < length - 2;
}

void score(const FeatureSet& features, const std::vector<Truth>& truth, SegmentScore* total) {
  std::vector<char> right(features.segments.size(), 0);
  for (const Truth& t : truth) {
    const double length = (t.b - t.a).norm();
    double covered = 0, longest = 0, best_offset = 0, sigma = 1, end_error = 0;
    int fragments = 0;
    for (size_t i = 0; i < features.segments.size(); ++i) {
      const LineSegment& s = features.segments[i];
      double from, to, offset;
      if (s.joined() || !matches(s, t, &from, &to, &offset)) continue;
      right[i] = 1;
      ++fragments;
      covered += std::min(to, length) - std::max(from, 0.0);
      if (to - from < longest) continue;
      longest = to - from;
      best_offset = offset;
      sigma = s.sigma_offset;
      const bool same = (s.q - s.p).dot(t.b - t.a) > 0;
      end_error = std::max((s.p - (same ? t.a : t.b)).norm(), (s.q - (same ? t.b : t.a)).norm());
    }

    ++total->edges;
    if (covered < 0.7 * length) continue;
    ++total->found;
    total->fragments += fragments;
    total->offset.push_back(std::fabs(best_offset));
    total->normalized_offset.push_back(std::fabs(best_offset) / sigma);
    total->corner.push_back(end_error);
  }

  for (size_t i = 0; i < right.size(); ++i) {
    if (features.segments[i].joined()) continue;
    ++total->detected;
    total->right += right[i];
  }
}

// Four polygons per image.
cv::Mat polygonImage(const Camera& camera, double noise, std::mt19937* g, std::vector<Truth>* truth) {
  const double background = uniform(*g, 40, 215);
  SyntheticScene scene(background);
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector2d centre((0.25 + 0.5 * (k % 2)) * camera.width,
                                 (0.25 + 0.5 * (k / 2)) * camera.height);
    const ConvexPolygon p = randomPolygon(g, centre, uniform(*g, 0.14, 0.2) * camera.width,
                                          3 + int(uniform(*g, 0, 3)), otherGrey(g, background, 30));
    scene.add(p);
    for (size_t i = 0; i < p.corners.size(); ++i)
      truth->push_back({p.corners[i], p.corners[(i + 1) % p.corners.size()]});
  }
  return scene.render(camera, noise, g);
}

SegmentScore scoreOf(double noise, int images, const Camera& camera) {
  std::mt19937 g(17);
  SegmentScore total;
  for (int i = 0; i < images; ++i) {
    std::vector<Truth> truth;
    const cv::Mat image = polygonImage(camera, noise, &g, &truth);
    score(detectFeatures(image, camera), truth, &total);
  }
  return total;
}

TEST(Segments, LittleNoise) {
  const SegmentScore s = scoreOf(2, 12, testCamera(400, 400));
  EXPECT_GE(s.found, 0.995 * s.edges) << s.edges;
  EXPECT_GE(s.right, 0.99 * s.detected);
  EXPECT_LE(s.fragments, 1.02 * s.found);
  EXPECT_LT(median(s.offset), 0.02);
  EXPECT_LT(median(s.corner), 0.12);
}

TEST(Segments, MuchNoise) {
  const SegmentScore s = scoreOf(8, 12, testCamera(400, 400));
  EXPECT_GE(s.found, 0.98 * s.edges) << s.edges;
  EXPECT_GE(s.right, 0.95 * s.detected);
  EXPECT_LE(s.fragments, 1.12 * s.found);
  EXPECT_LT(median(s.offset), 0.04);
  EXPECT_LT(median(s.corner), 0.35);
}

TEST(Segments, OffsetUncertaintyIsOfTheRightSize) {
  // The median of |N(0,1)| is 0.67.
  for (double noise : {2.0, 8.0}) {
    const double ratio = median(scoreOf(noise, 8, testCamera(400, 400)).normalized_offset);
    EXPECT_GT(ratio, 0.2) << noise;
    EXPECT_LT(ratio, 1.2) << noise;
  }
}

TEST(Segments, BrightSideIsOnTheNormal) {
  std::mt19937 g(3);
  std::vector<Truth> truth;
  const Camera camera = testCamera(300, 300);
  const cv::Mat image = polygonImage(camera, 2, &g, &truth);
  const FeatureSet features = detectFeatures(image, camera);
  const auto grey = [&](const Eigen::Vector2d& p) {
    return int(image.at<uchar>(int(std::lround(p.y())), int(std::lround(p.x()))));
  };
  ASSERT_GE(features.segments.size(), 12u);
  for (const LineSegment& s : features.segments) {
    if (s.length() < 15) continue;
    const Eigen::Vector2d d = s.direction(), n(d.y(), -d.x()), m = 0.5 * (s.p + s.q);
    EXPECT_GT(grey(m + 4 * n), grey(m - 4 * n) + 10);
    for (int i = s.first + 3; i < s.first + s.count - 3; ++i)
      EXPECT_GT(features.points[i].normal.dot(n.cast<float>()), 0.5f);
  }
}

TEST(Segments, DistortedLinesComeOutStraight) {
  const Camera camera = withLens(testCamera(320, 240), "plumb_bob", {-0.3, 0.1, 0.002, -0.001, 0});
  std::mt19937 g(5);
  SyntheticScene scene(60);
  ConvexPolygon frame;  // sides near the image border, where the distortion bends them by several pixels
  frame.corners = {{12, 12}, {306, 14}, {304, 228}, {14, 224}};
  frame.grey = 180;
  scene.add(frame);
  const cv::Mat image = scene.render(camera, 2, &g);
  std::vector<Truth> truth;
  for (int i = 0; i < 4; ++i) truth.push_back({frame.corners[i], frame.corners[(i + 1) % 4]});
  SegmentScore s;
  score(detectFeatures(image, camera), truth, &s);
  EXPECT_EQ(s.found, 4);
  EXPECT_EQ(s.fragments, 4);
  for (double offset : s.offset) EXPECT_LT(offset, 0.06);
  for (double corner : s.corner) EXPECT_LT(corner, 0.3);

  Camera ideal = camera;  // the same image without the calibration: bent lines
  ideal.model = DistortionModel::kNone;
  SegmentScore bent;
  score(detectFeatures(image, ideal), truth, &bent);
  EXPECT_LT(bent.found, 4);
}

TEST(Segments, CollinearPiecesAreJoinedAcrossAGap) {
  const Camera camera = testCamera(320, 240);
  std::mt19937 g(7);
  SyntheticScene scene(50);
  ConvexPolygon box, bar;
  box.corners = {{40, 60.3}, {280, 75.2}, {270, 190}, {45, 200}};
  box.grey = 150;
  bar.corners = {{140, 20}, {180, 20}, {185, 120}, {145, 120}};  // hides part of the upper side
  bar.grey = 235;
  scene.add(box);
  scene.add(bar);

  const FeatureSet features = detectFeatures(scene.render(camera, 2, &g), camera);
  const Truth whole{box.corners[0], box.corners[1]};
  int joined = 0;
  bool plain_over = false;
  for (const LineSegment& s : features.segments) {
    double from, to, offset;
    if (!s.joined()) {
      plain_over = plain_over || joined > 0;
      continue;
    }
    for (int piece : features.piecesOf(s)) {
      ASSERT_LT(size_t(piece), features.segments.size());
      EXPECT_FALSE(features.segments[piece].joined());
    }
    if (matches(s, whole, &from, &to, &offset) && from < 3 && to > (whole.b - whole.a).norm() - 3) {
      ++joined;
      EXPECT_LT(std::fabs(offset), 0.1);
      EXPECT_EQ(s.trace, -1);
    }
  }

  EXPECT_EQ(joined, 1);
  EXPECT_FALSE(plain_over) << "joined segments stand after the plain ones";
}

}  // namespace
}  // namespace monocular_eye_hand
