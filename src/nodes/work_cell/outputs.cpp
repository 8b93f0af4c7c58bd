#include "nodes/work_cell/outputs.h"

#include <cv_bridge/cv_bridge.h>
#include <monocular_eye_hand/GripperState.h>
#include <monocular_eye_hand/WorkCellTruth.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/image_encodings.h>

#include "monocular_eye_hand/arm/arm_state.h"
#include "nodes/common/camera_info.h"
#include "nodes/common/conversion.h"
#include "nodes/common/names.h"
#include "nodes/common/stamps.h"

namespace monocular_eye_hand {
namespace {

void report(const CellEvent& event, const std::string& text) {
  if (event.kind == CellEvent::Kind::kCollision || event.kind == CellEvent::Kind::kLimit)
    ROS_WARN("%s", text.c_str());
  else
    ROS_INFO("%s", text.c_str());
}

}  // namespace

WorkCellOutputs::WorkCellOutputs(const WorkCell& cell, int camera_threads)
    : cell_(cell),
      camera_(cell, camera_threads),
      info_(toMessage(calibrationOf(camera_.camera()))),
      private_node_("~") {
  clock_publisher_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 10);
  joint_publisher_ = node_.advertise<sensor_msgs::JointState>(names::kJointStates, 100);
  gripper_publisher_ = node_.advertise<GripperState>(names::kGripperState, 100);
  info_publisher_ = node_.advertise<sensor_msgs::CameraInfo>(names::kCellCameraInfo, 10);
  truth_publisher_ = private_node_.advertise<WorkCellTruth>(names::kTruth, 100, true);
  image_publisher_ = image_transport::ImageTransport(node_).advertise(names::kCellImage, 10);
}

std_msgs::Header WorkCellOutputs::header(const char* frame) const {
  std_msgs::Header header;
  header.stamp = toTime(nanosecondsOf(cell_.time()));
  header.frame_id = frame;
  return header;
}

void WorkCellOutputs::clock() {
  rosgraph_msgs::Clock message;
  message.clock = toTime(nanosecondsOf(cell_.time()));
  clock_publisher_.publish(message);
}

void WorkCellOutputs::joints() {
  sensor_msgs::JointState joints;
  joints.header = header("");
  for (int j = 0; j < 6; ++j) {
    joints.name.push_back(armJointNames()[size_t(j)]);
    joints.position.push_back(cell_.joints()[j]);
    joints.velocity.push_back(cell_.velocities()[j]);
  }
  for (const char* finger : names::kFingerJoints) {
    joints.name.push_back(finger);
    joints.position.push_back(cell_.gripperWidth() / 2);
    joints.velocity.push_back(cell_.gripperVelocity() / 2);
  }
  joint_publisher_.publish(joints);

  GripperState gripper;
  gripper.header = header("");
  gripper.width = cell_.gripperWidth();
  gripper.moving = cell_.gripperMoving();
  gripper.stalled = cell_.gripperStalled();
  gripper_publisher_.publish(gripper);
}

void WorkCellOutputs::camera() {
  info_.header = header(names::kCameraFrame);
  info_publisher_.publish(info_);
  if (image_publisher_.getNumSubscribers() == 0) return;
  image_publisher_.publish(
      cv_bridge::CvImage(info_.header, sensor_msgs::image_encodings::MONO8, camera_.grey(cell_))
          .toImageMsg());
}

void WorkCellOutputs::truth() {
  WorkCellTruth message;
  message.header = header(names::kBaseFrame);

  const std::vector<CellTruth> objects = cell_.truth();
  for (size_t k = 0; k < objects.size(); ++k) {
    if (objects[k].taken_away) continue;
    WorkCellObject object;
    object.label = objects[k].label;
    object.name = objects[k].name;
    object.pose = toPose(objects[k].base_from_object);
    object.held = objects[k].held;
    object.falling = objects[k].falling;
    object.in_drop_zone = cell_.inDropZone(int(k));
    message.objects.push_back(object);
  }

  message.collisions = cell_.collisions();
  for (; published_events_ < cell_.events().size(); ++published_events_) {
    const CellEvent& event = cell_.events()[published_events_];
    message.events.push_back(textOf(event));
    report(event, message.events.back());
  }
  truth_publisher_.publish(message);
}

}  // namespace monocular_eye_hand
