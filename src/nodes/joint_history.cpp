#include "nodes/joint_history.h"

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

constexpr double kRestart = 1.0;  // time that goes back by more was set back on purpose [s]

}  // namespace

void JointHistory::add(const sensor_msgs::JointState& message, const ros::Time& now) {
  Entry entry{message.header.stamp.isZero() ? now : message.header.stamp, JointVector::Zero()};
  std::string problem;
  int found = 0;
  for (size_t k = 0; k < names_.size(); ++k) {
    const auto name = std::find(message.name.begin(), message.name.end(), names_[k]);
    const size_t index = size_t(name - message.name.begin());
    if (name == message.name.end() || index >= message.position.size()) {
      if (problem.empty()) problem = "the messages have no position of " + names_[k];
      continue;
    }
    ++found;
    entry.joints[int(k)] = message.position[index];
    if (!std::isfinite(message.position[index])) problem = "the position of " + names_[k] + " is not finite";
  }
  std::lock_guard<std::mutex> lock(mutex_);
  if (!problem.empty()) {
    if (found > 0 || entries_.empty()) problem_ = problem;
    return;
  }
  problem_.clear();
  if (!entries_.empty() && entry.stamp <= entries_.back().stamp) {
    if ((entries_.back().stamp - entry.stamp).toSec() <= kRestart) return;
    entries_.clear();
  }
  entries_.push_back(entry);
  while ((entries_.back().stamp - entries_.front().stamp).toSec() > memory_) entries_.pop_front();
}

JointHistory::Match JointHistory::at(const ros::Time& stamp, double max_gap, JointVector* joints) const {
  std::lock_guard<std::mutex> lock(mutex_);
  const auto after = std::lower_bound(entries_.begin(), entries_.end(), stamp,
                                      [](const Entry& e, const ros::Time& t) { return e.stamp < t; });
  const Entry* next = after == entries_.end() ? nullptr : &*after;
  const Entry* last = after == entries_.begin() ? nullptr : &*(after - 1);
  if (next && next->stamp == stamp) last = next;
  const double to_next = next ? (next->stamp - stamp).toSec() : max_gap + 1;
  const double to_last = last ? (stamp - last->stamp).toSec() : max_gap + 1;
  if (to_next <= max_gap && to_last <= max_gap) {
    const double share = to_last > 0 ? to_last / (to_last + to_next) : 0;
    *joints = last->joints + share * (next->joints - last->joints);
    return Match::kBetween;
  }
  if (std::min(to_next, to_last) > max_gap) return Match::kNone;
  *joints = to_next < to_last ? next->joints : last->joints;
  return Match::kNear;
}

bool JointHistory::latest(JointVector* joints, ros::Time* stamp) const {
  std::lock_guard<std::mutex> lock(mutex_);
  if (entries_.empty()) return false;
  *joints = entries_.back().joints;
  *stamp = entries_.back().stamp;
  return true;
}

std::string JointHistory::problem() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return problem_;
}

}  // namespace monocular_eye_hand
