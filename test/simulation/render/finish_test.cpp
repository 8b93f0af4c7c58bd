#include "monocular_eye_hand/simulation/finish.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/simulation/render/render.h"
#include "monocular_eye_hand/simulation/scenes/random_picture.h"
#include "render/pinhole.h"
#include "support/camera.h"

using namespace monocular_eye_hand;

namespace {

RenderOptions quickNoiseless() {
  RenderOptions options;
  options.samples = options.edge_samples = 2;
  options.noise_sigma = options.shot_noise = options.blur_sigma = 0;
  options.exposure = 0.8;
  return options;
}

// A block in even light, seen from above and from the side.
Scene blockScene(const Finish& finish) {
  Scene scene;
  scene.table.material = {0.2, 0, 20, {}};
  scene.lights.clear();
  scene.ambient = 1;
  SceneObject block{"block", 0, std::make_shared<Mesh>(boxMesh({0.08, 0.06, 0.05})), {}, {0.5, 0, 20, {}}};
  block.material.finish = std::make_shared<Finish>(finish);
  scene.objects = {block};
  scene.world_from_camera = lookFrom(-1.2, 0.8, 0.35, {0, 0, 0.02});
  return scene;
}

cv::Mat rendered(const Scene& scene, const RenderOptions& options = quickNoiseless()) {
  return renderScene(scene, pinhole(), options).grey;
}

cv::Point pixelOf(const Scene& scene, const Eigen::Vector3d& world) {
  const Eigen::Vector2d uv = pinhole().project(scene.world_from_camera.inverse() * world);
  return {int(std::lround(uv.x())), int(std::lround(uv.y()))};
}

/// Black ink, as a whole rectangle, on the block's top.
Print blackSquare() {
  Print print;
  print.object_from_print.translation = {0.01, 0, 0.05};
  print.width = print.height = 0.02;
  print.picture = cv::Mat_<cv::Vec2f>(8, 8, cv::Vec2f(0, 1));
  return print;
}

/// What a pixel covers is changed: pixels of `a` and `b` that differ.
cv::Mat1b changed(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  return difference > 2;
}

cv::Mat1b polygonMask(const Scene& scene, const std::vector<Eigen::Vector3d>& corners) {
  std::vector<cv::Point> points;
  for (const Eigen::Vector3d& corner : corners) points.push_back(pixelOf(scene, corner));
  cv::Mat1b mask(240, 320, uchar(0));
  cv::fillConvexPoly(mask, points, cv::Scalar(255));
  return mask;
}

}  // namespace

TEST(Prints, ColourTheirPlaceAndNothingElse) {
  Finish finish;
  const Scene plain = blockScene(finish);
  finish.prints = {blackSquare()};
  const Scene printed = blockScene(finish);
  const cv::Mat before = rendered(plain), after = rendered(printed);
  const cv::Mat1b differs = changed(before, after);

  const double z = 0.05;
  cv::Mat1b place = polygonMask(plain, {{0, -0.01, z}, {0.02, -0.01, z}, {0.02, 0.01, z}, {0, 0.01, z}});
  cv::Mat1b inside, around;
  cv::erode(place, inside, cv::Mat());
  cv::dilate(place, around, cv::Mat());
  ASSERT_GT(cv::countNonZero(inside), 100);
  EXPECT_EQ(cv::countNonZero(differs & ~around), 0) << "off the print nothing changes";
  EXPECT_EQ(cv::countNonZero(~differs & inside), 0);
  double max_grey = 0;
  cv::minMaxLoc(after, nullptr, &max_grey, nullptr, nullptr, inside);
  EXPECT_LT(max_grey, 3) << "black ink";
}

TEST(Prints, StayOnTheirFace) {
  // A print hanging over the border of the top: the side below shows nothing of it.
  Finish finish;
  const cv::Mat before = rendered(blockScene(finish));
  Print print = blackSquare();
  print.object_from_print.translation = {0, -0.03, 0.05};
  finish.prints = {print};
  const Scene scene = blockScene(finish);
  const cv::Mat1b differs = changed(before, rendered(scene));
  cv::Mat1b side = polygonMask(
      scene, {{-0.04, -0.03, 0.046}, {0.04, -0.03, 0.046}, {0.04, -0.03, 0.002}, {-0.04, -0.03, 0.002}});
  EXPECT_GT(cv::countNonZero(differs), 50);
  EXPECT_EQ(cv::countNonZero(differs & side), 0);
}

