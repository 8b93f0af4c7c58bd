#include "nodes/eye_hand/joint_history.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "nodes/common/stamps.h"

namespace monocular_eye_hand {
namespace {

constexpr double kRestart = 1.0;  // time that goes back by more was set back on purpose [s]

}  // namespace

void JointHistory::add(const sensor_msgs::JointState& message, const ros::Time& now) {
  const ros::Time stamp = message.header.stamp.isZero() ? now : message.header.stamp;
  std::string problem;
  std::vector<std::pair<size_t, double>> angles;
  for (size_t k = 0; k < names_.size() && problem.empty(); ++k) {
    const auto name = std::find(message.name.begin(), message.name.end(), names_[k]);
    if (name == message.name.end()) continue;
    const size_t index = size_t(name - message.name.begin());
    if (index >= message.position.size())
      problem = "the messages have no position of " + names_[k];
    else if (!std::isfinite(message.position[index]))
      problem = "the position of " + names_[k] + " is not finite";
    else
      angles.emplace_back(k, message.position[index]);
  }

  std::lock_guard<std::mutex> lock(mutex_);
  any_ = true;
  if (!problem.empty() || !angles.empty()) problem_ = problem;
  if (!problem.empty()) return;
  for (const auto& [joint, angle] : angles) addAngle(joint, {stamp, angle});
}

void JointHistory::addAngle(size_t joint, const Entry& entry) {
  std::deque<Entry>& entries = entries_[joint];
  if (!entries.empty() && entry.stamp <= entries.back().stamp) {
    if (secondsBetween(entry.stamp, entries.back().stamp) <= kRestart) return;
    entries.clear();
  }
  entries.push_back(entry);
  while (secondsBetween(entries.front().stamp, entries.back().stamp) > memory_) entries.pop_front();
}

JointHistory::Match JointHistory::angleAt(size_t joint, const ros::Time& stamp, double max_gap,
                                          double* angle) const {
  const std::deque<Entry>& entries = entries_[joint];
  const auto after = std::lower_bound(entries.begin(), entries.end(), stamp,
                                      [](const Entry& e, const ros::Time& t) { return e.stamp < t; });
  const Entry* next = after == entries.end() ? nullptr : &*after;
  const Entry* last = after == entries.begin() ? nullptr : &*(after - 1);
  if (next && next->stamp == stamp) last = next;
  const double to_next = next ? secondsBetween(stamp, next->stamp) : max_gap + 1;
  const double to_last = last ? secondsBetween(last->stamp, stamp) : max_gap + 1;
  if (to_next <= max_gap && to_last <= max_gap) {
    const double share = to_last > 0 ? to_last / (to_last + to_next) : 0;
    *angle = last->angle + share * (next->angle - last->angle);
    return Match::kBetween;
  }
  if (std::min(to_next, to_last) > max_gap) return Match::kNone;
  *angle = to_next < to_last ? next->angle : last->angle;
  return Match::kNear;
}

JointHistory::Match JointHistory::at(const ros::Time& stamp, double max_gap, JointVector* joints) const {
  std::lock_guard<std::mutex> lock(mutex_);
  Match worst = Match::kBetween;
  for (size_t k = 0; k < entries_.size(); ++k)
    worst = std::min(worst, angleAt(k, stamp, max_gap, &(*joints)[int(k)]));
  return worst;
}

double JointHistory::speedAt(const ros::Time& stamp, double span, double max_gap) const {
  JointVector here, there;
  if (at(stamp, max_gap, &here) != Match::kBetween) return 0;
  std::optional<double> slower;
  for (const double side : {-span, span}) {
    if (stamp.toSec() + side < 0 || at(stamp + ros::Duration(side), max_gap, &there) != Match::kBetween)
      continue;
    const double speed = (there - here).cwiseAbs().maxCoeff() / span;
    slower = slower ? std::min(*slower, speed) : speed;
  }
  return slower.value_or(0);
}

bool JointHistory::latest(JointVector* joints, ros::Time* stamp) const {
  std::lock_guard<std::mutex> lock(mutex_);
  ros::Time oldest;
  for (size_t k = 0; k < entries_.size(); ++k) {
    if (entries_[k].empty()) return false;
    const Entry& last = entries_[k].back();
    (*joints)[int(k)] = last.angle;
    if (k == 0 || last.stamp < oldest) oldest = last.stamp;
  }
  *stamp = oldest;
  return true;
}

std::string JointHistory::problem() const {
  std::lock_guard<std::mutex> lock(mutex_);
  if (!any_) return "no message came";
  if (!problem_.empty()) return problem_;
  std::string missing;
  for (size_t k = 0; k < names_.size(); ++k)
    if (entries_[k].empty()) missing += (missing.empty() ? "" : ", ") + names_[k];
  return missing.empty() ? "" : "the messages have no position of " + missing;
}

}  // namespace monocular_eye_hand
