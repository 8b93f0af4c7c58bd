#include "monocular_eye_hand/arm/arm_description.h"

#include <Eigen/Geometry>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

int ArmDescription::link(const std::string& name) const {
  for (size_t i = 0; i < links.size(); ++i)
    if (links[i].name == name) return int(i);
  throw BadInput("the arm's description has no link '" + name + "'");
}

void ArmDescription::baseFromLinks(const JointVector& joints, double gripper_width,
                                   std::vector<Rigid3>* base_from_links) const {
  base_from_links->resize(links.size());
  for (size_t i = 0; i < links.size(); ++i) {
    const ArmLink& link = links[i];
    Rigid3 pose =
        link.parent < 0 ? Rigid3() : (*base_from_links)[size_t(link.parent)] * link.parent_from_joint;
    if (link.joint >= 0)
      pose.rotation *= Eigen::AngleAxisd(joints[link.joint], link.axis).toRotationMatrix();
    else if (link.finger != 0)
      pose.translation += pose.rotation * (link.finger * gripper_width * link.axis);
    (*base_from_links)[i] = pose;
  }
}

std::vector<Rigid3> ArmDescription::baseFromLinks(const JointVector& joints, double gripper_width) const {
  std::vector<Rigid3> poses;
  baseFromLinks(joints, gripper_width, &poses);
  return poses;
}

}  // namespace monocular_eye_hand
