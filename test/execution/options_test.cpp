#include <gtest/gtest.h>

#include <cmath>

#include "monocular_eye_hand/execution/options.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

TEST(DropZone, GridOfPlaces) {
  DropZone zone;
  zone.x = 1;
  zone.y = 2;
  zone.yaw = M_PI / 2;
  zone.length = 0.4;
  zone.width = 0.2;
  zone.columns = 2;
  zone.rows = 1;
  zone.part_yaw = 0.1;
  const std::vector<DropPlace> places = zone.places();
  ASSERT_EQ(places.size(), 2u);
  EXPECT_NEAR(places[0].x, 1, 1e-12);
  EXPECT_NEAR(places[0].y, 1.9, 1e-12);
  EXPECT_NEAR(places[1].y, 2.1, 1e-12);
  EXPECT_NEAR(places[1].yaw, M_PI / 2 + 0.1, 1e-12);
  zone.list.resize(1);
  EXPECT_EQ(zone.places().size(), 1u);
}

TEST(ExecutorOptions, ModelBaseAndArmMustBeGiven) {
  ExecutorOptions options;
  EXPECT_THROW(options.check(), BadInput);
  options.objects = "objects.yaml";
  EXPECT_THROW(options.check(), BadInput);
  options.urdf = "arm.urdf";
  EXPECT_NO_THROW(options.check());
  options.drop_above = options.drop_gap / 2;
  EXPECT_THROW(options.check(), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
