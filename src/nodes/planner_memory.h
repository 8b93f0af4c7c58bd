#pragma once
#include <XmlRpcValue.h>

#include <optional>

#include "monocular_eye_hand/execution/scene_memory.h"
#include "monocular_eye_hand/planning/pick_planner.h"

namespace monocular_eye_hand {

/// The last pick, as far as it matters to a planner that starts again while the gripper holds the part.
struct PickMemory {
  PlacedObject object;  ///< as it stood
  PickTarget target;
  double stamp = 0;  ///< of the clock, when the fingers closed [s]
};

/// A memory as a value of the parameter server, and back; none when it is broken or there is none.
XmlRpc::XmlRpcValue toParameter(const PickMemory& memory);
std::optional<PickMemory> fromParameter(XmlRpc::XmlRpcValue value);

/// Keeps the memory on the parameter server, beside the node's own parameters, which a launch file clears:
/// /planner_memory. Without a memory the parameter is deleted.
void keepMemory(const std::optional<PickMemory>& memory);
std::optional<PickMemory> keptMemory();

}  // namespace monocular_eye_hand
