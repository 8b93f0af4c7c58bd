#include "monocular_eye_hand/arm/joint_history.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace monocular_eye_hand {

void JointHistory::add(const JointSample& sample) {
  std::string problem;
  std::vector<std::pair<size_t, double>> angles;
  for (size_t k = 0; k < names_.size() && problem.empty(); ++k) {
    const auto name = std::find(sample.names.begin(), sample.names.end(), names_[k]);
    if (name == sample.names.end()) continue;
    const size_t index = size_t(name - sample.names.begin());
    if (index >= sample.positions.size())
      problem = "the messages have no position of " + names_[k];
    else if (!std::isfinite(sample.positions[index]))
      problem = "the position of " + names_[k] + " is not finite";
    else
      angles.emplace_back(k, sample.positions[index]);
  }

  const std::lock_guard<std::mutex> lock(mutex_);
  any_ = true;
  if (!problem.empty() || !angles.empty()) problem_ = problem;
  if (!problem.empty()) return;
  for (const auto& [joint, angle] : angles) addAngle(joint, {sample.stamp, angle});
}

void JointHistory::addAngle(size_t joint, const Entry& entry) {
  std::deque<Entry>& entries = entries_[joint];
  if (!entries.empty() && entry.stamp <= entries.back().stamp) {
    if (secondsBetween(entry.stamp, entries.back().stamp) <= kTimeRestart) return;
    entries.clear();
  }
  entries.push_back(entry);
  while (secondsBetween(entries.front().stamp, entries.back().stamp) > memory_) entries.pop_front();
}

JointHistory::Match JointHistory::angleAt(size_t joint, Nanoseconds stamp, double max_gap,
                                          double* angle) const {
  const std::deque<Entry>& entries = entries_[joint];
  const auto after = std::lower_bound(entries.begin(), entries.end(), stamp,
                                      [](const Entry& e, Nanoseconds t) { return e.stamp < t; });
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

JointHistory::Found JointHistory::at(Nanoseconds stamp, double max_gap) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  Found found{Match::kBetween, JointVector::Zero()};
  for (size_t k = 0; k < entries_.size(); ++k)
    found.match = std::min(found.match, angleAt(k, stamp, max_gap, &found.joints[int(k)]));
  return found;
}

double JointHistory::speedAt(Nanoseconds stamp, double span, double max_gap) const {
  const Found here = at(stamp, max_gap);
  if (here.match != Match::kBetween) return 0;

  std::optional<double> slower;
  for (const double side : {-span, span}) {
    if (secondsOf(stamp) + side < 0) continue;
    const Found there = at(stamp + nanosecondsOf(side), max_gap);
    if (there.match != Match::kBetween) continue;
    const double speed = (there.joints - here.joints).cwiseAbs().maxCoeff() / span;
    slower = slower ? std::min(*slower, speed) : speed;
  }
  return slower.value_or(0);
}

std::optional<JointHistory::Latest> JointHistory::latest() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  Latest latest;
  for (size_t k = 0; k < entries_.size(); ++k) {
    if (entries_[k].empty()) return std::nullopt;
    const Entry& last = entries_[k].back();
    latest.joints[int(k)] = last.angle;
    latest.stamp = k == 0 ? last.stamp : std::min(latest.stamp, last.stamp);
  }
  return latest;
}

std::string JointHistory::problem() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!any_) return "no message came";
  if (!problem_.empty()) return problem_;
  std::string missing;
  for (size_t k = 0; k < names_.size(); ++k)
    if (entries_[k].empty()) missing += (missing.empty() ? "" : ", ") + names_[k];
  return missing.empty() ? "" : "the messages have no position of " + missing;
}

}  // namespace monocular_eye_hand
