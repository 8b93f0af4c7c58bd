#pragma once
#include <ros/ros.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <optional>

#include "monocular_eye_hand/parameters/work_cell.h"
#include "monocular_eye_hand/simulation/cell/command.h"
#include "monocular_eye_hand/simulation/cell/pace.h"
#include "monocular_eye_hand/simulation/cell/work_cell.h"
#include "nodes/work_cell/outputs.h"

namespace monocular_eye_hand {

/// The node work_cell: a cell in its own time, driven by commands as hardware would be. One thread: between
/// two instants of cell time it takes commands and waits, at an instant it publishes. Its pace is that of
/// the machine's steady clock, never of ros::Time.
class WorkCellNode {
 public:
  WorkCellNode(WorkCell cell, const WorkCellParameters& parameters);
  /// Until ROS shuts down.
  void run();

 private:
  Nanoseconds now() const;  ///< cell time
  Nanoseconds nextInstant() const;
  /// Commands that come until the cell may go on to the next instant, and at least those that are there.
  void takeCommands();
  void startWaiting();
  void publishDue();
  bool driven() const;  ///< arm or gripper
  bool moving() const;  ///< one of them, or an object
  void onTrajectory(const trajectory_msgs::JointTrajectory& message);
  void onWidth(const std_msgs::Float64& message);
  void onTakeAway(const std_msgs::String& message);

  const bool images_in_motion_;
  WorkCell cell_;
  WorkCellOutputs outputs_;
  CellPace pace_;
  CellInstants joint_instants_, camera_instants_, truth_instants_;
  std::optional<ArmCommand> waiting_;  // its start is still to come
  ros::NodeHandle node_;
  ros::Subscriber trajectory_subscriber_, width_subscriber_, take_away_subscriber_;
};

}  // namespace monocular_eye_hand
