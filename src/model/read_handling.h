#pragma once
#include <string>

#include "monocular_eye_hand/model/known_object.h"

namespace YAML {
class Node;
}

namespace monocular_eye_hand {

/// Reads one of the keys grasp, obstacle and grasps of an object's entry; false when `key` is none of them.
/// Throws BadInput, its message beginning with `where`, on a value of the wrong kind.
bool readHandling(const std::string& key, const YAML::Node& value, const std::string& where,
                  Handling* handling);

/// Settles what an obstacle implies. Throws BadInput when grasps are given for what must not be grasped.
void finishHandling(Handling* handling);

}  // namespace monocular_eye_hand
