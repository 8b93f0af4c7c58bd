#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/arm_description.h"
#include "monocular_eye_hand/execution/options.h"
#include "monocular_eye_hand/execution/placed_object.h"
#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/mesh/mesh.h"
#include "monocular_eye_hand/planning/collision_world.h"

namespace monocular_eye_hand {

/// What stands around the arm: table, boxes, the objects that eye-hand knows, and what was put
/// down by this arm and nobody sees. All poses are in base_link.
class SceneMemory {
 public:
  /// Table and boxes are those of the options. Reads the meshes of the model base; throws BadInput on what is
  /// broken in it.
  SceneMemory(const ArmDescription& arm, const ExecutorOptions& options);

  bool knows(const std::string& name) const { return meshes_.count(name) > 0; }
  /// Throws BadInput naming what is known when the name is not in the model base.
  void requireKnown(const std::string& name) const;
  std::string names() const;  ///< "bridge, grenade, ..." for messages
  /// A box around its own origin, for something that is not in the model base.
  void learnBox(const std::string& name, const Eigen::Vector3d& size);
  const Mesh& mesh(const std::string& name) const { return meshes_.at(name).mesh; }
  /// All that eye-hand knows now; objects that are not in the model base are left out and returned by name.
  std::vector<std::string> see(const std::vector<PlacedObject>& objects);
  const std::vector<PlacedObject>& seen() const { return seen_; }

  /// Everything, with `subject` (about to be grasped, or held) at its own pose instead of wherever else it is
  /// known to be. Nothing is carried. `free_place`: the caller says that this place is free; only what is
  /// seen there counts. `in_hand`: the subject as it is held now, which the camera may see there.
  CollisionWorld world(const std::optional<PlacedObject>& subject, int free_place = -1,
                       const std::optional<PlacedObject>& in_hand = std::nullopt) const;

  /// All names that the world may have for an object that stands there.
  std::vector<std::string> labels(const PlacedObject& object) const;
  /// The object stands at that place of the drop zone from now on, and nothing else does.
  void putDown(int place, const PlacedObject& object);
  /// The object was taken from where it stood.
  void takeAway(const PlacedObject& object);
  size_t remembered() const { return placed_.size(); }

 private:
  struct Shape {
    Mesh mesh;
    Eigen::Vector3d centre;
    double radius = 0, smallest = 0;  // half the bounding box's diagonal, its smallest side [m]
  };
  static Shape shapeOf(Mesh mesh);
  Eigen::Vector3d centre(const PlacedObject& object) const;
  bool same(const PlacedObject& a, const PlacedObject& b) const;
  bool standsAt(const PlacedObject& other, const PlacedObject& remembered) const;

  const CollisionWorld bare_;
  std::map<std::string, Shape> meshes_;
  std::vector<PlacedObject> seen_;
  std::map<int, PlacedObject> placed_;
};

}  // namespace monocular_eye_hand
