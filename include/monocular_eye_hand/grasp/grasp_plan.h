#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/puma560.h"
#include "monocular_eye_hand/grasp/model_grasps.h"

namespace monocular_eye_hand {

/// Defaults stand here and nowhere else.
struct GraspPlanOptions {
  double sigmas = 3;                  ///< so many sigmas of the pose must fit
  double min_clearance = 0.001;       ///< beside them, between pad and part before closing [m]
  double preferred_clearance = 0.01;  ///< the gripper opens so much wider on each side when it can [m]
  double approach_distance = 0.08;    ///< straight way from pre-grasp to grasp [m]
  double lift_distance = 0.10;        ///< straight up after closing [m]
  double max_tilt = 1.2;           ///< of the approach from straight down [rad]; < pi / 2: never from below
  double table_clearance = 0.002;  ///< of everything from the table [m]
  double obstacle_clearance = 0.003;  ///< of everything from the obstacles [m]
  double min_wrist = 0.05;            ///< least |sin q5| at the three poses
  double max_joint_step = 1.2;        ///< no joint turns farther than this from pose to pose [rad]
  int rotation_steps = 16;            ///< about a free axis of the object
  int configurations = 2;             ///< of the arm, kept per grasp
  int max_candidates = 40;            ///< kept

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("sigmas", sigmas);
    v("min_clearance", min_clearance);
    v("preferred_clearance", preferred_clearance);
    v("approach_distance", approach_distance);
    v("lift_distance", lift_distance);
    v("max_tilt", max_tilt);
    v("table_clearance", table_clearance);
    v("obstacle_clearance", obstacle_clearance);
    v("min_wrist", min_wrist);
    v("max_joint_step", max_joint_step);
    v("rotation_steps", rotation_steps);
    v("configurations", configurations);
    v("max_candidates", max_candidates);
  }
};

/// Something the hand must not touch, in the base frame.
struct GraspObstacle {
  const ObjectModel* model = nullptr;
  Rigid3 base_from_object;
};

/// What surrounds the object. base: z up.
struct GraspScene {
  bool table = true;
  double table_height = 0;               ///< z of the table's top in base [m]
  std::vector<GraspObstacle> obstacles;  ///< without the object itself
};

/// The object to be grasped.
struct GraspObject {
  const ObjectModel* model = nullptr;
  Rigid3 base_from_object;
  Matrix6d covariance = Matrix6d::Zero();  ///< base axes; a free axis' variance does not count
};

/// Why a grasp is refused; the order in which it is asked.
enum class GraspRefusal {
  kFromBelow,    ///< the approach is tilted too far
  kTable,        ///< hand or fingers would meet the table
  kClearance,    ///< the pose is too uncertain for the opening or the pads
  kPart,         ///< hand or fingers would meet the part itself
  kObstacle,     ///< ... or another one
  kUnreachable,  ///< no configuration of the arm reaches all three poses within the joint limits
  kSingular,     ///< ... only through the wrist's singularity or with long joint ways
};
std::string toString(GraspRefusal refusal);

/// One way to pick the object up.
struct GraspCandidate {
  Rigid3 base_from_pregrasp, base_from_grasp, base_from_lift;  ///< of gripper_tcp; lift: where it ends
  double part_width = 0;                                       ///< of the part between the pads [m]
  double opening = 0;  ///< of the gripper at pre-grasp and until it closes [m]
  Eigen::Vector3d approach = Eigen::Vector3d::Zero();  ///< unit, base: from pre-grasp to grasp
  ArmConfiguration branch;                             ///< named as in the message GraspTarget
  JointVector pregrasp_joints, grasp_joints, lift_joints;
  double free = 0;       ///< between pad and part on each side before closing [m]
  double needed = 0;     ///< of that for the pose's uncertainty [m]
  double quality = 0;    ///< 0..1, see planGrasps
  int model_grasp = -1;  ///< ModelGrasps::grasps
  std::string source;    ///< ModelGrasp::source
  double clearance() const { return free - needed; }
};

/// How often a rule refused, with the nearest miss.
struct RefusalCount {
  GraspRefusal refusal = GraspRefusal::kFromBelow;
  int count = 0;
  std::string example;  ///< with its numbers
};

struct GraspPlan {
  std::vector<GraspCandidate> candidates;  ///< best first
  std::vector<RefusalCount> refusals;      ///< in the order of GraspRefusal; none with count 0
  bool too_uncertain = false;  ///< no candidate, but a better known pose would give one: look from nearer
  std::string reason;          ///< when there is no candidate: why, with numbers
};

}  // namespace monocular_eye_hand
