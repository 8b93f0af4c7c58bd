#pragma once
#include <ros/ros.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <functional>
#include <optional>
#include <string>

#include "monocular_eye_hand/arm/gripper_history.h"
#include "monocular_eye_hand/arm/joint_history.h"
#include "monocular_eye_hand/eye_hand/chain.h"
#include "monocular_eye_hand/grasp/grasp_advisor.h"
#include "monocular_eye_hand/parameters/eye_hand.h"

namespace monocular_eye_hand {

/// Where hand and camera were at a stamp.
struct HandAtStamp {
  HandPose hand;
  HandEye hand_eye;                       ///< covariance zero: the options' stands in
  bool moves = false;                     ///< the camera does
  double table_height = 0;                ///< z of the table's top in base [m]
  std::optional<GripperReading> gripper;  ///< none: it says nothing
  std::string problem;                    ///< why it is not known; "": it is
};

/// tf and joint_states. tf says where tool0 and the camera are, the joints give the Jacobian and must agree.
class HandInput {
 public:
  /// Both must outlive it.
  HandInput(const EyeHandParameters& parameters, const Puma560& arm);
  /// Waits for what is late, as long as the parameter `wait` says or until `stop`.
  HandAtStamp at(const ros::Time& stamp, const std::string& camera_frame,
                 const std::function<bool()>& stop) const;
  /// Where the arm stands, by a joint state that is not too old.
  ArmNow now() const;
  /// As opticalFrameIn() of tf.
  std::string opticalFrameIn(const std::string& frame) const;
  /// Stamps start again: what was known of tf is forgotten.
  void restart() { buffer_.clear(); }

 private:
  /// Problem of one of the two transforms, "" when it is there.
  std::string lookUp(const std::string& target, const std::string& source, const ros::Time& stamp,
                     Rigid3* target_from_source) const;
  std::string noJointsText(const ros::Time& stamp) const;
  /// What tells that two poses of tool0 in base are not one; "": nothing.
  std::string mismatch(const Rigid3& by_joints, const Rigid3& by_tf) const;
  /// Sets `height` in base; returns why it is not known.
  std::string tableHeight(const ros::Time& stamp, double* height) const;

  const EyeHandParameters& parameters_;
  const Puma560& arm_;
  JointHistory history_;
  GripperHistory grippers_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
  ros::Subscriber joints_, gripper_;
};

}  // namespace monocular_eye_hand
