#pragma once
#include <optional>

#include "monocular_eye_hand/execution/placed_object.h"
#include "monocular_eye_hand/planning/pick_plan.h"

namespace monocular_eye_hand {

/// The last pick, as far as it matters to an executor that starts again while the gripper holds the part.
struct PickMemory {
  PlacedObject object;  ///< as it stood
  PickTarget target;
  double stamp = 0;  ///< of the robot's clock, when the fingers closed [s]
};

/// Where the memory outlives the executor. Neither call throws or waits for long: the fingers are about to
/// close.
class PickMemoryStore {
 public:
  virtual ~PickMemoryStore() = default;
  /// Instead of what was kept before; none: forget it.
  virtual void keep(const std::optional<PickMemory>& memory) = 0;
  /// None when there is none, or it cannot be read.
  virtual std::optional<PickMemory> kept() = 0;
};

/// Where no executor starts again: it lives as long as the program.
class VolatilePickMemory : public PickMemoryStore {
 public:
  void keep(const std::optional<PickMemory>& memory) override { memory_ = memory; }
  std::optional<PickMemory> kept() override { return memory_; }

 private:
  std::optional<PickMemory> memory_;
};

}  // namespace monocular_eye_hand
