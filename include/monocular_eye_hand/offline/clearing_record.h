#pragma once
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/action_outcome.h"
#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// An object of the work cell as it truly is.
struct TrueObject {
  std::string label;  ///< "bridge_1": name and count of that name from 0
  std::string name;   ///< in the model base
  Rigid3 base_from_object;
  bool held = false, in_drop_zone = false;
};

/// One attempt to pick an object.
struct PickRecord {
  std::string name;
  int instance = 0;
  Rigid3 base_from_object;             ///< as recognised
  Rigid3 base_from_grasp;              ///< of gripper_tcp
  std::vector<TrueObject> truth;       ///< when the pick began
  std::optional<ActionResult> result;  ///< none: it did not end
};

/// What the task says of an object.
struct ToldObject {
  std::string name;
  std::string outcome;  ///< as toString(ObjectOutcome)
  std::string reason;
};

/// What the task says at its end.
struct ToldEnd {
  std::string reason;
  double cell_seconds = 0;
  int rounds = 0;
  std::vector<ToldObject> objects;
};

/// Where the time of a clearing went, by the machine's clock [s].
struct ClearingTimes {
  double rendering = 0, recognition = 0, grasps = 0, planning = 0, motion = 0;
  double all = 0;  ///< with what is none of these
};

/// What happened while a frame was cleared, whoever cleared it.
struct ClearingRecord {
  int seed = -1;                  ///< of the random scene; -1: the file's
  std::string frame = "frame";    ///< what was cleared: no part
  std::vector<PickRecord> picks;  ///< in their order
  std::vector<TrueObject> truth;  ///< at the end
  int collisions = 0;             ///< with the true geometry
  std::vector<std::string> hits;  ///< those of them that are known in words: when, and what met what
  int looks = 0;
  std::optional<ToldEnd> end;  ///< none: the task did not end
  std::optional<ClearingTimes> times;
};

}  // namespace monocular_eye_hand
