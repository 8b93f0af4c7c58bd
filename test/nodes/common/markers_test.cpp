#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "nodes/common/conversion.h"
#include "nodes/common/markers.h"

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
    edge.p = {0, 0, 0};
    edge.q = {0.1, 0, 0};
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

/// The markers of one array that show something, by namespace and id.
std::map<std::string, Marker> shown(const visualization_msgs::MarkerArray& array) {
  std::map<std::string, Marker> out;
  for (const Marker& marker : array.markers)
    if (marker.action == Marker::ADD) out[marker.ns + " " + std::to_string(marker.id)] = marker;
  return out;
}

std::map<std::string, Marker> shownOnce(const ModelBase& models, const MarkerStyle& style,
                                        const std::vector<ObjectEstimate>& objects) {
  return shown(MarkerBuilder(models, style).build(header(), objects, std::vector<int>(objects.size(), 0), 0));
}

TEST(Markers, MeshAxesAndLabel) {
  const ModelBase models = twoObjects();
  MarkerBuilder builder(models, {});
  const auto markers = shown(builder.build(header(), {seen(0)}, {4}, 2.5));
  ASSERT_EQ(markers.size(), 3u);
  const Marker& mesh = markers.at("bridge 4");
  EXPECT_EQ(mesh.header.frame_id, "camera");
  EXPECT_EQ(mesh.header.stamp, ros::Time(5, 6));
  EXPECT_EQ(mesh.type, Marker::TRIANGLE_LIST);
  EXPECT_EQ(mesh.color.a, 1);
  EXPECT_EQ(mesh.lifetime, ros::Duration(2.5));
  EXPECT_EQ(mesh.pose, toPose(seen(0).camera_from_object));
  EXPECT_EQ(mesh.scale.x, 1);
  ASSERT_EQ(mesh.points.size(), 6u);
  EXPECT_EQ(mesh.points[1].y, 0.1);  // second vertex of the first triangle: metres
  const Marker& label = markers.at("bridge/label 4");
  EXPECT_EQ(label.type, Marker::TEXT_VIEW_FACING);
  EXPECT_EQ(label.text, "bridge_4 0.88");
  const Marker& axes = markers.at("bridge/axes 4");
  EXPECT_EQ(axes.type, Marker::LINE_LIST);
  EXPECT_EQ(axes.pose, mesh.pose);
  ASSERT_EQ(axes.points.size(), 6u);
  ASSERT_EQ(axes.colors.size(), 6u);
  EXPECT_EQ(axes.points[1].x, 0.05);
  EXPECT_EQ(axes.colors[1].r, 1);
  EXPECT_EQ(axes.points[5].z, 0.05);
  EXPECT_EQ(axes.colors[5].b, 1);
}

// However large an object is; the height is the caller's.
TEST(Markers, TextsHaveOneHeight) {
  ModelBase models = twoObjects();
  models.objects[1].model.diameter = 0.7;
  for (const double height : {0.02, 0.05}) {
    MarkerStyle style;
    style.label_height = height;
    const auto markers = shownOnce(models, style, {seen(0), seen(1)});
    EXPECT_EQ(markers.at("bridge/label 0").scale.z, height);
    EXPECT_EQ(markers.at("frame/label 0").scale.z, height);
  }
}

// Above is -y in an optical frame, and what the caller says in another.
TEST(Markers, TextsStandAboveTheirObject) {
  const ModelBase models = twoObjects();
  const auto offset = [&](const MarkerStyle& style) {
    const Rigid3 pose = seen(0).camera_from_object;
    const geometry_msgs::Point text = shownOnce(models, style, {seen(0)}).at("bridge/label 0").pose.position;
    return Eigen::Vector3d(Eigen::Vector3d(text.x, text.y, text.z) - pose * models.objects[0].model.centre());
  };
  MarkerStyle style;
  const double above = 0.5 * models.objects[0].model.diameter + style.label_height;
  EXPECT_LT((offset(style) - Eigen::Vector3d(0, -above, 0)).norm(), 1e-12);
  style.up = Eigen::Vector3d::UnitZ();
  EXPECT_LT((offset(style) - Eigen::Vector3d(0, 0, above)).norm(), 1e-12);
}

TEST(Markers, AmbiguousObjectsAreEdgesAndSaySo) {
  const ModelBase models = twoObjects();
  const auto markers = shownOnce(models, {}, {seen(0), seen(1, Decision::kAmbiguous)});
  const Marker& ghost = markers.at("frame 0");
  EXPECT_EQ(markers.at("bridge 0").type, Marker::TRIANGLE_LIST);
  EXPECT_EQ(ghost.type, Marker::LINE_LIST);
  EXPECT_EQ(ghost.points.size(), 2u);
  EXPECT_EQ(ghost.color.a, 1);
  EXPECT_EQ(markers.at("frame/label 0").text, "frame_0 0.88 ambiguous");
  EXPECT_NE(ghost.color, markers.at("bridge 0").color);
}

