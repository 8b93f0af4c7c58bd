#include "monocular_eye_hand/geometry/projection.h"

#include <gtest/gtest.h>

#include "support/camera.h"
#include "support/random.h"

namespace monocular_eye_hand {
namespace {

const std::vector<Camera>& lenses() {
  static const std::vector<Camera> all = {
      unevenCamera(), withLens(unevenCamera(), "plumb_bob", {-0.3, 0.12, 1e-3, -2e-3, -0.02}),
      withLens(unevenCamera(), "rational_polynomial", {0.3, 0.12, 1e-3, -2e-3, -0.02, 0.6, 0.1, 0.03}),
      withLens(unevenCamera(), "equidistant", {0.05, -0.01, 4e-3, -1e-3})};
  return all;
}

double* intrinsic(Camera* camera, int k) {
  double* const first[] = {&camera->fx, &camera->fy, &camera->cx, &camera->cy};
  return k < 4 ? first[k] : &camera->d[size_t(k - 4)];
}

TEST(Projection, SeesAPointWhereTheCameraDoes) {
  Random random(1);
  for (const Camera& camera : lenses())
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d p(uniform(random, -0.4, 0.4), uniform(random, -0.3, 0.3),
                              uniform(random, 0.5, 2));
      EXPECT_LT((projectWithDerivatives(camera, p).uv_raw - camera.distort(camera.project(p))).norm(), 1e-9);
    }
}

TEST(Projection, ItsDerivativesAreThoseOfDifferences) {
  Random random(2);
  for (const Camera& camera : lenses())
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d p(uniform(random, -0.4, 0.4), uniform(random, -0.3, 0.3),
                              uniform(random, 0.6, 2));
      const Projection at = projectWithDerivatives(camera, p);
      for (int c = 0; c < 3; ++c) {
        const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(c);
        const Eigen::Vector2d slope = (projectWithDerivatives(camera, p + step).uv_raw -
                                       projectWithDerivatives(camera, p - step).uv_raw) /
                                      2e-6;
        EXPECT_LT((slope - at.by_point.col(c)).norm(), 1e-4);
      }

      const int coefficients = camera.distorted() ? distortionCount(camera) : 0;
      for (int k = 0; k < kIntrinsics; ++k) {
        if (k >= 4 + coefficients) {
          EXPECT_EQ(at.by_intrinsics.col(k).norm(), 0);
          continue;
        }
        Camera more = camera, less = camera;
        *intrinsic(&more, k) += 1e-6;
        *intrinsic(&less, k) -= 1e-6;
        const Eigen::Vector2d slope =
            (projectWithDerivatives(more, p).uv_raw - projectWithDerivatives(less, p).uv_raw) / 2e-6;
        EXPECT_LT((slope - at.by_intrinsics.col(k)).norm(), 1e-4) << "intrinsic " << k;
      }
    }
}

TEST(Projection, OnTheAxisNoCoefficientMovesThePixel) {
  for (const Camera& camera : lenses()) {
    const Projection at = projectWithDerivatives(camera, {0, 0, 1});
    EXPECT_EQ(at.by_intrinsics.rightCols<8>().norm(), 0);
    EXPECT_TRUE(at.by_point.allFinite());
  }
}

}  // namespace
}  // namespace monocular_eye_hand