TEST(Prints, AreNeitherMirroredNorUpsideDown) {
  Finish finish;
  Print print = blackSquare();
  print.object_from_print.translation = {0, 0, 0.05};
  print.picture = cv::Mat_<cv::Vec2f>(2, 2, cv::Vec2f(0, 0));
  print.picture(0, 0) = {0, 1};  // ink in the top left quarter
  finish.prints = {print};
  Scene scene = blockScene(finish);
  scene.world_from_camera = lookFrom(-M_PI / 2, 1.5, 0.35, {0, 0, 0.02});  // y is up in the image
  const cv::Mat grey = rendered(scene);
  const auto at = [&](double x, double y) { return int(grey.at<uchar>(pixelOf(scene, {x, y, 0.05}))); };
  EXPECT_LT(at(-0.008, 0.008), 10);
  for (const int other : {at(0.008, 0.008), at(-0.008, -0.008), at(0.008, -0.008)}) EXPECT_GT(other, 80);
}

TEST(Prints, BadOnesAreRefused) {
  Finish finish;
  finish.prints = {blackSquare()};
  finish.prints[0].picture.release();
  EXPECT_THROW(rendered(blockScene(finish)), BadInput);
  finish.prints = {blackSquare()};
  finish.prints[0].width = 0;
  EXPECT_THROW(rendered(blockScene(finish)), BadInput);
}

namespace {

/// A lamp so placed that neither the top nor the side mirrors it, but what lies between them does.
Scene litBlock(double radius) {
  Finish finish;
  finish.edge_radius = radius;
  Scene scene = blockScene(finish);
  scene.objects[0].material.specular = 0.6;
  scene.objects[0].material.shininess = 150;
  scene.ambient = 0.3;
  scene.world_from_camera = lookFrom(-M_PI / 2, 0.7, 0.30, {0, -0.03, 0.05});
  const Eigen::Vector3d bisector = Eigen::Vector3d(0, -1, 1).normalized();
  const Eigen::Vector3d edge(0, -0.03, 0.05);
  const Eigen::Vector3d to_eye = (scene.world_from_camera.translation - edge).normalized();
  const Eigen::Vector3d to_light = 2 * to_eye.dot(bisector) * bisector - to_eye;
  scene.lights = {{edge + 0.8 * to_light, 0.02, 0.3}};
  return scene;
}

/// Grey levels down across the front edge of the top, in the image's middle column.
int peakOverFaces(const Scene& scene) {
  const cv::Mat grey = rendered(scene);
  const cv::Point edge = pixelOf(scene, {0, -0.03, 0.05});
  int peak = 0;
  for (int dy = -2; dy <= 2; ++dy) peak = std::max(peak, int(grey.at<uchar>(edge.y + dy, edge.x)));
  return peak - std::max(grey.at<uchar>(edge.y - 8, edge.x), grey.at<uchar>(edge.y + 8, edge.x));
}

}  // namespace

TEST(RoundedEdge, CatchesTheLightThatBothFacesMiss) {
  EXPECT_GT(peakOverFaces(litBlock(0.001)), 25);
  EXPECT_LE(peakOverFaces(litBlock(0)), 1) << "a sharp edge shows no line";
}

TEST(RoundedEdge, ChangesNothingAwayFromIt) {
  const Scene sharp = litBlock(0), rounded = litBlock(0.001);
  const cv::Mat1b differs = changed(rendered(sharp), rendered(rounded));
  cv::Mat1b top = polygonMask(
      sharp, {{-0.038, -0.027, 0.05}, {0.038, -0.027, 0.05}, {0.038, 0.027, 0.05}, {-0.038, 0.027, 0.05}});
  EXPECT_GT(cv::countNonZero(differs), 100);
  EXPECT_EQ(cv::countNonZero(differs & top), 0);
}

TEST(RoundedEdge, TessellatedWallsHaveNone) {
  // The facets of a cylinder meet at 6 degrees: they are one surface.
  Finish finish;
  Scene scene = blockScene(finish);
  scene.objects[0].mesh = std::make_shared<Mesh>(cylinderMesh(0.03, 0.05));
  scene.lights = {Light{}};
  const cv::Mat before = rendered(scene);
  finish.edge_radius = 0.0005;
  scene.objects[0].material.finish = std::make_shared<Finish>(finish);
  const cv::Mat1b differs = changed(before, rendered(scene));
  const cv::Point middle = pixelOf(scene, {0.03 * std::cos(-1.2), 0.03 * std::sin(-1.2), 0.025});
  EXPECT_EQ(cv::countNonZero(differs(cv::Rect(middle.x - 12, middle.y - 8, 25, 17))), 0);
  EXPECT_GT(cv::countNonZero(differs), 10) << "its rim is rounded";
}

