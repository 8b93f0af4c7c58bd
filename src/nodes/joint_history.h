#pragma once
#include <ros/time.h>
#include <sensor_msgs/JointState.h>

#include <array>
#include <deque>
#include <mutex>
#include <string>

#include "monocular_eye_hand/arm/puma560.h"

namespace monocular_eye_hand {

/// The arm's joint angles over time, from sensor_msgs/JointState. Safe from several threads.
class JointHistory {
 public:
  JointHistory(const std::array<std::string, 6>& names, double memory) : names_(names), memory_(memory) {}

  /// Takes a message that names all six joints; others (the fingers' own) are left out. A message without
  /// stamp counts as of `now`. When time goes back by more than a second everything older is forgotten.
  void add(const sensor_msgs::JointState& message, const ros::Time& now);

  enum class Match {
    kNone,    ///< none within `max_gap` [s]
    kNear,    ///< the nearest within it
    kBetween  ///< interpolated between two within it
  };
  Match at(const ros::Time& stamp, double max_gap, JointVector* joints) const;
  /// False when there is none yet.
  bool latest(JointVector* joints, ros::Time* stamp) const;
  /// Why messages were left out lately, or that none came.
  std::string problem() const;

 private:
  struct Entry {
    ros::Time stamp;
    JointVector joints;
  };
  const std::array<std::string, 6> names_;
  const double memory_;
  mutable std::mutex mutex_;
  std::deque<Entry> entries_;  // by stamp
  std::string problem_ = "no message came";
};

}  // namespace monocular_eye_hand
