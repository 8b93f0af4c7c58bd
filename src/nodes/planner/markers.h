#pragma once
#include <visualization_msgs/MarkerArray.h>

#include "monocular_eye_hand/parameters/planner.h"

namespace monocular_eye_hand {

/// What stands around the arm by the parameters, for rviz: the table and the boxes (namespaces "table",
/// "boxes"), the rectangle of the drop zone and a stroke per place along the parts' long sides ("drop_zone").
visualization_msgs::MarkerArray cellMarkers(const PlannerParameters& parameters);

}  // namespace monocular_eye_hand
