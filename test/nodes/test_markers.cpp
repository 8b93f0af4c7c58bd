#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nodes/conversion.h"
#include "nodes/markers.h"

namespace monocular_eye_hand {
namespace {

using visualization_msgs::Marker;

ModelBase twoObjects() {
  ModelBase models;
  for (const char* name : {"bridge", "frame"}) {
    KnownObject known;
    known.model.name = name;
    known.model.diameter = 0.1;
    known.model.mesh.vertices = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
    known.model.mesh.triangles = {{0, 2, 1}, {0, 1, 3}};
    known.model.bounds = Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.1, 0.1, 0.1));
    ModelEdge edge;
    edge.p = {0, 0, 0}, edge.q = {0.1, 0, 0};
    known.model.edges = {edge};
    models.objects.push_back(known);
  }
  return models;
}

ObjectEstimate seen(int object, Decision decision = Decision::kAccepted) {
  ObjectEstimate result;
  result.object = object;
  result.name = object == 0 ? "bridge" : "frame";
  result.decision = decision;
  result.probability = 0.876;
  result.camera_from_object = {expSO3({1, 0.5, 0.2}), {0.1, 0.2, 0.7}};
  return result;
}

std_msgs::Header header() {
  std_msgs::Header result;
  result.frame_id = "camera";
  result.stamp = ros::Time(5, 6);
  return result;
}

std::vector<std::string> deleted(const visualization_msgs::MarkerArray& array) {
  std::vector<std::string> out;
  for (const Marker& marker : array.markers)
    if (marker.action == Marker::DELETE) out.push_back(marker.ns + " " + std::to_string(marker.id));
  return out;
}

TEST(Markers, MeshAndLabel) {
  const ModelBase models = twoObjects();
  MarkerBuilder builder(models, 100);
  const auto array = builder.build(header(), {seen(0)}, {4});
  ASSERT_EQ(array.markers.size(), 2u);
  const Marker& mesh = array.markers[0];
  EXPECT_EQ(mesh.header.frame_id, "camera");
  EXPECT_EQ(mesh.header.stamp, ros::Time(5, 6));
  EXPECT_EQ(mesh.type, Marker::TRIANGLE_LIST);
  EXPECT_EQ(mesh.ns, "bridge");
  EXPECT_EQ(mesh.id, 4);
  EXPECT_EQ(mesh.pose, toPose(seen(0).camera_from_object));
  EXPECT_EQ(mesh.scale.x, 1);
  ASSERT_EQ(mesh.points.size(), 6u);
  EXPECT_EQ(mesh.points[1].y, 0.1);  // second vertex of the first triangle: metres
  const Marker& label = array.markers[1];
  EXPECT_EQ(label.type, Marker::TEXT_VIEW_FACING);
  EXPECT_EQ(label.ns, "bridge/label");
  EXPECT_EQ(label.text, "bridge_4 0.88");
}

// Above is -y in an optical frame, and what the caller says in another.
TEST(Markers, TextsStandAboveTheirObject) {
  const ModelBase models = twoObjects();
  const auto offset = [&](MarkerBuilder builder) {
    const auto array = builder.build(header(), {seen(0)}, {0});
    const Rigid3 pose = seen(0).camera_from_object;
    const geometry_msgs::Point text = array.markers.at(1).pose.position;
    return Eigen::Vector3d(Eigen::Vector3d(text.x, text.y, text.z) - pose * models.objects[0].model.centre());
  };
  const double above = 0.6 * models.objects[0].model.diameter;
  EXPECT_LT((offset(MarkerBuilder(models, 100)) - Eigen::Vector3d(0, -above, 0)).norm(), 1e-12);
  EXPECT_LT(
      (offset(MarkerBuilder(models, 100, Eigen::Vector3d::UnitZ())) - Eigen::Vector3d(0, 0, above)).norm(),
      1e-12);
  EXPECT_GT(above, 0);
}

TEST(Markers, AmbiguousObjectsAreTranslucentAndSaySo) {
  const ModelBase models = twoObjects();
  MarkerBuilder builder(models, 100);
  const auto array = builder.build(header(), {seen(0), seen(1, Decision::kAmbiguous)}, {0, 0});
  ASSERT_EQ(array.markers.size(), 4u);
  EXPECT_LT(array.markers[2].color.a, array.markers[0].color.a);
  EXPECT_EQ(array.markers[3].text, "frame_0 0.88 ambiguous");
  EXPECT_NE(array.markers[2].color, array.markers[0].color);
}

TEST(Markers, LargeMeshesAreShownByTheirEdges) {
  const ModelBase models = twoObjects();
  MarkerBuilder builder(models, 1);
  const auto array = builder.build(header(), {seen(0)}, {0});
  EXPECT_EQ(array.markers[0].type, Marker::LINE_LIST);
  EXPECT_EQ(array.markers[0].points.size(), 2u);
  EXPECT_GT(array.markers[0].scale.x, 0);
}

TEST(Markers, WhatIsGoneIsDeleted) {
  const ModelBase models = twoObjects();
  MarkerBuilder builder(models, 100);
  builder.build(header(), {seen(0), seen(0), seen(1)}, {0, 1, 0});
  EXPECT_THAT(deleted(builder.build(header(), {seen(0), seen(1)}, {0, 0})),
              testing::ElementsAre("bridge 1", "bridge/label 1"));
  EXPECT_THAT(deleted(builder.build(header(), {}, {})),
              testing::UnorderedElementsAre("bridge 0", "bridge/label 0", "frame 0", "frame/label 0"));
  EXPECT_TRUE(builder.build(header(), {}, {}).markers.empty());
}

TEST(Markers, ALookForOneNameLeavesTheOthers) {
  const ModelBase models = twoObjects();
  MarkerBuilder builder(models, 100);
  builder.build(header(), {seen(0), seen(1)}, {0, 0});
  EXPECT_THAT(deleted(builder.build(header(), {}, {}, "frame")),
              testing::ElementsAre("frame 0", "frame/label 0"));
  EXPECT_THAT(deleted(builder.build(header(), {}, {})), testing::ElementsAre("bridge 0", "bridge/label 0"));
}

}  // namespace
}  // namespace monocular_eye_hand