TEST(Markers, LargeMeshesAreShownByTheirEdges) {
  const ModelBase models = twoObjects();
  MarkerStyle style;
  style.max_triangles = 1;
  const Marker edges = shownOnce(models, style, {seen(0)}).at("bridge 0");
  EXPECT_EQ(edges.type, Marker::LINE_LIST);
  EXPECT_EQ(edges.points.size(), 2u);
  EXPECT_GT(edges.scale.x, 0);
}

// Circles count as edges; what has neither is shown by its box: rviz complains of an empty list.
TEST(Markers, RoundObjectsHaveEdgesToo) {
  ModelBase models = twoObjects();
  ObjectModel& ring = models.objects[0].model;
  ring.edges.clear();
  ModelCircle circle;
  circle.centre = {0, 0, 0.1};
  circle.axis = {0, 0, 1};
  circle.x_axis = {1, 0, 0};
  circle.radius = 0.05;
  circle.sweep = 2 * M_PI;
  ring.circles = {circle};
  models.objects[1].model.edges.clear();
  const auto markers = shownOnce(models, {}, {seen(0, Decision::kAmbiguous), seen(1, Decision::kAmbiguous)});
  const Marker& round = markers.at("bridge 0");
  ASSERT_GE(round.points.size(), 2u * 40);
  for (const geometry_msgs::Point& p : round.points) {
    EXPECT_NEAR(std::hypot(p.x, p.y), 0.05, 1e-9);
    EXPECT_EQ(p.z, 0.1);
  }
  EXPECT_EQ(markers.at("frame 0").points.size(), 24u);  // twelve edges of a box
}

TEST(Markers, TheFirstArrayDeletesWhatAFormerRunLeft) {
  const ModelBase models = twoObjects();
  const std::vector<ObjectEstimate> one{seen(0)}, none;
  for (const std::vector<ObjectEstimate>& objects : {one, none}) {
    MarkerBuilder builder(models, {});
    const std::vector<int> numbers(objects.size(), 0);
    const auto first = builder.build(header(), objects, numbers, 0);
    ASSERT_FALSE(first.markers.empty());
    EXPECT_EQ(first.markers[0].action, Marker::DELETEALL);
    EXPECT_EQ(first.markers[0].header.frame_id, "camera");
    for (const Marker& marker : builder.build(header(), objects, numbers, 0).markers)
      EXPECT_NE(marker.action, Marker::DELETEALL);
  }
}

TEST(Markers, WhatIsGoneIsDeleted) {
  const ModelBase models = twoObjects();
  MarkerBuilder builder(models, {});
  builder.build(header(), {seen(0), seen(0), seen(1)}, {0, 1, 0}, 0);
  EXPECT_THAT(deleted(builder.build(header(), {seen(0), seen(1)}, {0, 0}, 0)),
              testing::ElementsAre("bridge 1", "bridge/axes 1", "bridge/label 1"));
  EXPECT_THAT(deleted(builder.build(header(), {}, {}, 0)),
              testing::UnorderedElementsAre("bridge 0", "bridge/axes 0", "bridge/label 0", "frame 0",
                                            "frame/axes 0", "frame/label 0"));
  EXPECT_TRUE(builder.build(header(), {}, {}, 0).markers.empty());
}

TEST(Markers, ALookForOneNameLeavesTheOthers) {
  const ModelBase models = twoObjects();
  MarkerBuilder builder(models, {});
  builder.build(header(), {seen(0), seen(1)}, {0, 0}, 0);
  EXPECT_THAT(deleted(builder.build(header(), {}, {}, 0, "frame")),
              testing::ElementsAre("frame 0", "frame/axes 0", "frame/label 0"));
  EXPECT_THAT(deleted(builder.build(header(), {}, {}, 0)),
              testing::ElementsAre("bridge 0", "bridge/axes 0", "bridge/label 0"));
}

// The four edges of the pyramid run through the corners of the image.
TEST(Markers, TheViewOfACamera) {
  Camera camera{640, 480, 600, 610, 320, 240, DistortionModel::kNone, {}};
  const double barrel[] = {-0.2, 0.05, 0, 0, 0};
  for (const bool distorted : {false, true}) {
    if (distorted) setDistortion(&camera, "plumb_bob", barrel, 5);
    const Marker view = viewMarker("eye", camera, 0.2);
    EXPECT_EQ(view.header.frame_id, "eye");
    EXPECT_TRUE(view.header.stamp.isZero());
    EXPECT_TRUE(view.frame_locked);
    ASSERT_EQ(view.points.size(), 16u);
    std::set<std::pair<long, long>> corners;
    for (const geometry_msgs::Point& p : view.points) {
      if (p.z == 0) continue;
      EXPECT_EQ(p.z, 0.2);
      const Eigen::Vector2d uv = camera.distort(camera.project({p.x, p.y, p.z}));
      corners.emplace(std::lround(uv.x()), std::lround(uv.y()));
    }
    EXPECT_THAT(corners, testing::UnorderedElementsAre(testing::Pair(0, 0), testing::Pair(639, 0),
                                                       testing::Pair(639, 479), testing::Pair(0, 479)));
  }
}

}  // namespace
}  // namespace monocular_eye_hand
