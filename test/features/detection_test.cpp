#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "monocular_eye_hand/features/features.h"
#include "monocular_eye_hand/features/gradient.h"
#include "monocular_eye_hand/geometry/error.h"
#include "support/refusal.h"
#include "synthetic.h"

namespace monocular_eye_hand {
namespace {

using ::testing::HasSubstr;

std::string refusalOf(const cv::Mat& image, const Camera& camera, const FeatureOptions& options = {}) {
  return refusal([&] { detectFeatures(image, camera, options); });
}

TEST(DetectFeatures, RefusesBadImages) {
  const Camera camera = testCamera(64, 48);
  EXPECT_THAT(refusalOf(cv::Mat(), camera), HasSubstr("empty"));
  EXPECT_THAT(refusalOf(cv::Mat(48, 64, CV_8UC3), camera), HasSubstr("CV_8UC3"));
  EXPECT_THAT(refusalOf(cv::Mat(48, 64, CV_16UC1), camera), HasSubstr("CV_16UC1"));
  EXPECT_THAT(refusalOf(cv::Mat(480, 640, CV_8UC1), camera), HasSubstr("640 x 480"));
}

TEST(DetectFeatures, RefusesBadOptionsByName) {
  const Camera camera = testCamera(64, 48);
  const cv::Mat image(48, 64, CV_8UC1, cv::Scalar(7));
  EXPECT_EQ(refusalOf(image, camera), "accepted");
  FeatureOptions fields;
  fields.visit([&](const char* name, auto& field) {
    const auto before = field;
    field = static_cast<std::decay_t<decltype(field)>>(-1);
    EXPECT_THAT(refusalOf(image, camera, fields), HasSubstr(name));
    field = before;
  });
  fields.split_tolerance = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusalOf(image, camera, fields), HasSubstr("split_tolerance"));
}

TEST(DetectFeatures, ImagesOfAnySize) {
  for (const auto& [width, height] :
       {std::pair{1, 1}, {1, 50}, {50, 1}, {2, 2}, {3, 3}, {5, 4}, {9, 9}, {17, 200}}) {
    std::mt19937 g(1);
    cv::Mat image(height, width, CV_8UC1);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) image.at<uchar>(y, x) = uchar(g());
    EXPECT_NO_THROW(detectFeatures(image, testCamera(width, height))) << width << " x " << height;
  }
}

TEST(DetectFeatures, NoiseAloneIsNoStructure) {
  const Camera camera = testCamera(640, 480);
  std::mt19937 g(11);
  for (double noise : {1.0, 3.0, 10.0}) {
    const FeatureSet features = detectFeatures(SyntheticScene(120).render(camera, noise, &g), camera);
    EXPECT_LE(features.traces.size(), 3u) << noise;
    EXPECT_LE(features.segments.size(), 3u) << noise;
    EXPECT_EQ(features.ellipses.size(), 0u) << noise;
  }
}

TEST(DetectFeatures, NoiseIsMeasured) {
  const Camera camera = testCamera(200, 150);
  std::mt19937 g(13);
  for (double noise : {1.0, 2.0, 5.0, 12.0}) {
    SyntheticScene scene(120);
    scene.add(randomPolygon(&g, {100, 75}, 50, 5, 180));
    const double expected =
        std::hypot(noise, std::sqrt(1 / 12.0));  // rounding to whole grey levels adds its own
    EXPECT_NEAR(imageNoise(scene.render(camera, noise, &g)), expected, 0.1 * expected);
  }
}

TEST(DetectFeatures, SameInputSameOutput) {
  const Camera camera = testCamera(320, 240);
  std::mt19937 g(17);
  SyntheticScene scene(90);
  for (int k = 0; k < 6; ++k)
    scene.add(randomPolygon(&g, {uniform(g, 40, 280), uniform(g, 40, 200)}, 35, 5, uniform(g, 20, 240)));
  const cv::Mat image = scene.render(camera, 4, &g);
  const FeatureSet a = detectFeatures(image, camera), b = detectFeatures(image.clone(), camera);
  ASSERT_EQ(a.segments.size(), b.segments.size());
  ASSERT_EQ(a.points.size(), b.points.size());
  ASSERT_EQ(a.arcs.size(), b.arcs.size());
  ASSERT_EQ(a.ellipses.size(), b.ellipses.size());
  for (size_t i = 0; i < a.segments.size(); ++i) {
    EXPECT_EQ(a.segments[i].p, b.segments[i].p);
    EXPECT_EQ(a.segments[i].q, b.segments[i].q);
    EXPECT_EQ(a.segments[i].piece_count, b.segments[i].piece_count);
  }

  EXPECT_EQ(a.joined_pieces, b.joined_pieces);
  EXPECT_EQ(a.ellipse_arcs, b.ellipse_arcs);
}

