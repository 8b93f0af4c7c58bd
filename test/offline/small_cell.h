#pragma once
#include <string>

#include "monocular_eye_hand/arm/load_arm_description.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/simulation/cell/scene.h"
#include "monocular_eye_hand/simulation/cell/work_cell.h"

namespace monocular_eye_hand {

inline std::string sourceFile(const std::string& name) {
  return std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/" + name;
}

/// A cell with one bridge on the table.
inline WorkCell cellWithABridge() {
  CellOptions options;
  options.objects.resize(1);
  options.objects[0].name = "bridge";
  options.objects[0].pose.x = 0;
  options.objects[0].pose.y = 0;
  const auto mesh = std::make_shared<Mesh>(loadMesh(sourceFile("models/bridge.ply"), "mm"));
  return WorkCell(makeCellScene(options, {{"bridge", mesh}}),
                  loadArmDescription(sourceFile("urdf/puma560.urdf")));
}

}  // namespace monocular_eye_hand
