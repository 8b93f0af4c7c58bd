#pragma once
#include <vector>

#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// A straight line between two points, model frame [m].
struct WireframeLine {
  Eigen::Vector3d p, q;
};

/// A model as lines: its sharp edges, and its circles in chords; the edges of its box when it has neither.
std::vector<WireframeLine> wireframe(const ObjectModel& model);

}  // namespace monocular_eye_hand