TEST(FeatureDetector, LeavesTheSetAloneWhenTheInputIsBad) {
  std::mt19937 g(18);
  SyntheticScene scene(90);
  scene.add(randomPolygon(&g, {80, 60}, 40, 4, 200));
  const Camera camera = testCamera(160, 120);
  const cv::Mat image = scene.render(camera, 1, &g);
  FeatureDetector first;
  FeatureDetector detector = std::move(first);
  FeatureSet features;
  detector.detect(image, camera, &features);
  const size_t points = features.points.size();
  EXPECT_GT(points, 100u);
  EXPECT_THROW(detector.detect(image, testCamera(320, 240), &features), BadInput);
  EXPECT_THROW(detector.detect(cv::Mat(), camera, &features), BadInput);
  EXPECT_EQ(features.points.size(), points);
  FeatureOptions options;
  options.min_trace_points = 0;
  EXPECT_THROW(FeatureDetector{options}, BadInput);
}

// Every index points into its vector, every run into its trace, every number is finite.
void expectConsistent(const FeatureSet& f) {
  size_t next = 0;
  for (const EdgeTrace& t : f.traces) {
    EXPECT_EQ(size_t(t.first), next);
    next += t.count;
  }
  EXPECT_EQ(next, f.points.size());

  for (const EdgePoint& p : f.points) {
    ASSERT_TRUE(p.uv.allFinite());
    ASSERT_NEAR(p.normal.norm(), 1, 1e-4);
    ASSERT_GT(p.sigma, 0);
  }

  const auto in_trace = [&](int trace, int first, int count) {
    ASSERT_LT(size_t(trace), f.traces.size());
    EXPECT_GE(first, f.traces[trace].first);
    EXPECT_LE(first + count, f.traces[trace].first + f.traces[trace].count);
  };
  int pieces = 0, arcs = 0;
  for (const LineSegment& s : f.segments) {
    ASSERT_TRUE(s.p.allFinite() && s.q.allFinite());
    EXPECT_GT(s.sigma_offset, 0);
    EXPECT_GT(s.sigma_angle, 0);
    if (!s.joined()) in_trace(s.trace, s.first, s.count);
    for (int piece : f.piecesOf(s)) EXPECT_FALSE(f.segments.at(size_t(piece)).joined());
    pieces += s.piece_count;
  }
  for (const EllipticArc& a : f.arcs) in_trace(a.trace, a.first, a.count);
  for (const DetectedEllipse& e : f.ellipses) {
    EXPECT_GE(e.ellipse.a, e.ellipse.b);
    EXPECT_TRUE(e.covariance.allFinite());
    EXPECT_GT(e.coverage, 0);
    EXPECT_LE(e.coverage, 1);
    for (int arc : f.arcsOf(e)) EXPECT_LT(size_t(arc), f.arcs.size());
    arcs += e.arc_count;
  }

  EXPECT_EQ(size_t(pieces), f.joined_pieces.size());
  EXPECT_EQ(size_t(arcs), f.ellipse_arcs.size());
}

TEST(DetectFeatures, IndicesAreConsistentOnClutter) {
  const Camera camera = testCamera(320, 240);
  std::mt19937 g(19);
  SyntheticScene scene(90);
  for (int k = 0; k < 25; ++k) {
    const Eigen::Vector2d c(uniform(g, 10, 310), uniform(g, 10, 230));
    if (k % 2)
      scene.add(randomPolygon(&g, c, uniform(g, 8, 50), 3 + k % 4, uniform(g, 20, 240)));
    else
      scene.add(
          FilledEllipse{{c, uniform(g, 15, 40), uniform(g, 6, 15), uniform(g, -1, 1)}, uniform(g, 20, 240)});
  }
  const FeatureSet features = detectFeatures(scene.render(camera, 3, &g), camera);
  EXPECT_GT(features.segments.size(), 40u);
  expectConsistent(features);
}

TEST(DetectFeatures, CheckerboardsStayBounded) {
  const Camera camera = testCamera(640, 480);
  for (int square : {2, 4, 8, 24}) {
    cv::Mat image(camera.height, camera.width, CV_8UC1);
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x) image.at<uchar>(y, x) = (x / square + y / square) % 2 ? 220 : 30;
    const FeatureSet features = detectFeatures(image, camera);
    expectConsistent(features);
    EXPECT_LT(features.segments.size(), 20000u) << square;
  }
}

TEST(DetectFeatures, RealAndRenderedImages) {
  const char* data = std::getenv("MONOCULAR_EYE_HAND_DATA");
  if (!data) GTEST_SKIP() << "MONOCULAR_EYE_HAND_DATA is not set: no images to look at";
  for (const std::string path :
       {"/workcell/dev/000001/gray/000003.png", "/workcell/dev/000002/gray/000005.png",
        "/workcell/dev/000003/gray/000007.png", "/real/cabinet/test/000001/gray/000004.png",
        "/real/cube/test/000001/gray/000004.png"}) {
    const cv::Mat image = cv::imread(data + path, cv::IMREAD_GRAYSCALE);
    ASSERT_FALSE(image.empty()) << data + path;
    const FeatureSet features = detectFeatures(image, testCamera(image.cols, image.rows));
    expectConsistent(features);
    int longer = 0;
    for (const LineSegment& s : features.segments) longer += s.length() > 40;
    EXPECT_GE(longer, 5) << path;
    EXPECT_LT(features.segments.size(), 4000u) << path;
  }
}

}  // namespace
}  // namespace monocular_eye_hand
