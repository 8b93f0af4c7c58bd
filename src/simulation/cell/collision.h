#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/arm/arm_description.h"
#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

/// The true solids of a cell: which of them meet. World: the table's frame.
class CellSolids {
 public:
  /// Solids of the arm are `tolerance` smaller than drawn, so that touching is no collision.
  CellSolids(const ArmDescription& arm, const std::vector<SceneObject>& objects, double table_thickness,
             const Table& table, double floor_z, double tolerance);
  ~CellSolids();
  CellSolids(const CellSolids&) = delete;
  CellSolids& operator=(const CellSolids&) = delete;

  void placeArm(const std::vector<Rigid3>& world_from_links);
  void placeObject(int object, const Rigid3& world_from_object);

  static constexpr int kTable = -1, kFloor = -2;
  /// Pairs (link, object, kTable or kFloor) of the arm's solids with the rest. Of the carried object's pairs
  /// those with the fingers are left out. The links that stand on the floor never meet it.
  std::vector<std::pair<int, int>> armCollisions(int carried) const;
  /// Objects, kTable or kFloor that this object meets.
  std::vector<int> objectCollisions(int object) const;
  bool meet(int object_a, int object_b) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace monocular_eye_hand
