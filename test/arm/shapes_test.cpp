// The shapes of urdf/puma560.urdf: what planning avoids (collision) against what one sees (visual).
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "monocular_eye_hand/arm/load_arm_description.h"
#include "urdf_world.h"

namespace monocular_eye_hand {
namespace {

using Eigen::Vector3d;

constexpr double kGrid = 0.008;      // between samples on a triangle [m]
constexpr double kOutside = 0.0005;  // visual may stand out of the collision shapes by this [m]
constexpr double kSlack = 0.005;     // collision may stand out of the visual shapes by this [m]

/// Points on the surface, in the link's frame.
std::vector<Vector3d> surfaceOf(const ArmShape& shape) {
  const Mesh mesh = meshOf(shape);
  std::vector<Vector3d> points;
  for (const auto& t : mesh.triangles) {
    const Vector3d a = mesh.vertices[size_t(t[0])], ab = mesh.vertices[size_t(t[1])] - a,
                   ac = mesh.vertices[size_t(t[2])] - a;
    const int n = 1 + int(std::max(ab.norm(), ac.norm()) / kGrid);
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        points.push_back(shape.link_from_shape * Vector3d(a + ab * i / n + ac * j / n));
  }
  return points;
}

/// How far p lies outside the box or cylinder; negative inside.
double outside(const ArmShape& shape, const Vector3d& p) {
  const Vector3d q = shape.link_from_shape.inverse() * p;
  const double along = std::abs(q.z()) - shape.size.z() / 2;
  if (shape.kind == ArmShape::Kind::kCylinder) return std::max(along, q.head<2>().norm() - shape.size.x());
  return std::max({along, std::abs(q.x()) - shape.size.x() / 2, std::abs(q.y()) - shape.size.y() / 2});
}

/// Distance to a triangle: the nearest of its plane's foot (when inside) and its sides.
double distance(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const auto toSide = [&](const Vector3d& s, const Vector3d& e) {
    const double length2 = (e - s).squaredNorm();
    const double t = length2 > 0 ? std::clamp((p - s).dot(e - s) / length2, 0.0, 1.0) : 0;
    return (p - s - t * (e - s)).norm();
  };
  const Vector3d normal = (b - a).cross(c - a);
  const bool inside = normal.dot((b - a).cross(p - a)) >= 0 && normal.dot((c - b).cross(p - b)) >= 0 &&
                      normal.dot((a - c).cross(p - c)) >= 0;
  if (inside && normal.norm() > 0) return std::abs(normal.normalized().dot(p - a));
  return std::min({toSide(a, b), toSide(b, c), toSide(c, a)});
}

double distanceToVisual(const ArmLink& link, const Vector3d& p) {
  double nearest = 1;
  for (const ArmShape& shape : link.visual) {
    const Mesh mesh = meshOf(shape);
    const Vector3d q = shape.link_from_shape.inverse() * p;
    for (const auto& t : mesh.triangles)
      nearest = std::min(nearest, distance(q, mesh.vertices[size_t(t[0])], mesh.vertices[size_t(t[1])],
                                           mesh.vertices[size_t(t[2])]));
  }
  return nearest;
}

TEST(ArmShapes, EveryBodyHasBoth) {
  std::set<std::string> bodies;
  for (const ArmLink& link : description().links) {
    EXPECT_EQ(link.collision.empty(), link.visual.empty()) << link.name;
    if (!link.collision.empty()) bodies.insert(link.name);
    for (const ArmShape& shape : link.collision) EXPECT_NE(shape.kind, ArmShape::Kind::kMesh) << link.name;
  }
  EXPECT_EQ(bodies, (std::set<std::string>{"base_link", "link1", "link2", "link3", "link4", "link5", "link6",
                                           "gripper_base", "finger_left", "finger_right", "camera_link"}));
}

TEST(ArmShapes, CollisionEnclosesVisual) {
  for (const ArmLink& link : description().links) {
    double worst = -1;
    for (const ArmShape& visual : link.visual)
      for (const Vector3d& p : surfaceOf(visual)) {
        double nearest = 1;
        for (const ArmShape& shape : link.collision) nearest = std::min(nearest, outside(shape, p));
        worst = std::max(worst, nearest);
      }
    EXPECT_LT(worst, kOutside) << link.name;
  }
}

TEST(ArmShapes, CollisionIsNotMuchLarger) {
  for (const ArmLink& link : description().links) {
    double worst = 0;
    for (size_t i = 0; i < link.collision.size(); ++i) {
      std::vector<Vector3d> points = surfaceOf(link.collision[i]);
      for (size_t k = 0; k < points.size(); k += 1 + points.size() / 1500) {
        bool inner = false;  // of the union
        for (size_t j = 0; j < link.collision.size(); ++j)
          inner = inner || (j != i && outside(link.collision[j], points[k]) < -1e-6);
        if (!inner) worst = std::max(worst, distanceToVisual(link, points[k]));
      }
    }
    EXPECT_LT(worst, kSlack) << link.name;
  }
}

TEST(ArmShapes, MeshesAreClosedAndTurnedOutwards) {
  for (const ArmLink& link : description().links)
    for (const ArmShape& shape : link.visual) {
      if (shape.kind != ArmShape::Kind::kMesh) continue;
      double volume = 0;
      Vector3d area = Vector3d::Zero();
      for (const auto& t : shape.mesh->triangles) {
        const Vector3d &a = shape.mesh->vertices[size_t(t[0])], &b = shape.mesh->vertices[size_t(t[1])],
                       &c = shape.mesh->vertices[size_t(t[2])];
        volume += a.dot(b.cross(c)) / 6;
        area += (b - a).cross(c - a) / 2;
      }
      EXPECT_GT(volume, 1e-6) << link.name;
      EXPECT_LT(area.norm(), 1e-7) << link.name;
    }
}

/// Least distance, about, from the surface of one link to the other's solids; negative when they overlap.
double gap(const std::vector<Rigid3>& poses, int from, int to) {
  const ArmDescription& arm = description();
  const Rigid3 to_from_from = poses[size_t(to)].inverse() * poses[size_t(from)];
  double nearest = 1;
  for (const ArmShape& shape : arm.links[size_t(from)].collision) {
    const std::vector<Vector3d> points = surfaceOf(shape);
    for (size_t k = 0; k < points.size(); k += 1 + points.size() / 2500)
      for (const ArmShape& solid : arm.links[size_t(to)].collision)
        nearest = std::min(nearest, outside(solid, to_from_from * points[k]));
  }
  return nearest;
}

TEST(ArmShapes, HandTurnsFreelyAtTheForearm) {
  const ArmDescription& arm = description();
  const JointLimit limit = Puma560Options().joints[4];
  double nearest = 1;
  for (double q5 = limit.lower; q5 <= limit.upper + 1e-9; q5 += (limit.upper - limit.lower) / 16)
    for (double q6 = 0; q6 < 6; q6 += M_PI / 4) {
      JointVector q = JointVector::Zero();
      q[4] = q5;
      q[5] = q6;
      const auto poses = arm.baseFromLinks(q, arm.gripper_width_max);
      for (const char* hand : {"link6", "gripper_base", "finger_left", "finger_right", "camera_link"})
        for (const char* body : {"link3", "link4"})
          nearest = std::min(nearest, gap(poses, arm.link(hand), arm.link(body)));
    }
  EXPECT_GT(nearest, 0.001);
}

/// Links that a joint connects leave a gap at every angle: planning need not except them from its checks.
TEST(ArmShapes, NeighboursDoNotTouch) {
  const ArmDescription& arm = description();
  const std::pair<const char*, const char*> neighbours[] = {{"base_link", "link1"},
                                                            {"link1", "link2"},
                                                            {"link2", "link3"},
                                                            {"link3", "link4"},
                                                            {"link4", "link5"},
                                                            {"link5", "link6"},
                                                            {"gripper_base", "finger_left"},
                                                            {"gripper_base", "finger_right"}};

  for (const auto& [a, b] : neighbours)
    for (int k = 0; k <= 6; ++k) {
      JointVector q;
      for (int i = 0; i < 6; ++i) {
        const JointLimit limit = Puma560Options().joints[size_t(i)];
        q[i] = limit.lower + (limit.upper - limit.lower) * k / 6;
      }
      const auto poses = arm.baseFromLinks(q, arm.gripper_width_max * k / 6);
      EXPECT_GT(gap(poses, arm.link(a), arm.link(b)), 0.0004) << a << " " << b;
      EXPECT_GT(gap(poses, arm.link(b), arm.link(a)), 0.0004) << a << " " << b;
    }
}

/// Neither fingers nor gripper, whatever their opening, show in the middle of the camera's image.
TEST(ArmShapes, CameraSeesPastTheGripper) {
  const ArmDescription& arm = description();
  const double fx = 700;
  int in_image = 0, samples = 0;
  double nearest_to_centre = 1e9;
  for (double width : {0.0, 0.045, 0.09}) {
    const auto poses = arm.baseFromLinks(JointVector::Zero(), width);
    const Rigid3 camera_from_base = poses[size_t(arm.link("camera_optical_frame"))].inverse();
    for (const char* name : {"gripper_base", "finger_left", "finger_right", "link6", "camera_link"})
      for (const ArmShape& shape : arm.links[size_t(arm.link(name))].visual)
        for (const Vector3d& p : surfaceOf(shape)) {
          const Vector3d q = camera_from_base * poses[size_t(arm.link(name))] * p;
          ++samples;
          if (q.z() < 1e-3) continue;
          const double u = fx * q.x() / q.z(), v = fx * q.y() / q.z();
          nearest_to_centre = std::min(nearest_to_centre, std::hypot(u, v));
          in_image += std::abs(u) < 320 && std::abs(v) < 240;
        }
  }

  EXPECT_GT(samples, 1000);
  EXPECT_EQ(in_image, 0);
  EXPECT_GT(nearest_to_centre, 240);
}

}  // namespace
}  // namespace monocular_eye_hand
