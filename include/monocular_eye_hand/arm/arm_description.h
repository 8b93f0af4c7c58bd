#pragma once
#include <memory>
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/puma560.h"
#include "monocular_eye_hand/mesh/mesh.h"

namespace monocular_eye_hand {

/// One solid of a link: a box, a cylinder or a convex mesh.
struct ArmShape {
  enum class Kind { kBox, kCylinder, kMesh };
  Kind kind = Kind::kBox;
  Rigid3 link_from_shape;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< box: x, y, z; cylinder: radius, radius, length [m]
  std::shared_ptr<const Mesh> mesh;                ///< kMesh: in the shape's frame [m]
  Eigen::Vector3d colour{0.7, 0.7, 0.7};           ///< red, green, blue, 0 to 1; of visual shapes
};

/// One link of the URDF: where it hangs and what it is made of.
struct ArmLink {
  std::string name;
  int parent = -1;  ///< ArmDescription::links; -1: the root
  Rigid3 parent_from_joint;
  int joint = -1;     ///< 0..5: turned by that arm joint; -1: fixed (or a finger)
  double finger = 0;  ///< slides by this times the gripper's width along `axis` [m/m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< of the joint, in the joint's frame
  std::vector<ArmShape> collision, visual;
};

/// The arm with camera and gripper as urdf/puma560.urdf draws it: the one source of shapes and fixed frames
/// for planning and simulation.
struct ArmDescription {
  std::vector<ArmLink> links;    ///< parents first; links[0] is base_link
  double gripper_width_max = 0;  ///< widest opening between the finger pads [m]
  Rigid3 tool0_from_tcp;     ///< gripper_tcp: between the finger pads, z out of the hand, y from pad to pad
  Rigid3 tool0_from_camera;  ///< camera_optical_frame

  int link(const std::string& name) const;  ///< throws BadInput naming the link when there is none
  /// Pose of every link at these joint angles and this opening between the finger pads.
  std::vector<Rigid3> baseFromLinks(const JointVector& joints, double gripper_width) const;
  /// The same into a vector that is kept: no allocation after the first call.
  void baseFromLinks(const JointVector& joints, double gripper_width,
                     std::vector<Rigid3>* base_from_links) const;
};

}  // namespace monocular_eye_hand
