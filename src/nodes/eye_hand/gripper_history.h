#pragma once
#include <monocular_eye_hand/GripperState.h>
#include <ros/time.h>

#include <deque>
#include <mutex>
#include <optional>

namespace monocular_eye_hand {

/// The gripper's states over time. Safe from several threads.
class GripperHistory {
 public:
  /// States are kept for so long [s].
  explicit GripperHistory(double memory) : memory_(memory) {}

  /// A state without stamp counts as of `now`. One that is older than the last is left out; when time goes
  /// back by more than a second what is older is forgotten.
  void add(GripperState state, const ros::Time& now);
  /// The last one of then or before, none when that is more than `max_age` older [s].
  std::optional<GripperState> at(const ros::Time& stamp, double max_age) const;
  size_t size() const;

 private:
  const double memory_;
  mutable std::mutex mutex_;
  std::deque<GripperState> states_;  // by stamp, each stamp once
};

}  // namespace monocular_eye_hand
