#pragma once
#include <array>
#include <string>

#include "monocular_eye_hand/arm/arm_description.h"
#include "monocular_eye_hand/arm/arm_state.h"
#include "monocular_eye_hand/grasp/grasping_options.h"

namespace monocular_eye_hand {

/// Parameters of the node eye_hand: the keys of config/eye_hand.yaml. Defaults stand here and in
/// GraspingOptions, and nowhere else.
struct EyeHandParameters : GraspingOptions {
  std::string objects;                   ///< model base, the recogniser's: path of a YAML; required
  std::string urdf;                      ///< path of the arm's URDF, as urdf/puma560.urdf; required
  std::string base_frame = "base_link";  ///< of all results
  std::string tool_frame = "tool0";      ///< the camera hangs on it
  /// In sensor_msgs/JointState, in the order of the arm.
  std::array<std::string, 6> joint_names = armJointNames();
  bool rectified = false;      ///< the recogniser works on image_rect: P of camera_info holds
  double wait = 1.0;           ///< longest wait for tf, joint states and camera_info of a view [s, Moment]
  double memory = 120;         ///< tf and joint states are kept so long [s]
  double max_joint_gap = 0.1;  ///< a joint state farther from the view's stamp does not count [s]
  double max_joint_age = 1.0;  ///< an older joint state is not where the arm is now [s]
  double max_tf_distance = 0.005;  ///< between tool0 of tf and of the joint states [m] ...
  double max_tf_rotation = 0.01;   ///< ... and [rad]: beyond, one of the two is wrong
  int max_waiting = 10;            ///< views that wait for tf; when one more comes the oldest is refused
  double table_height = 0.3;       ///< z of the table's top in table_frame [m]
  std::string table_frame;         ///< level frame of the table in tf; "": base_frame
  double still = 0.05;  ///< a joint that turns faster moves the camera: its image misses nothing [rad/s]
  int marker_triangles = 20000;    ///< meshes with more triangles are shown by their sharp edges
  double label_height = 0.03;      ///< of the markers' texts [m]
  double diagnostic_period = 1.0;  ///< [s, wall clock]

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("objects", objects);
    v("urdf", urdf);
    v("base_frame", base_frame);
    v("tool_frame", tool_frame);
    v("joint_names", joint_names);
    v("rectified", rectified);

    v("wait", wait);
    v("memory", memory);
    v("max_joint_gap", max_joint_gap);
    v("max_joint_age", max_joint_age);
    v("max_tf_distance", max_tf_distance);
    v("max_tf_rotation", max_tf_rotation);
    v("max_waiting", max_waiting);

    v("table_height", table_height);
    v("table_frame", table_frame);
    v("still", still);

    v("marker_triangles", marker_triangles);
    v("label_height", label_height);
    v("diagnostic_period", diagnostic_period);

    GraspingOptions::visit(v);
  }
};

/// The arm of the parameter `urdf`. Throws BadInput when it is not the arm of the parameter `arm`, or its
/// gripper opens less than the parameter `gripper` says.
ArmDescription loadSameArm(const EyeHandParameters& parameters, const Puma560& arm);

}  // namespace monocular_eye_hand
