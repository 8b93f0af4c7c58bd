#pragma once
#include <cmath>
#include <random>
#include <string>

#include "model/build_model.h"
#include "monocular_eye_hand/eye_hand/object_map.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "support/camera.h"

namespace monocular_eye_hand::map_world {

/// The shipped parts, without view spheres.
inline const ModelBase& models() {
  static const ModelBase base = [] {
    ModelBase b;
    for (const char* name : {"bridge", "flange", "frame", "bracket"})
      b.objects.push_back(
          {buildModel(
               name, loadMesh(std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/models/" + name + ".ply", "mm")),
           {}});
    return b;
  }();
  return base;
}
enum { kBridge, kFlange, kFrame, kBracket };

inline Camera camera() { return centredCamera(640, 480, 600); }

inline Matrix6d diagonal(double metres, double radians) {
  Vector6d v;
  v << Eigen::Vector3d::Constant(metres * metres), Eigen::Vector3d::Constant(radians * radians);
  return v.asDiagonal();
}

/// An image is worst along the viewing axis.
inline Matrix6d imageCovariance(double metres = 5e-4, double radians = 4e-3) {
  Matrix6d c = diagonal(metres, radians);
  c(2, 2) *= 25;
  return c;
}

/// base_from_camera at `eye`, looking at `target`.
inline Rigid3 lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  Rigid3 pose;
  pose.translation = eye;
  const Eigen::Vector3d z = (target - eye).normalized();
  const Eigen::Vector3d x = z.cross(std::abs(z.z()) > 0.99 ? Eigen::Vector3d(Eigen::Vector3d::UnitX())
                                                           : Eigen::Vector3d(Eigen::Vector3d::UnitZ()))
                                .normalized();
  pose.rotation << x, z.cross(x), z;
  return pose;
}

inline Rigid3 upright(double x, double y, double turn = 0) {
  return {Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix(), {x, y, 0}};
}

inline HandEye mounted() {
  HandEye h;
  h.tool0_from_camera.translation = {0.05, 0, 0.08};
  h.covariance = diagonal(5e-4, 8.73e-4);
  return h;
}

/// A view from `eye` to `target` of objects at these places, with true poses.
inline ObjectView view(double stamp, const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
                       const std::vector<std::pair<int, Rigid3>>& objects) {
  ObjectView v;
  v.stamp = stamp;
  v.hand_eye = mounted();
  const Rigid3 base_from_camera = lookAt(eye, target);
  v.hand.base_from_tool0 = base_from_camera * v.hand_eye.tool0_from_camera.inverse();
  v.camera = camera();
  for (const auto& [object, base_from_object] : objects)
    v.objects.push_back({object, base_from_camera.inverse() * base_from_object, imageCovariance(), 0.95});
  return v;
}

}  // namespace monocular_eye_hand::map_world
