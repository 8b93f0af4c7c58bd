#pragma once
#include <array>

#include "monocular_eye_hand/arm/puma560.h"
#include "monocular_eye_hand/task/camera_views.h"
#include "monocular_eye_hand/task/clear_frame.h"

namespace monocular_eye_hand {

/// What the task and its world can be told, whatever the robot is. Defaults stand here and in the structs it
/// holds.
struct TaskOptions {
  /// Where the frame stands, about: the first overview looks there [m, base].
  std::array<double, 3> centre{{0.55, 0, 0.31}};
  double settle = 0.15;          ///< the camera stands so long before an image counts [s]
  double holding_width = 0.002;  ///< a gripper that closed further holds nothing [m]
  CameraViewOptions views;
  ClearFrameOptions clear_frame;
  Puma560Options arm;

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("centre", centre);
    v("settle", settle);
    v("holding_width", holding_width);
    v("views", views);
    v("clear_frame", clear_frame);
    v("arm", arm);
  }
};

}  // namespace monocular_eye_hand
