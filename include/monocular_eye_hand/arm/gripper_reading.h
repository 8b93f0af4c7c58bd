#pragma once

namespace monocular_eye_hand {

/// Where the fingers were at a moment of the robot's clock.
struct GripperReading {
  double stamp = 0;  ///< of the clock [s]
  double width = 0;  ///< between the pads [m]
  bool moving = false;
  bool stalled = false;  ///< something stops them

  /// Whether something, of whatever shape, keeps the pads farther apart than this [m].
  bool holds(double min_width) const { return stalled && width > min_width; }
};

}  // namespace monocular_eye_hand
