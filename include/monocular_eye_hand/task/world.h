#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/action_outcome.h"
#include "monocular_eye_hand/arm/gripper_reading.h"
#include "monocular_eye_hand/eye_hand/object_view.h"
#include "monocular_eye_hand/grasp/plan_grasps.h"

namespace monocular_eye_hand {

/// Where to look from.
struct TaskView {
  int overview = 0;     ///< index of the view of the frame in this round, from 0
  int direction = 0;    ///< from where: another number is another direction
  bool near = false;    ///< true: at `object`, nearer with every `approach`
  bool search = false;  ///< true: the frame from nearer and lower, for what shows no better from afar
  MappedObject object;  ///< near: what to look at
  int approach = 0;     ///< near: 0, 1, 2, ...
};

/// What a look showed.
struct TaskLook {
  bool done = false;
  std::string reason;                 ///< not done: camera silent, no recognition, no hand-eye, ...
  double stamp = 0;                   ///< of the image [s]
  std::vector<MappedObject> objects;  ///< everything known after it; last_stamp == stamp: shown by it
};

/// What grasps an object has.
struct TaskGrasps {
  MappedObject object;  ///< as it was known when they were planned: the map may have moved on since
  GraspPlan plan;
};

/// One of them, with the object that it was planned for.
struct PlannedGrasp {
  MappedObject object;
  GraspCandidate grasp;
};

/// What the gripper says.
struct TaskGrip {
  bool known = false;    ///< false: no answer
  bool holding = false;  ///< something is between the fingers
  std::string reason;    ///< e.g. the width
};
/// By a reading that is fresh enough. `holding_width`: a gripper that closed further holds nothing [m].
TaskGrip gripOf(const GripperReading& gripper, double holding_width);

/// What the task asks of the rest of the robot. Calls block until they are answered and return early when the
/// task is cancelled. "It did not work" is an answer with a reason.
class TaskWorld {
 public:
  virtual ~TaskWorld() = default;
  /// Moves the camera, takes an image, recognises and merges.
  virtual TaskLook look(const TaskView& view) = 0;
  /// Grasps of an object as it is known now, best first.
  virtual TaskGrasps graspTargets(const MappedObject& object) = 0;
  /// Pre-grasp, approach, close, lift.
  virtual ActionResult pick(const PlannedGrasp& planned) = 0;
  virtual TaskGrip grip() = 0;
  /// To the place of this index in the drop zone, counted from 0, and open there; the object then is no
  /// longer known.
  virtual ActionResult carry(const MappedObject& object, int place) = 0;
  /// Opens the gripper where it is, away from any part, after a lost grasp.
  virtual ActionResult open() = 0;
  /// Before something that failed is tried again [s].
  virtual void wait(double /*seconds*/) {}
};

}  // namespace monocular_eye_hand
