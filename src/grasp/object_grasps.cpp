#include "monocular_eye_hand/grasp/object_grasps.h"

#include "monocular_eye_hand/grasp/plan_grasps.h"

namespace monocular_eye_hand {

const ObjectGraspPlan* bestOf(const std::vector<ObjectGraspPlan>& plans) {
  const ObjectGraspPlan* best = nullptr;
  for (const ObjectGraspPlan& one : plans) {
    if (one.plan.candidates.empty()) continue;
    if (!best || best->plan.candidates.front().quality < one.plan.candidates.front().quality) best = &one;
  }
  return best;
}

ObjectGrasps::ObjectGrasps(const ModelBase* models, const Puma560* arm, const Rigid3& tool0_from_tcp,
                           const GripperOptions& gripper, const GraspSamplingOptions& sampling,
                           const GraspPlanOptions& options)
    : models_(models), arm_(arm), tool0_from_tcp_(tool0_from_tcp), gripper_(gripper), options_(options) {
  options.check();
  for (const KnownObject& known : models->objects)
    model_grasps_.push_back(graspsOf(known, gripper, sampling));
}

bool ObjectGrasps::mayGrasp(int object) const {
  const Handling& handling = models_->objects.at(size_t(object)).handling;
  return handling.grasp && !handling.obstacle;
}

GraspPlan ObjectGrasps::plan(const std::vector<MappedObject>& objects, size_t index,
                             std::optional<double> table_height, const JointVector& current) const {
  const auto modelOf = [&](const MappedObject& object) {
    return &models_->objects.at(size_t(object.object)).model;
  };

  GraspScene scene;
  scene.table = table_height.has_value();
  scene.table_height = table_height.value_or(0);
  for (size_t k = 0; k < objects.size(); ++k)
    if (k != index) scene.obstacles.push_back({modelOf(objects[k]), objects[k].base_from_object});

  const MappedObject& object = objects.at(index);
  return planGrasps({modelOf(object), object.base_from_object, object.covariance}, ofModel(object.object),
                    scene, gripper_, *arm_, tool0_from_tcp_, current, options_);
}

std::vector<ObjectGraspPlan> ObjectGrasps::plans(const std::vector<MappedObject>& objects, int object,
                                                 int number, std::optional<double> table_height,
                                                 const JointVector& current) const {
  std::vector<ObjectGraspPlan> plans;
  for (size_t k = 0; k < objects.size(); ++k)
    if (objects[k].object == object && (number < 0 || objects[k].number == number))
      plans.push_back({k, plan(objects, k, table_height, current)});
  return plans;
}

}  // namespace monocular_eye_hand
