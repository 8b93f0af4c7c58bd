#pragma once
#include <array>
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// Something that stands in the cell, beside table and objects.
struct CellBox {
  std::string name;
  double x = 0, y = 0, z = 0, roll = 0, pitch = 0, yaw = 0;  ///< middle in the arm's base [m, rad]
  std::array<double, 3> size{{0, 0, 0}};                     ///< along its x, y, z [m]

  Rigid3 baseFromBox() const;
  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("name", name);
    v("x", x);
    v("y", y);
    v("z", z);
    v("roll", roll);
    v("pitch", pitch);
    v("yaw", yaw);
    v("size", size);
  }
};

/// Throws BadInput when a name stands twice, or is "table".
void requireOwnNames(const std::vector<CellBox>& boxes);

/// base_from_frame of a place and its rotations about fixed axes, as a URDF spells them [m, rad].
Rigid3 poseOf(double x, double y, double z, double roll, double pitch, double yaw);

}  // namespace monocular_eye_hand
