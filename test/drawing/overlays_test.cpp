#include "monocular_eye_hand/drawing/overlays.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "model/build_model.h"
#include "monocular_eye_hand/geometry/error.h"
#include "support/camera.h"

using namespace monocular_eye_hand;

namespace {

Camera lens() { return withWebcamLens({640, 480, 620, 621, 322.7, 236.4, DistortionModel::kNone, {}}); }

cv::Mat greyImage() { return cv::Mat(480, 640, CV_8UC1, cv::Scalar(90)); }

// Picture pixels that drawing has changed.
cv::Mat changed(const Canvas& canvas) {
  const Canvas blank(greyImage(), canvas.camera());
  cv::Mat difference, grey;
  cv::absdiff(canvas.picture(), blank.picture(), difference);
  cv::cvtColor(difference, grey, cv::COLOR_BGR2GRAY);
  return grey > 25;
}

Mesh box() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back(i & 1 ? 0.06 : -0.06, i & 2 ? 0.02 : -0.02, i & 4 ? 0.05 : 0);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

Rigid3 boxPose() { return {expSO3({1.9, 0.25, -0.3}), {0.05, 0.02, 0.45}}; }

// Distance of `p` from the segment a b.
double distance(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double t = std::min(1.0, std::max(0.0, (p - a).dot(b - a) / (b - a).squaredNorm()));
  return (p - a - t * (b - a)).norm();
}

FeatureSet someFeatures() {
  FeatureSet features;
  features.camera = lens();
  for (int k = 0; k < 60; ++k) {
    EdgePoint point{};
    point.uv = Eigen::Vector2f(100.f + 5 * float(k), 120.f);
    point.normal = Eigen::Vector2f(0, 1);
    features.points.push_back(point);
  }

  features.traces = {{0, 60, false}};
  LineSegment plain{}, joined{};
  plain.p = {100, 120};
  plain.q = {395, 120};
  joined.p = {100, 300};
  joined.q = {250, 330};
  joined.piece_count = 2;
  features.joined_pieces = {0, 0};
  features.segments = {plain, joined};
  DetectedEllipse ellipse{};
  ellipse.ellipse = {{450, 300}, 60, 30, 0.4};
  ellipse.covariance.setIdentity();
  features.ellipses = {ellipse};
  return features;
}

}  // namespace

TEST(Canvas, PutsRectifiedPixelsWhereTheLensShowsThem) {
  Canvas canvas(greyImage(), lens());
  EXPECT_EQ(canvas.scale(), 2);
  EXPECT_EQ(canvas.picture().cols, 1280);
  const Eigen::Vector2d uv(560, 60);
  canvas.dot(uv, 3, {0, 0, 255});
  const cv::Moments m = cv::moments(changed(canvas), true);
  const Eigen::Vector2d drawn(m.m10 / m.m00, m.m01 / m.m00);
  const Eigen::Vector2d expected = (lens().distort(uv).array() + 0.5) * 2 - 0.5;
  EXPECT_LT((drawn - expected).norm(), 0.3);
  EXPECT_GT((lens().distort(uv) - uv).norm(), 3);  // the lens matters at this pixel
}

TEST(Canvas, BendsStraightLinesAsTheLensDoes) {
  Canvas canvas(greyImage(), lens());
  const Eigen::Vector2d p(40, 30), q(600, 30);
  canvas.line(p, q, {0, 0, 255}, 1);
  const cv::Mat seen = changed(canvas);
  ASSERT_GT(cv::countNonZero(seen), 800);
  for (double share = 0; share <= 1; share += 0.02) {
    const Eigen::Vector2d at = canvas.at(p + share * (q - p));
    EXPECT_GT(
        cv::countNonZero(seen(cv::Rect(int(std::lround(at.x())) - 1, int(std::lround(at.y())) - 1, 3, 3))),
        0);
  }
}

TEST(Canvas, LeavesOutWhatTheLensModelFoldsBack) {
  Canvas canvas(greyImage(), lens());
  // Far outside: the polynomial would bring some of these points back into the picture.
  for (int k = 0; k < 40; ++k)
    canvas.line({320 + 3000 * std::cos(0.16 * k), 240 + 3000 * std::sin(0.16 * k)},
                {320 + 1800 * std::cos(0.16 * k), 240 + 1800 * std::sin(0.16 * k)}, {0, 0, 255}, 2);
  EXPECT_EQ(cv::countNonZero(changed(canvas)), 0);
  canvas.line({NAN, 0}, {100, 100}, {0, 0, 255});
  canvas.dot({1e300, 0}, 3, {0, 0, 255});
  canvas.label({-1e9, 1e9}, "still inside", {255, 255, 255});
  EXPECT_GT(cv::countNonZero(changed(canvas)), 0);
}

