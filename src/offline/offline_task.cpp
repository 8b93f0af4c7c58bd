#include "monocular_eye_hand/offline/offline_task.h"

#include <utility>

#include "monocular_eye_hand/arm/load_arm_description.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/simulation/cell/scene.h"
#include "offline/cell_world.h"
#include "offline/wall_clock.h"

namespace monocular_eye_hand {
namespace {

const OfflineOptions& checked(const OfflineOptions& options) {
  options.cell.check();
  options.recognition.check();
  options.instances.check();
  options.grasping.check();
  options.executor.check();
  options.task.check();
  return options;
}

ArmDescription armOf(const OfflineOptions& options) {
  ArmDescription description = loadArmDescription(options.executor.urdf);
  for (const Puma560Options* arm : {&options.executor.arm, &options.grasping.arm, &options.task.arm})
    requireSameArm(description, Puma560(*arm));
  return description;
}

std::vector<ToldObject> toldObjects(const std::vector<TaskObject>& objects) {
  std::vector<ToldObject> told;
  for (const TaskObject& object : objects)
    told.push_back({object.object.name, toString(object.outcome), object.reason});
  return told;
}

std::vector<std::string> hitsOf(const std::vector<CellEvent>& events) {
  std::vector<std::string> hits;
  for (const CellEvent& event : events)
    if (event.kind == CellEvent::Kind::kCollision) hits.push_back(textOf(event));
  return hits;
}

}  // namespace

struct OfflineTask::Kit {
  Kit(const OfflineOptions& given, const CompileProgress& progress)
      : options(checked(given)),
        recognizer(loadModels(options.executor.objects, ModelDepth::kViews, {}, options.cache, progress),
                   options.recognition),
        description(armOf(options)),
        meshes(namedMeshes(recognizer.models())),
        arm(options.grasping.arm),
        advisor(recognizer.models(), options.grasping, arm, description.tool0_from_tcp) {}

  WorkCell cell(int seed) const {
    CellOptions arrangement = options.cell;
    if (seed >= 0) arrangement.random.seed = seed;
    return WorkCell(makeCellScene(arrangement, meshes), description, options.executor.arm);
  }

  const OfflineOptions options;
  const Recognizer recognizer;
  const ArmDescription description;
  const std::vector<NamedMesh> meshes;
  const Puma560 arm;
  const GraspAdvisor advisor;
};

OfflineTask::OfflineTask(const OfflineOptions& options, const CompileProgress& progress)
    : kit_(std::make_unique<const Kit>(options, progress)) {}

OfflineTask::~OfflineTask() = default;

const ModelBase& OfflineTask::models() const { return kit_->recognizer.models(); }

ClearingRecord OfflineTask::clear(int seed, const ClearingWatch& watch) const {
  const double begin = wallSeconds();
  WorkCell cell = kit_->cell(seed);
  CellWorld world(&cell, kit_->recognizer, kit_->arm, kit_->advisor, kit_->options, watch.looked);
  const ClearFrameOptions& clear_frame = kit_->options.task.clear_frame;
  const TaskResult result = ClearFrameTask(&models(), &world, clear_frame, {}, watch.feedback).run();
  const double cell_seconds = cell.time();
  world.settle();
  if (watch.ended) watch.ended(cell);

  ClearingRecord record;
  record.seed = seed;
  record.frame = clear_frame.frame;
  record.picks = world.picks();
  record.truth = trueObjects(cell);
  record.collisions = cell.collisions();
  record.hits = hitsOf(cell.events());
  record.looks = world.looks();
  record.end = ToldEnd{result.reason, cell_seconds, result.rounds, toldObjects(result.objects)};
  record.times = world.times();
  record.times->all = wallSeconds() - begin;
  return record;
}

}  // namespace monocular_eye_hand
