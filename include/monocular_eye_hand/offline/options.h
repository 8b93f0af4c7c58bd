#pragma once
#include <string>

#include "monocular_eye_hand/execution/options.h"
#include "monocular_eye_hand/grasp/grasping_options.h"
#include "monocular_eye_hand/recognition/object_estimate.h"
#include "monocular_eye_hand/recognition/options.h"
#include "monocular_eye_hand/simulation/cell/options.h"
#include "monocular_eye_hand/task/options.h"
#include "monocular_eye_hand/tracking/object_tracker.h"

namespace monocular_eye_hand {

/// All that a task without ROS can be told: what the nodes read from their files, without what only a node
/// needs. Model base and URDF are those of `executor`; the table's height is the cell's for all.
struct OfflineOptions {
  std::string cache;  ///< folder of compiled models; "": the user's cache, "none": no cache
  CellOptions cell;
  RecognitionOptions recognition;
  ObjectTrackerOptions instances;
  double support_tolerance =
      SupportPlane().tolerance;  ///< a part may seem to reach so much below the table [m]
  GraspingOptions grasping;
  ExecutorOptions executor;
  TaskOptions task;
};

}  // namespace monocular_eye_hand
