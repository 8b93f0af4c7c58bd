#pragma once
#include <string>

#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/offline/clearing_watch.h"

namespace monocular_eye_hand {

/// Pictures of a clearing: NN_<kind>.png of every look with what was recognised in it, and end.png, the table
/// from above when all is done.
class ClearingPictures {
 public:
  /// `models` must outlive it.
  ClearingPictures(std::string folder, const ModelBase& models);
  /// Takes its place in `watch`, which must not outlive it.
  void watch(ClearingWatch* watch);

 private:
  void looked(const CellLook& look);
  void ended(const WorkCell& cell) const;

  const std::string folder_;
  const ModelBase& models_;
  int count_ = 0;
};

}  // namespace monocular_eye_hand
