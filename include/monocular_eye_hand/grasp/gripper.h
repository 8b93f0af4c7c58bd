#pragma once
#include <array>
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// A solid of the hand, aligned with gripper_tcp.
struct GripperBox {
  std::array<double, 3> centre{{0, 0, 0}};  ///< in gripper_tcp [m]
  std::array<double, 3> size{{0, 0, 0}};    ///< [m]

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("centre", centre);
    v("size", size);
  }
};

/// A parallel two-finger gripper in its frame gripper_tcp: z out of the hand, y from pad to pad, origin
/// between the middles of the pads. Defaults stand here and nowhere else; they enclose urdf/puma560.urdf.
struct GripperOptions {
  double opening_min = 0;           ///< between the pads [m]
  double opening_max = 0.09;        ///< [m]
  double pad_width = 0.018;         ///< along x [m]
  double pad_length = 0.016;        ///< along z [m]
  double finger_width = 0.020;      ///< along x [m]
  double finger_thickness = 0.010;  ///< along y, behind the pad [m]
  double finger_length = 0.051;     ///< from gripper_tcp back to the hand [m]
  double finger_tip = 0.009;        ///< from gripper_tcp to the fingers' ends [m]
  double friction = 0.4;            ///< pad on part
  double compliance = 5e-4;         ///< a pad gives way by so much: what is nearer than this touches [m]
  std::vector<GripperBox> body;     ///< hand and camera; set by the constructor

  GripperOptions();
  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("opening_min", opening_min);
    v("opening_max", opening_max);
    v("pad_width", pad_width);
    v("pad_length", pad_length);
    v("finger_width", finger_width);
    v("finger_thickness", finger_thickness);
    v("finger_length", finger_length);
    v("finger_tip", finger_tip);
    v("friction", friction);
    v("compliance", compliance);
    v("body", body);
  }
};

}  // namespace monocular_eye_hand
