#pragma once
#include <functional>

#include "monocular_eye_hand/eye_hand/view_map.h"
#include "monocular_eye_hand/offline/clearing_watch.h"
#include "monocular_eye_hand/offline/options.h"
#include "monocular_eye_hand/recognition/recognizer.h"
#include "monocular_eye_hand/simulation/cell/camera.h"
#include "monocular_eye_hand/tracking/object_tracker.h"

namespace monocular_eye_hand {

/// Camera, recogniser and object map of a work cell, on an arm that stands.
class CellEyes {
 public:
  /// All but the options must outlive it.
  CellEyes(const WorkCell& cell, const Recognizer& recognizer, const Puma560& arm,
           const OfflineOptions& options);

  /// Takes an image of the cell as it stands now, recognises and merges. `view`, `looked`: for whoever
  /// watches.
  AddedView look(const TaskView& view, const std::function<void(const CellLook&)>& looked);
  /// It is not where it was any more.
  void forget(const MappedObject& object);
  const MapState& known() const { return map_.state(); }

  int looks() const { return looks_; }
  double renderingSeconds() const { return rendering_; }      ///< of the machine's clock
  double recognitionSeconds() const { return recognition_; }  ///< of the machine's clock

 private:
  RecognitionResult recognise(const CellImage& image);
  ObjectView viewOf(const CellImage& image, const RecognitionResult& result) const;
  double tableHeight() const { return options_.cell.table.pose.z; }

  const WorkCell& cell_;
  const Recognizer& recognizer_;
  const Puma560& arm_;
  const OfflineOptions options_;
  CellCamera camera_;
  ObjectTracker tracker_;
  ViewMap map_;
  int looks_ = 0;
  double rendering_ = 0, recognition_ = 0;
};

}  // namespace monocular_eye_hand
