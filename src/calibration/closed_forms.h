#pragma once
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// One robot pose with what the camera sees at it: arm * X * camera_from_target = Z for all of them.
/// Camera in the hand: arm = base_from_tool, X = tool_from_camera, Z = base_from_target.
/// Fixed camera, target on the tool: arm = tool_from_base, X = base_from_camera, Z = tool_from_target.
struct HandEyePair {
  Rigid3 arm;
  Rigid3 camera_from_target;
};

/// X by one closed form. They serve as starts: each is best for another kind of error.
struct HandEyeStart {
  std::string method;
  Rigid3 x;
};

/// By every closed form that has a solution: Park and Martin 1994 and Horaud and Dornaika 1995 (rotation
/// first: axes weighed by their angles, or alike), Tsai and Lenz 1989, Andreff et al. 1999 (Kronecker
/// product), Daniilidis 1999 (dual quaternions). None when all motions turn about one axis, or there are
/// fewer than two.
std::vector<HandEyeStart> closedForms(const std::vector<HandEyePair>& pairs);

/// Z of the pairs for an X: the mean of arm * X * camera_from_target, rotations by the nearest rotation of
/// their mean.
Rigid3 meanTarget(const std::vector<HandEyePair>& pairs, const Rigid3& x);

}  // namespace monocular_eye_hand
