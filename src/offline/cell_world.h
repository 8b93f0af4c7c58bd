#pragma once
#include <functional>

#include "monocular_eye_hand/execution/executor.h"
#include "monocular_eye_hand/grasp/grasp_advisor.h"
#include "monocular_eye_hand/offline/clearing_record.h"
#include "monocular_eye_hand/offline/clearing_watch.h"
#include "monocular_eye_hand/offline/options.h"
#include "monocular_eye_hand/task/drop_places.h"
#include "monocular_eye_hand/task/world.h"
#include "offline/cell_eyes.h"
#include "offline/cell_robot.h"

namespace monocular_eye_hand {

/// A work cell as the task sees it: its eyes, the grasps of what they know, and an executor on its arm.
/// Writes down what is picked, beside the truth.
class CellWorld : public TaskWorld {
 public:
  /// All but the options must outlive it.
  CellWorld(WorkCell* cell, const Recognizer& recognizer, const Puma560& arm, const GraspAdvisor& advisor,
            const OfflineOptions& options, std::function<void(const CellLook&)> looked);

  TaskLook look(const TaskView& view) override;
  TaskGrasps graspTargets(const MappedObject& object) override;
  ActionResult pick(const PlannedGrasp& planned) override;
  TaskGrip grip() override;
  ActionResult carry(const MappedObject& object, int place) override;
  ActionResult open() override;
  void wait(double seconds) override { robot_.rest(seconds); }

  /// Lets cell time pass until nothing falls any more.
  void settle();
  const std::vector<PickRecord>& picks() const { return picks_; }
  int looks() const { return eyes_.looks(); }
  ClearingTimes times() const;

 private:
  ActionResult act(const std::function<ActionResult()>& action);
  ActionResult moveCamera(const TaskView& view);
  std::optional<MappedObject> frame() const;
  bool falling() const;

  WorkCell& cell_;
  const Recognizer& recognizer_;
  const GraspAdvisor& advisor_;
  const OfflineOptions options_;
  const Puma560 task_arm_;
  const std::function<void(const CellLook&)> looked_;
  CellRobot robot_;
  VolatilePickMemory memory_;
  PickPlaceExecutor executor_;
  CellEyes eyes_;
  DropPlaceCount places_;
  std::vector<PickRecord> picks_;
  double grasps_ = 0, planning_ = 0, motion_ = 0;  // of the machine's clock [s]
};

/// The objects of a cell as they truly are now.
std::vector<TrueObject> trueObjects(const WorkCell& cell);

}  // namespace monocular_eye_hand