TEST(Wear, BrightensConvexEdgesOnly) {
  Finish finish;
  const cv::Mat before = rendered(blockScene(finish));
  finish.wear = 0.8;
  finish.wear_width = 0.004;
  const Scene scene = blockScene(finish);
  const cv::Mat after = rendered(scene);
  const auto rise = [&](const Eigen::Vector3d& p) {
    return int(after.at<uchar>(pixelOf(scene, p))) - int(before.at<uchar>(pixelOf(scene, p)));
  };
  int worn = 0;
  for (double x = -0.035; x <= 0.035; x += 0.0025) worn += rise({x, -0.0295, 0.05}) > 10;
  EXPECT_GT(worn, 10);
  EXPECT_EQ(rise({0, 0, 0.05}), 0);
}

TEST(Gloss, MirrorsWhatStandsBefore) {
  // A dark mirror on the table before a bright post: the post's image lies in it.
  Scene scene;
  scene.table.material = {0.05, 0, 20, {}};
  scene.lights.clear();
  scene.ambient = 1;
  scene.environment.low = scene.environment.high = 0.1;
  SceneObject mirror{"mirror", 0, std::make_shared<Mesh>(boxMesh({0.12, 0.10, 0.01})), {}, {0.05, 0, 20, {}}};
  Finish finish;
  finish.roughness = 0;
  SceneObject post{"post", 1, std::make_shared<Mesh>(boxMesh({0.02, 0.02, 0.10})), {}, {0.9, 0, 20, {}}};
  post.world_from_object.translation = {0, 0.065, 0};
  scene.world_from_camera = lookFrom(-M_PI / 2, 0.6, 0.4, {0, 0, 0.02});
  const Eigen::Vector3d eye = scene.world_from_camera.translation;

  // Where the ray to the mirrored point of the post crosses the mirror.
  const Eigen::Vector3d image(0, 0.055, 0.02 - 0.06);
  const Eigen::Vector3d crossing = eye + (eye.z() - 0.01) / (eye.z() - image.z()) * (image - eye);
  const auto grey = [&](double gloss, const Eigen::Vector3d& p) {
    finish.gloss = gloss;
    mirror.material.finish = std::make_shared<Finish>(finish);
    scene.objects = {mirror, post};
    return int(rendered(scene).at<uchar>(pixelOf(scene, p)));
  };

  ASSERT_LT(std::abs(crossing.y()), 0.045);
  const Eigen::Vector3d aside = crossing + Eigen::Vector3d(0.04, 0, 0);
  EXPECT_LE(std::abs(grey(0, crossing) - grey(0, aside)), 1);
  EXPECT_GT(grey(0.5, crossing) - grey(0.5, aside), 50);
}

TEST(Gloss, ShowsThePanelsOfTheSurroundings) {
  Finish finish;
  finish.gloss = 0.5;
  finish.roughness = 0;
  Scene scene = blockScene(finish);
  const cv::Point top = pixelOf(scene, {0, 0, 0.05});
  const Eigen::Vector3d to_top =
      (Eigen::Vector3d(0, 0, 0.05) - scene.world_from_camera.translation).normalized();
  Environment::Panel panel;
  panel.direction = {to_top.x(), to_top.y(), -to_top.z()};  // as the top reflects it
  panel.radiance = 1.2;
  const int without = rendered(scene).at<uchar>(top);
  scene.environment.panels = {panel};
  EXPECT_GT(int(rendered(scene).at<uchar>(top)), without + 40);
}

TEST(Translucency, ShowsWhatIsBehind) {
  Finish finish;
  Scene scene = blockScene(finish);
  scene.table.material.texture = {Texture::Kind::kChecker, 0.015, 0.9, 0};
  const cv::Rect on_block(pixelOf(scene, {0, 0, 0.05}) - cv::Point(8, 5), cv::Size(17, 11));
  const auto contrast = [&](double translucency) {
    finish.translucency = translucency;
    scene.objects[0].material.finish = std::make_shared<Finish>(finish);
    cv::Scalar mean, deviation;
    cv::meanStdDev(rendered(scene)(on_block), mean, deviation);
    return deviation[0];
  };
  EXPECT_LT(contrast(0), 0.5);
  EXPECT_GT(contrast(0.8), 5);
}

TEST(Translucency, ThrowsALighterShadow) {
  Finish finish;
  const auto shadow = [&](double translucency) {
    finish.translucency = translucency;
    Scene scene = blockScene(finish);
    scene.ambient = 0.1;
    scene.lights = {{{0.9, 0, 0.7}, 0.01, 0.8}};
    return int(rendered(scene).at<uchar>(pixelOf(scene, {-0.075, -0.01, 0})));
  };
  EXPECT_GT(shadow(0.8), shadow(0) + 8);
}