TEST(Canvas, RefusesWhatDoesNotFit) {
  EXPECT_THROW(Canvas(cv::Mat(), lens()), BadInput);
  EXPECT_THROW(Canvas(cv::Mat(480, 640, CV_32FC1), lens()), BadInput);
  EXPECT_THROW(Canvas(cv::Mat(240, 320, CV_8UC1), lens()), BadInput);
  EXPECT_THROW(writePicture("/dev/null/all.png", greyImage()), BadInput);
}

TEST(Canvas, PicturesGoIntoNewFolders) {
  const std::string folder = testing::TempDir() + "/pictures_" + std::to_string(getpid());
  for (const char* name : {"/one.png", "/deep/er/two.png"}) {
    writePicture(folder + name, greyImage());
    EXPECT_EQ(cv::imread(folder + name).cols, greyImage().cols) << name;
  }
  std::filesystem::remove_all(folder);
}

/// Rows of the picture that its text touches.
int rowsOfCaption(int width, const PictureSize& size, const std::string& text) {
  Camera camera{width, width / 2, 2.0 * width, 2.0 * width, width / 2.0, width / 4.0, DistortionModel::kNone,
                {}};
  Canvas canvas(cv::Mat(width / 2, width, CV_8UC1, cv::Scalar(120)), camera, 1, size);
  canvas.caption(text);
  cv::Mat grey, rows;
  cv::cvtColor(canvas.picture(), grey, cv::COLOR_BGR2GRAY);
  cv::reduce(grey != 120, rows, 1, cv::REDUCE_MAX);
  return cv::countNonZero(rows);
}

TEST(Canvas, TextGrowsWithThePicture) {
  const int small = rowsOfCaption(640, {640, 800}, "text"), large = rowsOfCaption(3200, {640, 800}, "text");
  EXPECT_GT(small, 12);
  EXPECT_NEAR(large, 4 * small, 0.35 * large);
  EXPECT_EQ(rowsOfCaption(640, {640, 800}, "text"), rowsOfCaption(800, {640, 800}, "text"));
}

TEST(Canvas, LongCaptionsTakeSeveralLines) {
  const std::string sentence =
      "no candidate of any object has enough of its contour in the image to be told from the ground ";
  const int one = rowsOfCaption(640, {640, 800}, "no candidate"),
            two = rowsOfCaption(640, {640, 800}, sentence);
  EXPECT_GE(two, 2 * one - 4);
  EXPECT_GT(rowsOfCaption(640, {640, 800}, sentence + sentence + sentence), two);
}

TEST(Overlays, ObjectLiesOnItsProjectedEdgesAndHidesTheHiddenOnes) {
  const ObjectModel model = buildModel("box", box());
  Canvas canvas(greyImage(), lens());
  ObjectStyle style;
  style.axes = false;
  style.width = 1;
  drawObject(&canvas, model, boxPose(), style);
  const cv::Mat seen = changed(canvas);
  std::vector<cv::Point> pixels;
  cv::findNonZero(seen, pixels);
  ASSERT_GT(pixels.size(), 500u);

  // Every edge in short pieces, as the lens bends it.
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> pieces;
  const auto at = [&](const Eigen::Vector3d& p) { return canvas.at(lens().project(boxPose() * p)); };
  int visible_edges = 0;
  const Eigen::Vector3d eye = boxPose().inverse().translation;
  for (const ModelEdge& edge : model.edges) {
    const bool visible = edge.normal[0].dot(eye - edge.p) > 0 ||
                         edge.normal[1].dot(eye - edge.p) > 0;  // convex: facing is seeing
    const Eigen::Vector2d middle = at(0.5 * (edge.p + edge.q));
    const cv::Rect around(int(middle.x()) - 1, int(middle.y()) - 1, 4, 4);
    EXPECT_EQ(cv::countNonZero(seen(around)) > 0, visible);
    visible_edges += visible;
    for (int k = 0; k < 20 && visible; ++k)
      pieces.emplace_back(at(edge.p + (edge.q - edge.p) * (k / 20.0)),
                          at(edge.p + (edge.q - edge.p) * ((k + 1) / 20.0)));
  }
  EXPECT_GE(visible_edges, 7);  // two or three faces of a box
  EXPECT_LT(visible_edges, 12);

  for (const cv::Point& pixel : pixels) {
    double min_distance = 1e9;
    for (const auto& [a, b] : pieces)
      min_distance = std::min(min_distance, distance({pixel.x, pixel.y}, a, b));
    EXPECT_LT(min_distance, 4.0);  // half the dark rim below the line
  }
}

