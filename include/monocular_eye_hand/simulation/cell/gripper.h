#pragma once
#include <Eigen/Core>
#include <string>

#include "monocular_eye_hand/arm/arm_description.h"

namespace monocular_eye_hand {

/// The two faces that close on a part, in gripper_tcp: |x| <= half_width, z_low <= z <= z_high, at y = +-
/// half the opening.
struct GripperPads {
  double half_width = 0, z_low = 0, z_high = 0;  ///< [m]
  double area() const { return 2 * half_width * (z_high - z_low); }
};

/// The faces of the fingers' collision solids that meet when the gripper closes. Throws BadInput when there
/// are not two fingers with facing pads.
GripperPads gripperPads(const ArmDescription& arm);

/// Triangles of a solid in its link's frame; cylinders have 48 sides.
Mesh solidMesh(const ArmShape& shape);

/// What one pad meets of a part.
struct PadTouch {
  bool touched = false;
  double y = 0;            ///< of the outermost point between the pads [m]
  Eigen::Vector3d centre;  ///< of the patch the pad's rubber meets [m]
  Eigen::Vector3d normal;  ///< of the part there, unit
  double area = 0;         ///< of that patch, seen along y [m^2]
};

struct GripContact {
  PadTouch low, high;  ///< the pads at -y and +y
  double width() const { return high.y - low.y; }
};

constexpr double kPadCompliance = 0.001;  ///< how deep the pads' rubber gives way [m]
constexpr double kMinPatch = 4e-5;        ///< of the part that each pad must meet [m^2]

/// What of the part lies between pads that are `opening` apart, by exact clipping of its triangles.
GripContact gripContact(const Mesh& mesh, const Rigid3& tcp_from_object, const GripperPads& pads,
                        double opening);

/// "" when the two pads hold the part: both meet enough of it and the line between the patches' centres lies
/// in both friction cones (V.-D. Nguyen, Constructing force-closure grasps, IJRR 1988); else the reason.
std::string gripWeakness(const GripContact& contact, double friction);

}  // namespace monocular_eye_hand