TEST(Sky, LightsWhatLooksUp) {
  Scene scene = blockScene({});
  const auto greys = [&](double sky) {
    scene.sky = sky;
    const cv::Mat grey = rendered(scene);
    return std::make_pair(int(grey.at<uchar>(pixelOf(scene, {0, 0, 0.05}))),
                          int(grey.at<uchar>(pixelOf(scene, {0, -0.03, 0.025}))));
  };
  EXPECT_EQ(greys(0).first, greys(0).second);
  EXPECT_GT(greys(0.5).first, greys(0.5).second + 30);
}

TEST(Processing, DarkCornersOverExposureAndSharpening) {
  Scene scene = blockScene({});
  scene.table.half_width = scene.table.half_depth = 3;
  RenderOptions options = quickNoiseless();
  const cv::Mat before = rendered(scene, options);
  options.vignetting = 0.4;
  const cv::Mat dark = rendered(scene, options);
  EXPECT_NEAR(dark.at<uchar>(0, 0), 0.6 * before.at<uchar>(0, 0), 2);
  EXPECT_NEAR(dark.at<uchar>(120, 160), before.at<uchar>(120, 160), 1);

  options = quickNoiseless();
  options.exposure = 0;
  options.mean = 0.9;
  const auto saturatedPixels = [&](double share) {
    options.saturated = share;
    return cv::countNonZero(rendered(scene, options) >= 250);
  };
  EXPECT_EQ(saturatedPixels(0.005), 0);
  const int block = saturatedPixels(0.3);
  EXPECT_GT(block, 1000) << "the bright block may saturate";

  options = quickNoiseless();
  options.blur_sigma = 0.8;
  const auto steepest = [&](double sharpening) {
    options.sharpening = sharpening;
    cv::Mat derivative;
    cv::Sobel(rendered(scene, options), derivative, CV_32F, 1, 0);
    return cv::norm(derivative, cv::NORM_INF);
  };
  EXPECT_GT(steepest(1), 1.15 * steepest(0));

  options.vignetting = 1;
  EXPECT_THROW(rendered(scene, options), BadInput);
}

namespace {

std::vector<NamedMesh> blockAndCan() {
  return {{"block", std::make_shared<Mesh>(boxMesh({0.08, 0.05, 0.03}))},
          {"can", std::make_shared<Mesh>(cylinderMesh(0.025, 0.07))}};
}

RandomPictureOptions mixed() {
  RandomPictureOptions options;
  options.scene.appearance = Appearance::kMixed;
  options.scene.level = SceneLevel::kHard;
  options.width = 160;
  options.height = 120;
  return options;
}

}  // namespace

TEST(MixedAppearance, SameSeedSamePicture) {
  const auto render = [&](uint32_t seed) {
    const RandomPicture picture = randomPicture(blockAndCan(), seed, mixed());
    return renderScene(picture.scene, picture.camera, picture.render).grey;
  };
  for (uint32_t seed = 0; seed < 3; ++seed)
    EXPECT_EQ(cv::norm(render(seed), render(seed), cv::NORM_INF), 0) << seed;
}

TEST(MixedAppearance, HalfOfThePartsStayPlainAndAllKindsAppear) {
  int plain = 0, finished = 0, printed = 0, glossy = 0, translucent = 0, rounded = 0, workshop = 0;
  for (uint32_t seed = 0; seed < 60; ++seed) {
    for (const SceneObject& object : randomPicture(blockAndCan(), seed, mixed()).scene.objects) {
      if (object.model < 0) {
        workshop += object.name != "clutter";
        continue;
      }
      const Finish* finish = object.material.finish.get();
      (finish ? finished : plain)++;
      if (!finish) continue;
      printed += !finish->prints.empty();
      glossy += finish->gloss > 0.2;
      translucent += finish->translucency > 0;
      rounded += finish->edge_radius > 0;
    }
  }

  EXPECT_NEAR(double(plain) / (plain + finished), 0.5, 0.12);
  EXPECT_GT(printed, finished / 3);
  EXPECT_GT(glossy, finished / 12);
  EXPECT_GT(translucent, 0);
  EXPECT_GT(rounded, finished / 2);
  EXPECT_GT(workshop, 40);
}

TEST(MixedAppearance, PartsStandAsInThePlainScene) {
  for (uint32_t seed = 0; seed < 10; ++seed) {
    RandomPictureOptions plain = mixed();
    plain.scene.appearance = Appearance::kPlain;
    const Scene a = randomPicture(blockAndCan(), seed, plain).scene,
                b = randomPicture(blockAndCan(), seed, mixed()).scene;
    ASSERT_FALSE(a.objects.empty());
    for (size_t k = 0; k < a.objects.size() && a.objects[k].model >= 0; ++k)
      EXPECT_EQ(a.objects[k].world_from_object.translation, b.objects[k].world_from_object.translation);
    for (const SceneObject& object : a.objects) EXPECT_FALSE(object.material.finish);
  }
}
