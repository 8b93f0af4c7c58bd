#pragma once
#include <XmlRpcValue.h>

#include <optional>

#include "monocular_eye_hand/execution/pick_memory.h"

namespace monocular_eye_hand {

/// A memory as a value of the parameter server, and back; none when it is broken or there is none.
XmlRpc::XmlRpcValue toParameter(const PickMemory& memory);
std::optional<PickMemory> fromParameter(XmlRpc::XmlRpcValue value);

/// Keeps the memory on the parameter server, beside the node's own parameters, which a launch file clears:
/// /planner_memory. Without a memory the parameter is deleted.
class ParameterMemory : public PickMemoryStore {
 public:
  void keep(const std::optional<PickMemory>& memory) override;
  std::optional<PickMemory> kept() override;
};

}  // namespace monocular_eye_hand
