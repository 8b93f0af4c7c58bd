#pragma once
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/simulation/cell/options.h"
#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

/// A cell as it stands before anything moved. The world of `scene` is the table's frame.
struct CellScene {
  CellOptions options;
  Rigid3 base_from_table;
  Scene scene;              ///< known parts and table; world_from_camera is not used
  std::vector<bool> fixed;  ///< one per object: cannot be carried
  Camera camera;

  Rigid3 baseFromObject(int object) const {
    return base_from_table * scene.objects[object].world_from_object;
  }
};

}  // namespace monocular_eye_hand
