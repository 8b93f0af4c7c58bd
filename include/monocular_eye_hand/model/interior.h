#pragma once
#include <vector>

#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// Whether a point (object frame, metres) lies inside a closed model; never in an open one.
bool insideSolid(const ObjectModel& model, const Eigen::Vector3d& p_in_object);

/// Points of a regular grid that lie at least `depth` [m] below the surface of a closed model (object frame);
/// where it is nowhere so thick, those in its middle. At most `max_points`, spread evenly; none of an open
/// model.
std::vector<Eigen::Vector3d> innerPoints(const ObjectModel& model, double depth, size_t max_points = 1000);

/// Whether one of two closed models reaches into the other: one of the points `inner_a` of a lies inside b,
/// or one of `inner_b` inside a. Points and models are in their own frames; `a_from_b` relates them.
bool interpenetrate(const ObjectModel& a, const std::vector<Eigen::Vector3d>& inner_a, const ObjectModel& b,
                    const std::vector<Eigen::Vector3d>& inner_b, const Rigid3& a_from_b);

}  // namespace monocular_eye_hand
