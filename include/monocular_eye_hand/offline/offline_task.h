#pragma once
#include <memory>

#include "monocular_eye_hand/model/model_base.h"
#include "monocular_eye_hand/offline/clearing_record.h"
#include "monocular_eye_hand/offline/clearing_watch.h"
#include "monocular_eye_hand/offline/options.h"

namespace monocular_eye_hand {

/// The whole loop without ROS: a camera in the hand of a simulated arm, recognition, the map of the objects,
/// grasps, plans, and the task of clearing the frame. One thread moves everything: cell time passes only
/// while the arm, the fingers or the task wait. The same options and the same seed give the same record,
/// planning times and ClearingTimes aside, whatever the machine and its load (with no time limit of
/// recognition).
class OfflineTask {
 public:
  /// Loads and samples what serves all cells. Throws BadInput on options or files that are broken or do not
  /// fit together.
  explicit OfflineTask(const OfflineOptions& options, const CompileProgress& progress = {});
  ~OfflineTask();
  const ModelBase& models() const;

  /// A cell with the random arrangement of this seed, or with -1 the one of the options. Throws BadInput when
  /// it cannot be arranged.
  ClearingRecord clear(int seed, const ClearingWatch& watch = {}) const;

 private:
  struct Kit;
  std::unique_ptr<const Kit> kit_;
};

}  // namespace monocular_eye_hand
