#pragma once

namespace monocular_eye_hand {

/// Counts the places of the drop zone over several tasks.
class DropPlaceCount {
 public:
  /// A new task begins: places are counted from 0 again, or with `go_on` where the last task ended: what it
  /// carried still lies there.
  void restart(bool go_on) {
    if (!go_on) next_ = 0;
    first_ = next_;
  }
  /// The place of the drop zone for the task's n-th part, from 0.
  int of(int part) const { return first_ + part; }
  /// The next free one.
  int next() const { return next_; }
  /// Something lies there, or may lie there.
  void take(int place) { next_ = place + 1; }

 private:
  int first_ = 0, next_ = 0;
};

}  // namespace monocular_eye_hand
