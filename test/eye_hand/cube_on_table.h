#pragma once
#include "monocular_eye_hand/eye_hand/object_view.h"
#include "monocular_eye_hand/model/known_object.h"

namespace monocular_eye_hand {

/// A cube of 40 mm whose origin is the middle of its foot.
inline ModelBase cube() {
  ModelBase models;
  KnownObject object;
  object.model.name = "cube";
  for (int k = 0; k < 8; ++k)
    object.model.mesh.vertices.emplace_back(k & 1 ? 0.02 : -0.02, k & 2 ? 0.02 : -0.02, k & 4 ? 0.04 : 0);
  for (const Eigen::Vector3d& vertex : object.model.mesh.vertices) object.model.bounds.extend(vertex);
  models.objects.push_back(object);
  return models;
}

/// Where a camera or a hand is that looks straight down.
inline Rigid3 lookingDown(double x, double y, double z) {
  Rigid3 pose;
  pose.rotation = Eigen::Vector3d(1, -1, -1).asDiagonal();
  pose.translation = {x, y, z};
  return pose;
}

/// The cube whose foot stands there in base, as a camera there sees it.
inline SeenObject seenCube(const Rigid3& base_from_camera, const Eigen::Vector3d& foot) {
  SeenObject seen;
  seen.object = 0;
  seen.camera_from_object = base_from_camera.inverse() * Rigid3{Eigen::Matrix3d::Identity(), foot};
  seen.covariance = 1e-8 * Matrix6d::Identity();
  return seen;
}

/// A camera above the table sees a cube whose foot stands at this height [m].
inline ObjectView cubeView(double stamp, double height) {
  ObjectView view;
  view.stamp = stamp;
  view.camera.width = 640;
  view.camera.height = 480;
  view.camera.fx = view.camera.fy = 600;
  view.camera.cx = 319.5;
  view.camera.cy = 239.5;
  view.hand.base_from_tool0 = lookingDown(0.5, 0, 0.8);
  view.known.table_height = 0.3;
  view.objects.push_back(seenCube(view.hand.base_from_tool0, {0.5, 0, height}));
  return view;
}

}  // namespace monocular_eye_hand