TEST(Overlays, AxesAndLabelAreDrawn) {
  const ObjectModel model = buildModel("box", box());
  ObjectStyle style;
  Canvas plain(greyImage(), lens());
  style.axes = false;
  drawObject(&plain, model, boxPose(), style);
  Canvas full(greyImage(), lens());
  style.axes = true;
  style.label = "box 0.97";
  drawObject(&full, model, boxPose(), style);
  EXPECT_GT(cv::countNonZero(changed(full)), cv::countNonZero(changed(plain)) + 300);

  const Eigen::Vector2d tip =
      full.at(lens().project(boxPose() * Eigen::Vector3d(0.8 * model.diameter / 3, 0, 0)));
  const cv::Vec3b colour = full.picture().at<cv::Vec3b>(int(std::lround(tip.y())), int(std::lround(tip.x())));
  EXPECT_GT(colour[2], 200);  // x is red
  EXPECT_LT(colour[1], 120);
  Rigid3 broken = boxPose();
  broken.translation.x() = NAN;
  EXPECT_THROW(drawObject(&full, model, broken, style), BadInput);
  Rigid3 behind = boxPose();
  behind.translation.z() = -0.5;
  Canvas nothing(greyImage(), lens());
  drawObject(&nothing, model, behind, style);
  EXPECT_EQ(cv::countNonZero(changed(nothing)), 0);
}

TEST(Overlays, FeaturesAreColouredByKind) {
  const FeatureSet features = someFeatures();
  const Camera camera = features.camera;
  const cv::Mat picture = segmentsPicture(greyImage(), features);
  const Canvas where(greyImage(), camera);
  const auto colour = [&](const cv::Mat& image, const Eigen::Vector2d& uv) {
    const Eigen::Vector2d at = where.at(uv);
    return image.at<cv::Vec3b>(int(std::lround(at.y())), int(std::lround(at.x())));
  };
  EXPECT_NE(colour(picture, {250, 120}), colour(picture, {175, 315}));  // plain, joined
  EXPECT_NE(colour(picture, {250, 120}), colour(picture, {250, 200}));  // drawn, not drawn
  const cv::Mat ellipses = ellipsesPicture(greyImage(), features);
  EXPECT_NE(colour(ellipses, features.ellipses[0].ellipse.at(1.0)), colour(ellipses, {250, 200}));
  EXPECT_NE(colour(tracesPicture(greyImage(), features), {250, 120}), colour(ellipses, {250, 120}));
  EXPECT_GT(cv::norm(featuresPicture(greyImage(), features), picture, cv::NORM_INF), 50);
}

TEST(Overlays, OnePicturePerKindOfGrouping) {
  const FeatureSet features = someFeatures();
  Grouping junction, ellipse;
  junction.kind = GroupingKind::kJunction;
  junction.segments = {0, 1};
  junction.weight = 0.6;
  junction.points = {{395, 120}, {100, 120}, {250, 330}};
  ellipse.kind = GroupingKind::kEllipse;
  ellipse.ellipses = {0};
  std::vector<Grouping> groupings{junction, ellipse, junction, junction};
  groupings[3].segments = {17, -1};  // indices out of range are skipped, not followed

  const std::vector<GroupingPicture> pictures = groupingPictures(greyImage(), features, groupings, 2);
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_EQ(pictures[0].kind, GroupingKind::kJunction);
  EXPECT_EQ(pictures[0].shown, 2);
  EXPECT_EQ(pictures[0].total, 3);
  EXPECT_EQ(pictures[1].total, 1);
  EXPECT_GT(cv::norm(pictures[0].picture, pictures[1].picture, cv::NORM_INF), 50);

  // Connected lines share a colour, single ones are grey.
  const Canvas where(greyImage(), features.camera);
  const auto colour = [&](const cv::Mat& image, const Eigen::Vector2d& uv) {
    const Eigen::Vector2d at = where.at(uv);
    return image.at<cv::Vec3b>(int(std::lround(at.y())), int(std::lround(at.x())));
  };
  const cv::Mat together = lineGroupsPicture(greyImage(), features, groupings);
  const cv::Mat apart = lineGroupsPicture(greyImage(), features, {});
  EXPECT_EQ(colour(together, {250, 120}), colour(together, {175, 315}));
  EXPECT_NE(colour(together, {250, 120}), colour(apart, {250, 120}));

  // What meets by chance connects nothing.
  const cv::Mat wary = lineGroupsPicture(greyImage(), features, groupings, 0.7);
  EXPECT_EQ(cv::norm(wary, apart, cv::NORM_INF), 0);
}
