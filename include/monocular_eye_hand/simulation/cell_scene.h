#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/simulation/cell_options.h"
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

/// Puts the objects of `options` (or with random.seed >= 0 a random arrangement) on the table. An object
/// whose pose is less than 1 mm off resting is set down on the table. Throws BadInput when the model base
/// lacks a named object or an object sinks into the table, and when a random arrangement finds no room.
CellScene makeCellScene(const CellOptions& options, const std::vector<NamedMesh>& models);

}  // namespace monocular_eye_hand
