#pragma once
#include <functional>
#include <opencv2/core.hpp>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/recognition/object_estimate.h"
#include "monocular_eye_hand/simulation/cell/work_cell.h"
#include "monocular_eye_hand/task/clear_frame.h"

namespace monocular_eye_hand {

/// One image that the task asked for.
struct CellLook {
  TaskView view;
  cv::Mat grey;  ///< CV_8UC1, raw pixels
  Camera camera;
  RecognitionResult result;
};

/// What may be watched while a cell is cleared; each may be empty.
struct ClearingWatch {
  std::function<void(const TaskFeedback&)> feedback;
  std::function<void(const CellLook&)> looked;
  std::function<void(const WorkCell&)> ended;
};

}  // namespace monocular_eye_hand
