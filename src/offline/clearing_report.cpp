#include "monocular_eye_hand/offline/clearing_report.h"

#include <algorithm>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/model/equal_poses.h"

namespace monocular_eye_hand {
namespace {

const ObjectModel& modelOf(const ModelBase& models, const std::string& name) {
  const int index = models.indexOf(name);
  if (index < 0)
    throw BadInput("no object is named '" + name + "' in the model base (" + models.names() + ")");
  return models.objects[size_t(index)].model;
}

const TrueObject* nearestOf(const PickRecord& pick) {
  const TrueObject* nearest = nullptr;
  double min_distance = 0;
  for (const TrueObject& object : pick.truth) {
    if (object.name != pick.name) continue;
    const double distance = (object.base_from_object.translation - pick.base_from_object.translation).norm();
    if (nearest && distance >= min_distance) continue;
    nearest = &object;
    min_distance = distance;
  }
  return nearest;
}

std::optional<GraspError> graspError(const PickRecord& pick, const ModelBase& models) {
  const TrueObject* object = nearestOf(pick);
  if (!object) return std::nullopt;
  const Rigid3 truth =
      nearestEqualPose(modelOf(models, pick.name), object->base_from_object, pick.base_from_object);
  const Rigid3 motion = truth * pick.base_from_object.inverse();
  const Eigen::Vector3d at = pick.base_from_grasp.translation;

  GraspError error;
  error.label = object->label;
  error.distance = (motion * at - at).norm();
  error.angle = logSO3(motion.rotation).norm();
  error.recognised = pick.base_from_object.translation;
  error.truth = object->base_from_object.translation;
  return error;
}

PartReport partReport(const TrueObject& object, const std::vector<PickReport>& picks) {
  PartReport part;
  part.label = object.label;
  part.name = object.name;
  part.in_drop_zone = object.in_drop_zone;
  part.held = object.held;
  for (const PickReport& pick : picks) {
    if (!pick.error || pick.error->label != object.label) continue;
    ++part.attempts;
    part.last = pick;
  }
  return part;
}

}  // namespace

int ClearingReport::carried() const {
  return int(std::count_if(parts.begin(), parts.end(), [](const PartReport& p) { return p.in_drop_zone; }));
}

ClearingSums sumsOf(const std::vector<ClearingReport>& reports) {
  ClearingSums sums;
  for (const ClearingReport& report : reports) {
    sums.cleared += report.cleared;
    sums.parts += int(report.parts.size());
    sums.carried += report.carried();
    sums.collisions += report.collisions;
  }
  return sums;
}

ClearingReport reportOf(const ClearingRecord& record, const ModelBase& models) {
  ClearingReport report;
  report.seed = record.seed;
  report.collisions = record.collisions;
  report.hits = record.hits;
  report.looks = record.looks;
  report.end = record.end;
  report.times = record.times;

  for (const PickRecord& pick : record.picks)
    report.picks.push_back({pick.name, pick.instance, graspError(pick, models), pick.result});
  for (const TrueObject& object : record.truth)
    if (object.name != record.frame) report.parts.push_back(partReport(object, report.picks));
  report.cleared = !report.parts.empty() && report.carried() == int(report.parts.size());
  return report;
}

}  // namespace monocular_eye_hand
