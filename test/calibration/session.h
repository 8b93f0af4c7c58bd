#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "calibration/hand_eye.h"
#include "support/camera.h"
#include "support/random.h"

namespace monocular_eye_hand {

/// What a simulated hand-eye session is made with.
struct SessionOptions {
  CameraMount mount = CameraMount::kInHand;
  int views = 15;
  double pixel_sigma = 0.2;           ///< [px]
  double arm_sigma_translation = 0;   ///< of each told pose, per axis [m]
  double arm_sigma_rotation = 0;      ///< per axis [rad]
  double max_tilt = 35 * M_PI / 180;  ///< of the board to the image [rad]
};

struct Session {
  Camera camera;
  Rigid3 mount_from_camera, target;  ///< the truth
  std::vector<HandEyeView> views;
};

inline Rigid3 jittered(Random& random, const Rigid3& pose, double metres, double radians) {
  Vector6d d;
  d << metres * normal(random), metres * normal(random), metres * normal(random), radians * normal(random),
      radians * normal(random), radians * normal(random);
  return perturbed(pose, d);
}

/// 10 x 7 corners of 25 mm, its middle the origin.
inline std::vector<Eigen::Vector3d> boardCorners() {
  std::vector<Eigen::Vector3d> corners;
  for (int row = 0; row < 7; ++row)
    for (int column = 0; column < 10; ++column)
      corners.emplace_back(0.025 * (column - 4.5), 0.025 * (row - 3), 0);
  return corners;
}

/// camera_from_target of a camera of 1280 x 1024 pixels, f = 1400 px, 350 to 600 mm before the board.
inline Rigid3 cameraBeforeBoard(Random& random, double max_tilt) {
  const double azimuth = uniform(random, -M_PI, M_PI);
  const Eigen::Vector3d tilt =
      uniform(random, 0, max_tilt) * Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0);
  const Eigen::Matrix3d facing = Eigen::Vector3d(1, -1, -1).asDiagonal();
  const Eigen::Matrix3d roll = expSO3({0, 0, uniform(random, -1, 1)});
  return {expSO3(tilt) * roll * facing,
          {uniform(random, -0.03, 0.03), uniform(random, -0.03, 0.03), uniform(random, 0.35, 0.6)}};
}

inline Session session(Random& random, const SessionOptions& options) {
  Session s;
  s.camera = centredCamera(1280, 1024, 1400);
  const bool in_hand = options.mount == CameraMount::kInHand;
  s.mount_from_camera = in_hand ? Rigid3{expSO3({0.1, -0.2, 1.5}), {0.03, -0.05, 0.08}}
                                : Rigid3{expSO3({2.6, 0.3, -0.4}), {0.6, 0.1, 0.9}};
  s.target = in_hand ? Rigid3{expSO3({0.02, -0.03, 0.4}), {0.5, 0.1, 0.02}}
                     : Rigid3{expSO3({0.2, 0.1, 0.7}), {0.02, 0.03, 0.1}};

  for (int v = 0; v < options.views; ++v) {
    const Rigid3 camera_from_target = cameraBeforeBoard(random, options.max_tilt);
    const Rigid3 mount_from_target = s.mount_from_camera * camera_from_target;
    // camera in hand: base_from_tool tool_from_target = base_from_target; fixed: base_from_target =
    // base_from_tool Z
    const Rigid3 base_from_tool =
        in_hand ? s.target * mount_from_target.inverse() : mount_from_target * s.target.inverse();
    HandEyeView view;
    view.name = "view " + std::to_string(v);
    view.base_from_tool =
        jittered(random, base_from_tool, options.arm_sigma_translation, options.arm_sigma_rotation);
    for (const Eigen::Vector3d& corner : boardCorners()) {
      const Eigen::Vector2d seen = s.camera.project(camera_from_target * corner);
      if (seen.x() < 0 || seen.y() < 0 || seen.x() > s.camera.width - 1 || seen.y() > s.camera.height - 1)
        continue;
      const Eigen::Vector2d noise(normal(random), normal(random));
      view.points.push_back({corner, seen + options.pixel_sigma * noise, options.pixel_sigma});
    }
    s.views.push_back(view);
  }
  return s;
}

/// What a session's options say of its errors.
inline HandEyeOptions knowing(const SessionOptions& session) {
  HandEyeOptions options;
  options.mount = session.mount;
  options.arm_sigma_translation = std::max(1e-7, session.arm_sigma_translation);
  options.arm_sigma_rotation = std::max(1e-7, session.arm_sigma_rotation);
  options.focal_sigma = options.scale_sigma = 0;
  return options;
}

}  // namespace monocular_eye_hand
