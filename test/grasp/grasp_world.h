#pragma once
#include <string>

#include "model/build_model.h"
#include "monocular_eye_hand/grasp/plan_grasps.h"
#include "monocular_eye_hand/mesh/load_mesh.h"

namespace monocular_eye_hand::grasp_world {

inline ObjectModel shipped(const std::string& name) {
  return buildModel(name,
                    loadMesh(std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/models/" + name + ".ply", "mm"));
}

/// Twelve triangles, centred on its base.
inline Mesh box(double x, double y, double z) {
  Mesh m;
  for (int i = 0; i < 8; ++i)
    m.vertices.emplace_back(i & 1 ? x / 2 : -x / 2, i & 2 ? y / 2 : -y / 2, i & 4 ? z : 0);
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {3, 2, 6, 7}, {1, 3, 7, 5}, {2, 0, 4, 6}};
  for (const auto& q : quads) {
    m.triangles.push_back({q[0], q[1], q[2]});
    m.triangles.push_back({q[0], q[2], q[3]});
  }
  return m;
}
inline ObjectModel boxModel(double x, double y, double z) { return buildModel("box", box(x, y, z)); }

inline Mesh cylinder(double radius, double height, int n = 64) {
  Mesh m;
  for (int k = 0; k < n; ++k)
    for (const double z : {0.0, height})
      m.vertices.emplace_back(radius * std::cos(2 * M_PI * k / n), radius * std::sin(2 * M_PI * k / n), z);
  for (int k = 0; k < n; ++k) {
    const int a = 2 * k, b = 2 * ((k + 1) % n);
    m.triangles.push_back({a, b, b + 1});
    m.triangles.push_back({a, b + 1, a + 1});
    if (k >= 2) {
      m.triangles.push_back({0, a, a - 2});
      m.triangles.push_back({1, a - 1, a + 1});
    }
  }
  return m;
}

inline Rigid3 tool0FromTcp() { return {Eigen::Matrix3d::Identity(), {0, 0, 0.16}}; }

inline JointVector ready() { return (JointVector() << 0, 0.9, -2.4, 0, 0.6, 0).finished(); }

inline Matrix6d sigma(double metres, double radians) {
  Vector6d v;
  v << Eigen::Vector3d::Constant(metres * metres), Eigen::Vector3d::Constant(radians * radians);
  return v.asDiagonal();
}

constexpr double kTable = 0.2;  // its height [m]
enum { kBlock, kTray, kRod };

inline ModelBase partsAndTray() {
  ModelBase models;
  models.objects.resize(3);
  models.objects[kBlock].model = boxModel(0.06, 0.03, 0.05);
  models.objects[kBlock].model.name = "block";
  models.objects[kTray].model = boxModel(0.3, 0.2, 0.02);
  models.objects[kTray].model.name = "tray";
  models.objects[kTray].handling.obstacle = true;
  models.objects[kRod].model = boxModel(0.1, 0.02, 0.05);
  models.objects[kRod].model.name = "rod";
  return models;
}

}  // namespace monocular_eye_hand::grasp_world
