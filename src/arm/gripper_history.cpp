#include "monocular_eye_hand/arm/gripper_history.h"

#include <algorithm>
#include <iterator>

namespace monocular_eye_hand {

void GripperHistory::add(Nanoseconds stamp, const GripperReading& reading) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!entries_.empty()) {
    const double went_back = secondsBetween(stamp, entries_.back().stamp);
    if (went_back > kTimeRestart)
      entries_.clear();
    else if (went_back > 0)
      return;
    else if (went_back == 0)
      entries_.pop_back();
  }

  entries_.push_back({stamp, reading});
  while (secondsBetween(entries_.front().stamp, stamp) > memory_) entries_.pop_front();
}

std::optional<GripperReading> GripperHistory::at(Nanoseconds stamp, double max_age) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto after = std::upper_bound(entries_.begin(), entries_.end(), stamp,
                                      [](Nanoseconds t, const Entry& entry) { return t < entry.stamp; });
  if (after == entries_.begin()) return std::nullopt;
  const Entry& last = *std::prev(after);
  if (secondsBetween(last.stamp, stamp) > max_age) return std::nullopt;
  return last.reading;
}

size_t GripperHistory::size() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return entries_.size();
}

}  // namespace monocular_eye_hand
