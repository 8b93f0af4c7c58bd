#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "features/ellipse_fitting.h"
#include "monocular_eye_hand/features/features.h"
#include "synthetic.h"

namespace monocular_eye_hand {
namespace {

// One ellipse per cell of a 4 x 3 grid of an image.
struct EllipseImage {
  cv::Mat image;
  std::vector<FilledEllipse> truth;
};
EllipseImage ellipseImage(const Camera& camera, double noise, double smallest, double largest,
                          std::mt19937* g) {
  EllipseImage out;
  const double background = uniform(*g, 60, 190);
  SyntheticScene scene(background);
  const double cell_u = camera.width / 4.0, cell_v = camera.height / 3.0;

  for (int k = 0; k < 12; ++k) {
    FilledEllipse e;
    e.ellipse.b = uniform(*g, smallest, largest);
    e.ellipse.a = std::min(largest * 1.4, e.ellipse.b * uniform(*g, 1.0, 2.0));
    e.ellipse.angle = uniform(*g, -M_PI / 2, M_PI / 2);
    e.ellipse.centre = {(k % 4 + 0.5) * cell_u + uniform(*g, -3, 3),
                        (k / 4 + 0.5) * cell_v + uniform(*g, -3, 3)};
    e.grey = otherGrey(g, background, 40);
    scene.add(e);
    out.truth.push_back(e);
  }
  out.image = scene.render(camera, noise, g);
  return out;
}

// The detected ellipse with the centre next to the true one and axes within 15 % (and half a pixel).
const DetectedEllipse* find(const FeatureSet& features, const Ellipse& truth) {
  for (const DetectedEllipse& d : features.ellipses)
    if ((d.ellipse.centre - truth.centre).norm() < 0.2 * truth.b + 0.5 &&
        std::fabs(d.ellipse.a - truth.a) < 0.15 * truth.a + 0.5 &&
        std::fabs(d.ellipse.b - truth.b) < 0.15 * truth.b + 0.5)
      return &d;
  return nullptr;
}

struct EllipseScore {
  int truth = 0, found = 0, detected = 0, inside_95 = 0, right_polarity = 0;
  std::vector<double> centre, axes, normalized;
};

EllipseScore scoreOf(double noise, double smallest, double largest, int images) {
  const Camera camera = testCamera(480, 360);
  std::mt19937 g(29);
  EllipseScore s;

  for (int i = 0; i < images; ++i) {
    const EllipseImage scene = ellipseImage(camera, noise, smallest, largest, &g);
    const FeatureSet features = detectFeatures(scene.image, camera);
    s.detected += int(features.ellipses.size());
    for (const FilledEllipse& t : scene.truth) {
      ++s.truth;
      const DetectedEllipse* d = find(features, t.ellipse);
      if (!d) continue;
      ++s.found;
      const Eigen::Vector2d error = d->ellipse.centre - t.ellipse.centre;
      s.centre.push_back(error.norm());
      s.axes.push_back(
          std::max(std::fabs(d->ellipse.a - t.ellipse.a), std::fabs(d->ellipse.b - t.ellipse.b)));
      const Eigen::Matrix2d covariance = d->covariance.topLeftCorner<2, 2>();
      s.normalized.push_back(error.dot(covariance.inverse() * error));
      s.inside_95 += s.normalized.back() < 5.99;  // chi-square, 2 degrees of freedom
      const double outside = double(scene.image.at<uchar>(2, 2));
      s.right_polarity += d->bright_inside == (t.grey > outside);
    }
  }
  return s;
}

TEST(Ellipses, BoltHoles) {  // 4 to 8 px
  const EllipseScore s = scoreOf(2, 4, 6, 10);
  EXPECT_GE(s.found, 0.97 * s.truth);
  EXPECT_LE(s.detected, s.found + 1);
  EXPECT_EQ(s.right_polarity, s.found);
  EXPECT_LT(median(s.centre), 0.05);
  EXPECT_LT(median(s.axes), 0.12);
}

TEST(Ellipses, Middling) {
  const EllipseScore s = scoreOf(2, 10, 36, 10);
  EXPECT_GE(s.found, 0.98 * s.truth);
  EXPECT_LE(s.detected, s.found + 1);
  EXPECT_LT(median(s.centre), 0.03);
  EXPECT_LT(median(s.axes), 0.05);
}

TEST(Ellipses, MuchNoise) {
  const EllipseScore s = scoreOf(8, 8, 36, 10);
  EXPECT_GE(s.found, 0.9 * s.truth);
  EXPECT_LE(s.detected, 1.05 * s.found);
  EXPECT_LT(median(s.centre), 0.12);
}

TEST(Ellipses, CovarianceIsOfTheRightSize) {
  for (double noise : {2.0, 6.0}) {
    const EllipseScore s = scoreOf(noise, 8, 36, 10);
    EXPECT_GE(s.inside_95, 0.85 * s.found) << noise;
    // Not merely large: the reported sizes must be near the errors, so many must lie outside of a third of
    // them.
    EXPECT_GT(median(s.centre), 0.0);
  }
}

TEST(Ellipses, PartlyHidden) {
  const Camera camera = testCamera(240, 200);
  std::mt19937 g(31);
  int found = 0;
  constexpr int kTries = 20;

  for (int i = 0; i < kTries; ++i) {
    SyntheticScene scene(70);
    FilledEllipse e;
    e.ellipse = {{120, 100}, uniform(g, 40, 60), uniform(g, 25, 38), uniform(g, -1.5, 1.5)};
    e.grey = 160;
    scene.add(e);
    ConvexPolygon cover;  // its straight side cuts off the part beyond +0.25 b
    const Eigen::Vector2d d(std::cos(e.ellipse.angle), std::sin(e.ellipse.angle)), n(-d.y(), d.x());
    const Eigen::Vector2d m = e.ellipse.centre + 0.25 * e.ellipse.b * n;
    cover.corners = {m - 90 * d, m + 90 * d, m + 90 * d + 60 * n, m - 90 * d + 60 * n};
    cover.grey = 110;
    scene.add(cover);
    const FeatureSet features = detectFeatures(scene.render(camera, 2, &g), camera);
    const DetectedEllipse* detected = find(features, e.ellipse);
    if (!detected) continue;
    ++found;
    EXPECT_GT(detected->coverage, 0.45);
    EXPECT_LT(detected->coverage, 0.7);
  }

  EXPECT_GE(found, 18);
}

TEST(Ellipses, HexagonsAreNone) {
  const Camera camera = testCamera(320, 240);
  std::mt19937 g(37);
  int ellipses = 0, segments = 0;
  for (int i = 0; i < 10; ++i) {
    SyntheticScene scene(80);
    for (int k = 0; k < 4; ++k)
      scene.add(randomPolygon(&g, {80.0 + 160 * (k % 2), 60.0 + 120 * (k / 2)}, uniform(g, 18, 45), 6, 190));
    const FeatureSet features = detectFeatures(scene.render(camera, 2, &g), camera);
    ellipses += int(features.ellipses.size());
    segments += int(features.segments.size());
  }
  EXPECT_LE(ellipses, 1);
  EXPECT_GE(segments, 10 * 4 * 6 * 0.97);
}

TEST(EllipseFit, ExactPoints) {
  const Ellipse truth{{101.5, 77.25}, 40, 17, 0.6};
  std::vector<EdgePoint> points;
  for (int i = 0; i < 90; ++i) {
    EdgePoint p;
    p.uv = truth.at(0.3 + 0.04 * i).cast<float>();
    p.sigma = 0.05f;
    points.push_back(p);
  }
  FitPoints taken;
  taken.assign(points, {{0, 90}}, 200);
  const EllipseFit direct = fitEllipseDirect(taken);
  ASSERT_TRUE(direct.valid);

  const EllipseFit fit = refineEllipse(taken, direct.ellipse, 10);
  ASSERT_TRUE(fit.valid);
  EXPECT_LT((fit.ellipse.centre - truth.centre).norm(), 1e-3);
  EXPECT_NEAR(fit.ellipse.a, truth.a, 1e-3);
  EXPECT_NEAR(fit.ellipse.b, truth.b, 1e-3);
  EXPECT_NEAR(fit.ellipse.angle, truth.angle, 1e-4);
  EXPECT_LT(fit.rms, 1e-3);
}

TEST(EllipseFit, DistanceJacobianIsTheDerivative) {
  const Ellipse e{{10, 20}, 30, 12, 0.4};
  const Eigen::Vector2d uv = e.at(1.1);
  const Eigen::Matrix<double, 1, 5> j = EllipseFrame(e).distanceJacobian(uv);
  const double h = 1e-6;
  for (int k = 0; k < 5; ++k) {
    Ellipse moved = e;
    double* fields[] = {&moved.centre.x(), &moved.centre.y(), &moved.a, &moved.b, &moved.angle};
    *fields[k] += h;
    EXPECT_NEAR(j[k], distanceTo(moved, uv).distance / h, 1e-4) << k;
  }
}

Ellipse changed(const Ellipse& e, const Eigen::Matrix<double, 5, 1>& by) {
  return {{e.centre.x() + by[0], e.centre.y() + by[1]}, e.a + by[2], e.b + by[3], e.angle + by[4]};
}

// An arc of a blurred ellipse with noise along the normals.
FitPoints noisyArc(const Ellipse& truth, double from, double sweep, double blur, double sigma,
                   std::mt19937* g) {
  std::vector<EdgePoint> points;
  const int n = int(std::fabs(sweep) * std::sqrt(truth.a * truth.b));
  std::normal_distribution<double> noise(0, sigma);
  for (int i = 0; i < n; ++i) {
    EdgePoint p;
    const Eigen::Vector2d on = truth.at(from + sweep * i / n);
    const Eigen::Vector2d outward = EllipseFrame(truth).distanceTo(on).normal;
    p.uv = (on + noise(*g) * outward).cast<float>();
    p.sigma = float(sigma);
    p.blur = float(blur);
    points.push_back(p);
  }
  const PointRange all{0, n};
  FitPoints taken;
  taken.assign(points, &all, 1, 200);
  return taken;
}

// Short arcs of small ellipses determine a mixture of centre and axes badly: along it a derivative that
// leaves out small terms leads away from the best ellipse.
TEST(EllipseFit, ReachesTheLeastSquares) {
  std::mt19937 g(7);
  int refined = 0;
  for (int k = 0; k < 200; ++k) {
    const double b = uniform(g, 4, 30);
    const Ellipse truth{{uniform(g, 50, 60), 80}, b * uniform(g, 1.1, 2.5), b, uniform(g, -1.5, 1.5)};
    const FitPoints points = noisyArc(truth, uniform(g, 0, 6), uniform(g, 1.8, 5), 1.2, 0.05, &g);
    const EllipseFit fit = refineEllipse(points, truth, 30);
    if (!fit.valid) continue;
    ++refined;
    const Eigen::Matrix<double, 5, 5> root = covarianceOf(fit).llt().matrixL();
    for (int j = 0; j < 5; ++j)
      for (double way : {-0.5, 0.5}) {
        const Ellipse beside = changed(fit.ellipse, way * root.col(j));
        EXPECT_GT(refineEllipse(points, beside, 0).chi2, fit.chi2 - 0.02)
            << "ellipse " << k << " column " << j;
      }
  }

  EXPECT_GT(refined, 190);
}

TEST(EllipseFit, IsNeverWorseThanItsStart) {
  std::mt19937 g(11);
  for (int k = 0; k < 300; ++k) {
    const double b = uniform(g, 2, 12);
    const Ellipse truth{{50, 80}, b * uniform(g, 1, 3), b, uniform(g, -1.5, 1.5)};
    const FitPoints points = noisyArc(truth, uniform(g, 0, 6), uniform(g, 1, 6), 1.0, 0.4, &g);
    Eigen::Matrix<double, 5, 1> by;
    for (int j = 0; j < 5; ++j) by[j] = uniform(g, -0.2, 0.2) * (j == 4 ? 1 : b);
    const Ellipse start = changed(truth, by);
    const EllipseFit fit = refineEllipse(points, start, 6);
    EXPECT_LE(fit.chi2, refineEllipse(points, start, 0).chi2) << k;
  }
}

TEST(EllipseFit, LineIsNone) {
  std::vector<EdgePoint> points(40);
  for (int i = 0; i < 40; ++i) points[i].uv = {float(i), 2.0f * float(i)};
  FitPoints taken;
  taken.assign(points, {{0, 40}}, 100);
  EXPECT_FALSE(fitEllipseDirect(taken).valid);
  taken.assign(points, {{0, 3}}, 100);
  EXPECT_FALSE(fitEllipseDirect(taken).valid);
}

}  // namespace
}  // namespace monocular_eye_hand
