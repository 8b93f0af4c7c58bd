#pragma once
#include <deque>
#include <mutex>
#include <optional>

#include "monocular_eye_hand/arm/gripper_reading.h"
#include "monocular_eye_hand/geometry/nanoseconds.h"

namespace monocular_eye_hand {

/// The gripper's readings over time. Safe from several threads.
class GripperHistory {
 public:
  /// Readings are kept for so long [s].
  explicit GripperHistory(double memory) : memory_(memory) {}

  /// One that is older than the last is left out; when time goes back by more than a second what is older is
  /// forgotten.
  void add(Nanoseconds stamp, const GripperReading& reading);
  /// The last one of then or before, none when that is more than `max_age` older [s].
  std::optional<GripperReading> at(Nanoseconds stamp, double max_age) const;
  size_t size() const;

 private:
  struct Entry {
    Nanoseconds stamp = 0;
    GripperReading reading;
  };

  const double memory_;
  mutable std::mutex mutex_;
  std::deque<Entry> entries_;  // by stamp, each stamp once
};

}  // namespace monocular_eye_hand
