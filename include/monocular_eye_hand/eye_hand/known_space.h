#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// A box that something fills: a wall, the hand, what the hand holds.
struct KnownBox {
  std::string name;  ///< for messages
  Rigid3 base_from_box;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< along its axes [m]
};

/// What is known to be filled, whatever a camera says. Nothing else reaches into it.
struct KnownSpace {
  std::optional<double> table_height;  ///< z of the table's top in base, which everything stands above [m]
  std::vector<KnownBox> boxes;
};

/// How sure a contradiction to known space must be.
struct KnownSpaceTolerance {
  double depth = 0;   ///< an object may reach so deep into known space [m] ...
  double sigmas = 0;  ///< ... and so many sigmas of its pose deeper
};

/// Why an object cannot be where it seems to be, for people: "reaches 9.6 mm below the table's top (...)".
/// Empty when it can. `core`: innerPoints() of the model; `covariance`: of base_from_object, base axes.
std::string reachesIntoKnown(const ObjectModel& model, const std::vector<Eigen::Vector3d>& core,
                             const Rigid3& base_from_object, const Matrix6d& covariance,
                             const KnownSpace& space, const KnownSpaceTolerance& tolerance);

}  // namespace monocular_eye_hand
