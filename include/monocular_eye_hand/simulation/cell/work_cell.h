#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/arm_description.h"
#include "monocular_eye_hand/simulation/cell/gripper.h"
#include "monocular_eye_hand/simulation/cell/layout.h"
#include "monocular_eye_hand/simulation/cell/motion.h"

namespace monocular_eye_hand {

/// What happened in the cell, for the record.
struct CellEvent {
  enum class Kind {
    kCollision,  ///< `first` (a link or a carried object) met `second`
    kLimit,      ///< `first` (a joint) was asked for more than it can do
    kGrasped,    ///< the gripper holds `first`
    kSlipped,    ///< the pads met `first` and do not hold it; `text` says why
    kReleased,   ///< `first` was let go
    kTakenAway,  ///< `first` is not in the cell any more
    kRested      ///< `first` came to rest on `second`
  };
  Kind kind = Kind::kCollision;
  double time = 0;            ///< cell time [s]
  std::string first, second;  ///< link, joint, "table", "floor" or an object's label
  std::string text;
};
std::string toString(CellEvent::Kind kind);
/// "12.300 s: rested: bridge_0 on table".
std::string textOf(const CellEvent& event);

/// Truth about one object.
struct CellTruth {
  std::string label;  ///< "bridge_1": name and count of that name from 0, in the order of the scene
  std::string name;
  int model = -1;
  Rigid3 base_from_object;
  bool held = false, falling = false;
  bool taken_away = false;  ///< its pose then means nothing
};

/// The cell without hardware: arm, gripper and objects in cell time. The arm follows its path exactly within
/// its limits; objects move only in the gripper, pushed by a closing finger, or falling. The same scene and
/// the same commands at the same times give the same states: nothing here reads a clock.
class WorkCell {
 public:
  /// Throws BadInput when the start is outside the limits or the gripper's range.
  WorkCell(CellScene scene, ArmDescription arm, const Puma560Options& limits = {});
  ~WorkCell();
  WorkCell(WorkCell&&) noexcept;

  /// Lets `dt` seconds pass, in steps of CellOptions::step counted from time 0. Throws BadInput when dt is
  /// negative or not finite.
  void advance(double dt);
  double time() const;  ///< [s], a whole number of nanoseconds

  /// JointMotion::command at the present time.
  void commandArm(const std::vector<CellPathPoint>& path);
  /// Moves the pads to this opening at CellOptions::gripper_speed, or `speed` when it is positive. Throws
  /// BadInput when the opening is not within 0..gripper_width_max.
  void commandGripper(double width, double speed = 0);

  /// Somebody takes an object out of the cell, out of the gripper too; what stood on it falls. It keeps its
  /// index and does not come back. Throws BadInput when no object in the cell has this label.
  void takeAway(const std::string& label);
  bool takenAway(int object) const;

  const JointVector& joints() const;
  const JointVector& velocities() const;
  bool armMoving() const;
  double gripperWidth() const;     ///< [m]
  double gripperVelocity() const;  ///< of the opening [m/s]
  bool gripperMoving() const;
  bool gripperStalled() const;  ///< stopped by what is between the pads
  int heldObject() const;       ///< CellScene::scene.objects; -1: none

  const CellScene& scene() const;  ///< with the objects where they are now
  const ArmDescription& arm() const;
  std::vector<CellTruth> truth() const;
  std::vector<Rigid3> baseFromLinks() const;
  Rigid3 baseFromTcp() const;
  Rigid3 baseFromCamera() const;
  const std::string& label(int object) const;

  /// Everything that happened, in order of time. A pair that stays in collision is one event.
  const std::vector<CellEvent>& events() const;
  int collisions() const;  ///< events of that kind
  /// True when the object rests (is neither held nor falling) with its middle inside the drop zone.
  bool inDropZone(int object) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace monocular_eye_hand
