#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/grasp/gripper.h"
#include "monocular_eye_hand/model/known_object.h"

namespace monocular_eye_hand {

/// Defaults stand here and nowhere else.
struct GraspSamplingOptions {
  double step = 0.01;            ///< distance of neighbouring places on a face [m]
  int directions = 12;           ///< approach directions around the line from pad to pad
  double max_face_angle = 0.02;  ///< largest angle between two faces that count as parallel [rad]
  double min_contact = 0.2;      ///< least share of the pads that touches
  double margin = 0.002;         ///< the gripper opens at least so much wider than the part on each side [m]
  double approach = 0.03;        ///< the hand must be able to come from so far back [m]
  double lever_weight = 0.5;     ///< a grasp as far from the centre of mass as half the diameter loses this
                                 ///< share of its quality
  int per_direction = 4;         ///< best grasps kept of one line of closing and one approach
  int max_grasps = 600;          ///< kept in all

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("step", step);
    v("directions", directions);
    v("max_face_angle", max_face_angle);
    v("min_contact", min_contact);
    v("margin", margin);
    v("approach", approach);
    v("lever_weight", lever_weight);
    v("per_direction", per_direction);
    v("max_grasps", max_grasps);
  }
};

/// A way to hold an object, in the object's frame. The same grasp turned by half about gripper_tcp's z, and
/// moved by the object's symmetries, is meant too.
struct ModelGrasp {
  Rigid3 object_from_tcp;
  double width = 0;    ///< between the faces that the pads touch [m]
  double contact = 0;  ///< share of the pads' area that touches on both sides, 0..1
  double lever = 0;    ///< distance of the centre of mass from the line from pad to pad [m]
  double quality = 0;  ///< 0..1: contact, its alignment with the pads, and lever
  std::string source;  ///< "given 2", "faces 3 and 5", "cylinder 2"
};

/// The ways to hold one object, best first; none: why.
struct ModelGrasps {
  std::vector<ModelGrasp> grasps;
  std::string reason;  ///< why there are none, or why given ones are left out
};

/// Middle of the volume of a closed mesh, else of the bounding box.
Eigen::Vector3d centreOfMass(const ObjectModel& model);

/// Antipodal grasps on pairs of parallel faces that look away from each other and on outer cylinders (Nguyen
/// 1988 for two contacts with friction): places on a grid, approach directions all around, kept when enough
/// of both pads touches within the friction cone, the width fits the opening, and neither fingers nor body
/// meet the part on the way in. Deterministic. Throws BadInput on options out of range.
ModelGrasps sampleGrasps(const ObjectModel& model, const GripperOptions& gripper,
                         const GraspSamplingOptions& options = {});

/// The grasps of a known object: given ones, or sampled ones; none, with the reason, for what must not be
/// grasped. Given ones that do not fit the gripper or meet the part are left out and named in `reason`.
ModelGrasps graspsOf(const KnownObject& object, const GripperOptions& gripper,
                     const GraspSamplingOptions& options = {});

}  // namespace monocular_eye_hand
