#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nodes/common/conversion.h"
#include "nodes/planner/markers.h"

namespace monocular_eye_hand {
namespace {

using visualization_msgs::Marker;

const Marker* find(const visualization_msgs::MarkerArray& array, const std::string& space, int id = 0) {
  for (const Marker& marker : array.markers)
    if (marker.ns == space && marker.id == id) return &marker;
  return nullptr;
}

TEST(PlannerMarkers, TheTopOfTheTableIsWhereTheParametersSay) {
  for (const double yaw : {0.0, 0.7}) {
    PlannerParameters parameters;
    parameters.base_frame = "arm_base";
    parameters.table.z = 0.42;
    parameters.table.yaw = yaw;
    const auto array = cellMarkers(parameters);
    const Marker* table = find(array, "table");
    ASSERT_TRUE(table);
    EXPECT_EQ(table->type, Marker::CUBE);
    EXPECT_EQ(table->header.frame_id, "arm_base");
    EXPECT_NEAR(table->pose.position.z + table->scale.z / 2, 0.42, 1e-12);
    EXPECT_EQ(table->scale.x, parameters.table.length);
    EXPECT_EQ(table->scale.y, parameters.table.width);
    EXPECT_LT(angleBetween(fromPose(table->pose).rotation, expSO3({0, 0, yaw})), 1e-9);
    EXPECT_GT(table->lifetime.toSec(), 0);
  }
}

TEST(PlannerMarkers, TheDropZoneLiesOnTheTable) {
  PlannerParameters parameters;
  const size_t places = parameters.drop_zone.places().size();
  const auto rectangle = cellMarkers(parameters);
  const Marker* zone = find(rectangle, "drop_zone");
  ASSERT_TRUE(zone);
  EXPECT_EQ(zone->points.size(), 2 * (4 + places));
  for (const geometry_msgs::Point& p : zone->points) {
    EXPECT_NEAR(p.z, parameters.table.z, 0.002);
    EXPECT_LE(std::abs(p.x - parameters.drop_zone.x), parameters.drop_zone.length / 2 + 1e-9);
    EXPECT_LE(std::abs(p.y - parameters.drop_zone.y), parameters.drop_zone.width / 2 + 1e-9);
  }
  DropPlace place;
  place.x = 0.3;
  place.y = -0.2;
  place.yaw = M_PI / 2;
  parameters.drop_zone.list = {place};
  const auto listed = cellMarkers(parameters);  // no rectangle: nobody said one
  zone = find(listed, "drop_zone");
  ASSERT_TRUE(zone);
  ASSERT_EQ(zone->points.size(), 2u);
  EXPECT_NEAR(zone->points[0].x, 0.3, 1e-12);
  EXPECT_LT(zone->points[0].y, -0.2);
  EXPECT_GT(zone->points[1].y, -0.2);
}

TEST(PlannerMarkers, EveryBoxIsShown) {
  PlannerParameters parameters;
  EXPECT_FALSE(find(cellMarkers(parameters), "boxes"));
  CellBox wall, post;
  wall.name = "wall";
  wall.x = 1;
  wall.size = {{0.1, 2, 1}};
  post.name = "post";
  post.z = 0.5;
  post.roll = 0.1;
  post.pitch = 0.2;
  post.yaw = 0.3;
  post.size = {{1, 2, 3}};
  parameters.boxes = {wall, post};
  const auto array = cellMarkers(parameters);
  ASSERT_TRUE(find(array, "boxes", 0) && find(array, "boxes", 1));
  EXPECT_EQ(find(array, "boxes", 0)->pose.position.x, 1);
  EXPECT_EQ(find(array, "boxes", 1)->scale.z, 3);
  const Eigen::Matrix3d turn = fromPose(find(array, "boxes", 1)->pose).rotation;
  EXPECT_NEAR(turn(2, 0), -std::sin(0.2), 1e-9);  // yaw about z last
}

}  // namespace
}  // namespace monocular_eye_hand
