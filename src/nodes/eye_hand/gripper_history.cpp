#include "nodes/eye_hand/gripper_history.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "nodes/common/stamps.h"

namespace monocular_eye_hand {
namespace {

constexpr double kRestart = 1.0;  // time that goes back by more was set back on purpose [s]

}  // namespace

void GripperHistory::add(GripperState state, const ros::Time& now) {
  if (state.header.stamp.isZero()) state.header.stamp = now;
  const ros::Time stamp = state.header.stamp;

  const std::lock_guard<std::mutex> lock(mutex_);
  if (!states_.empty()) {
    const double went_back = secondsBetween(stamp, states_.back().header.stamp);
    if (went_back > kRestart)
      states_.clear();
    else if (went_back > 0)
      return;
    else if (went_back == 0)
      states_.pop_back();
  }
  states_.push_back(std::move(state));
  while (secondsBetween(states_.front().header.stamp, stamp) > memory_) states_.pop_front();
}

std::optional<GripperState> GripperHistory::at(const ros::Time& stamp, double max_age) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto after =
      std::upper_bound(states_.begin(), states_.end(), stamp,
                       [](const ros::Time& t, const GripperState& g) { return t < g.header.stamp; });
  if (after == states_.begin()) return std::nullopt;
  const GripperState& last = *std::prev(after);
  if (secondsBetween(last.header.stamp, stamp) > max_age) return std::nullopt;
  return last;
}

size_t GripperHistory::size() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return states_.size();
}

}  // namespace monocular_eye_hand
