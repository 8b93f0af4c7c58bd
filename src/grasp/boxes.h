#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "monocular_eye_hand/grasp/gripper.h"
#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// Axis-aligned solids in gripper_tcp.
using Boxes = std::vector<Eigen::AlignedBox3d>;

/// What fingers and body pass through: while they come `approach` along z with this opening, and close to
/// `width`. [m]
Boxes sweptBoxes(const GripperOptions& gripper, double opening, double width, double approach);
/// The hand at rest with this opening.
Boxes handBoxes(const GripperOptions& gripper, double opening);
Boxes grown(const Boxes& boxes, const Eigen::Vector3d& by);

/// The mesh in gripper_tcp's axes.
class MeshInHand {
 public:
  MeshInHand(const ObjectModel& model, const Rigid3& tcp_from_object);
  /// Surface or inside of the mesh meets one of the boxes.
  bool meets(const Boxes& boxes) const;

 private:
  bool inside(const Eigen::Vector3d& p_in_tcp) const;
  const ObjectModel& model_;
  Rigid3 tcp_from_object_;
  std::vector<Eigen::Vector3d> vertices_;
  Eigen::AlignedBox3d bounds_;
};

/// Separating axes of a box and a triangle (Akenine-Moeller 2001). Touching does not count.
bool overlap(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
             const Eigen::Vector3d& c);

}  // namespace monocular_eye_hand
