#pragma once
#include <vector>

#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

constexpr int kOnTable = -1, kOnFloor = -2;

/// Where a part that is let go comes to rest.
struct Rest {
  Rigid3 world_from_object;
  int on = kOnTable;  ///< index in `others`, kOnTable or kOnFloor
};

/// Straight down: the part tips about its centre of mass into the nearest of its stable poses and sinks until
/// its underside meets the highest support below: another object, the table or (where its centre of mass is
/// beside the table) the floor at `floor_z`. Null entries in `others` are not there.
Rest settle(const SceneObject& object, const std::vector<const SceneObject*>& others, const Table& table,
            double floor_z);

/// How far the object can sink as it is, without tipping, until it meets the table's plane or one of
/// `others` [m].
double dropHeight(const SceneObject& object, const std::vector<const SceneObject*>& others);

}  // namespace monocular_eye_hand
