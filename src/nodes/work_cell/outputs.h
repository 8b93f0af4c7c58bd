#pragma once
#include <image_transport/image_transport.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>

#include <memory>

#include "monocular_eye_hand/simulation/cell/camera.h"

namespace monocular_eye_hand {

/// Everything that the node work_cell publishes. Stamps are the cell's time.
class WorkCellOutputs {
 public:
  /// `cell` must outlive it. `camera_threads`: 0 takes all cores.
  WorkCellOutputs(const WorkCell& cell, int camera_threads);

  void clock();
  void joints();  ///< joint_states and gripper/state
  /// camera_info, and the image when someone listens.
  void camera();
  /// Events are logged, too.
  void truth();
  bool newEvents() const { return published_events_ < cell_.events().size(); }

 private:
  std_msgs::Header header(const char* frame) const;

  const WorkCell& cell_;
  CellCamera camera_;
  sensor_msgs::CameraInfo info_;
  size_t published_events_ = 0;
  ros::NodeHandle node_, private_node_;
  ros::Publisher clock_publisher_, joint_publisher_, gripper_publisher_, info_publisher_, truth_publisher_;
  image_transport::Publisher image_publisher_;
};

}  // namespace monocular_eye_hand
