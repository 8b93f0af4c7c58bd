#pragma once
#include <monocular_eye_hand/GraspTargetArray.h>
#include <monocular_eye_hand/GraspTargets.h>

#include <optional>
#include <string>

#include "monocular_eye_hand/grasp/object_grasps.h"
#include "monocular_eye_hand/model/known_object.h"
#include "nodes/eye_hand/parameters.h"
#include "nodes/eye_hand/shared_map.h"

namespace monocular_eye_hand {

/// Where the arm stands; `problem` tells why that is not known.
struct ArmNow {
  JointVector joints = JointVector::Zero();
  std::string problem;
};

/// Tells the grasps of what is known, or why there are none. Const calls are safe from several threads.
class GraspAdvisor {
 public:
  /// Samples the grasps of all models. All must outlive it.
  GraspAdvisor(const ModelBase& models, const EyeHandParameters& parameters, const Puma560& arm,
               const Rigid3& tool0_from_tcp);
  /// Answers ~grasp_targets.
  GraspTargets::Response answer(const GraspTargets::Request& request, const KnownObjects& known,
                                const ArmNow& arm) const;
  /// The best grasp of each known object that may be grasped, or why it has none.
  GraspTargetArray best(const KnownObjects& known, const ArmNow& arm) const;
  const Rigid3& tool0FromTcp() const { return tool0_from_tcp_; }
  /// Of a model, by ModelBase::objects.
  const ModelGrasps& modelGrasps(int object) const { return grasps_.ofModel(object); }

 private:
  std::optional<double> tableHeight(const KnownObjects& known) const;

  const ModelBase& models_;
  const EyeHandParameters& parameters_;
  const Rigid3 tool0_from_tcp_;
  const ObjectGrasps grasps_;
};

}  // namespace monocular_eye_hand
