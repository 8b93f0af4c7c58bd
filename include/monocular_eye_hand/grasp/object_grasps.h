#pragma once
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/eye_hand/object_map.h"
#include "monocular_eye_hand/grasp/grasp_plan.h"

namespace monocular_eye_hand {

/// The grasps of one of several objects.
struct ObjectGraspPlan {
  size_t index = 0;  ///< of the object among those it was planned among
  GraspPlan plan;
};

/// The plan with the best grasp, the first of equals; nullptr when none has a grasp. Points into `plans`.
const ObjectGraspPlan* bestOf(const std::vector<ObjectGraspPlan>& plans);

/// Grasps of mapped objects, each with all the others and the table in the way. Const calls are safe from
/// several threads.
class ObjectGrasps {
 public:
  /// Samples the grasps of all models. Keeps the pointers. Throws BadInput when an option is out of range.
  ObjectGrasps(const ModelBase* models, const Puma560* arm, const Rigid3& tool0_from_tcp,
               const GripperOptions& gripper, const GraspSamplingOptions& sampling,
               const GraspPlanOptions& options);

  /// Of a model, wherever it is, by ModelBase::objects.
  const ModelGrasps& ofModel(int object) const { return model_grasps_.at(size_t(object)); }
  /// The model base lets it be grasped.
  bool mayGrasp(int object) const;

  /// Of objects[index]. `table_height`: z of the table's top in base [m]; none: no table. `current`: where
  /// the arm stands [rad]. Throws BadInput as planGrasps().
  GraspPlan plan(const std::vector<MappedObject>& objects, size_t index, std::optional<double> table_height,
                 const JointVector& current) const;
  /// The same of every one of `objects` that is of the model `object` and has the number `number`; -1: any.
  std::vector<ObjectGraspPlan> plans(const std::vector<MappedObject>& objects, int object, int number,
                                     std::optional<double> table_height, const JointVector& current) const;

 private:
  const ModelBase* models_;
  const Puma560* arm_;
  const Rigid3 tool0_from_tcp_;
  const GripperOptions gripper_;
  const GraspPlanOptions options_;
  std::vector<ModelGrasps> model_grasps_;  // by ModelBase::objects
};

}  // namespace monocular_eye_hand
