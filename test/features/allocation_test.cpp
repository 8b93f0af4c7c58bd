// A detector that has seen an image allocates nothing when it sees it again.
#include <gtest/gtest.h>

#include "flat_features.h"
#include "support/allocation_count.h"
#include "support/camera.h"

namespace monocular_eye_hand {
namespace {

struct View {
  cv::Mat image;
  Camera camera;
};

// Polygons, one half over another, so that segments are joined across gaps.
View polygons() {
  View view{{}, testCamera(320, 240)};
  std::mt19937 g(3);
  SyntheticScene scene(90);
  for (int k = 0; k < 16; ++k)
    scene.add(randomPolygon(&g, {uniform(g, 20, 300), uniform(g, 20, 220)}, uniform(g, 10, 60), 3 + k % 4,
                            uniform(g, 20, 240)));
  view.image = scene.render(view.camera, 2, &g);
  return view;
}

// Rows of ellipses over a texture of dots.
View ellipsesOnTexture(const Camera& camera) {
  View view{{}, camera};
  std::mt19937 g(5);
  SyntheticScene scene(120);
  for (int k = 0; k < 500; ++k)
    scene.add(FilledEllipse{{{uniform(g, 0, 320), uniform(g, 0, 240)}, 3, uniform(g, 1, 3), uniform(g, 0, 3)},
                            uniform(g, 60, 180)});
  for (int y = 24; y < 240; y += 48)
    for (int x = 24; x < 320; x += 45)
      scene.add(
          FilledEllipse{{{double(x), double(y)}, uniform(g, 12, 20), uniform(g, 7, 12), uniform(g, 0, 3)},
                        (x + y) % 2 ? 230.0 : 20.0});
  view.image = scene.render(view.camera, 3, &g);
  return view;
}

Camera lens() { return withLens(testCamera(320, 240), "plumb_bob", {-0.25, 0.08, 0.001, -0.001, 0}); }

const std::vector<View>& views() {
  static const std::vector<View> all = {polygons(), ellipsesOnTexture(testCamera(320, 240)),
                                        ellipsesOnTexture(lens())};
  return all;
}

TEST(Allocations, AreCounted) {
  const long before = allocationCount();
  ::operator delete(::operator new(8));
  ::operator delete(::operator new(64, std::align_val_t(64)), std::align_val_t(64));
  ::operator delete[](::operator new[](8));
  EXPECT_EQ(allocationCount() - before, 3);
  const View& view = views()[0];
  const long outside = allocationCount();
  detectFeatures(view.image, view.camera);  // in the library
  EXPECT_GT(allocationCount() - outside, 20);
}

TEST(Allocations, NoneForImagesSeenBefore) {
  FeatureDetector detector;
  FeatureSet features;
  for (const View& view : views()) detector.detect(view.image, view.camera, &features);
  for (const View& view : views()) {
    const long before = allocationCount();
    detector.detect(view.image, view.camera, &features);
    EXPECT_EQ(allocationCount() - before, 0);
    EXPECT_EQ(flat(features), flat(detectFeatures(view.image, view.camera)));
  }
}

TEST(Allocations, TheImagesExerciseEveryStage) {
  for (const View& view : views()) {
    const FeatureSet features = detectFeatures(view.image, view.camera);
    if (&view == &views().front()) {
      EXPECT_GT(features.joined_pieces.size(), 4u);
    } else {
      EXPECT_GT(features.ellipses.size(), 15u);
      EXPECT_GT(features.ellipse_arcs.size(), features.ellipses.size()) << "no arcs joined";
    }
  }
}

}  // namespace
}  // namespace monocular_eye_hand
