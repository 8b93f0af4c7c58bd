#pragma once
#include <ros/time.h>
#include <sensor_msgs/JointState.h>

#include <array>
#include <deque>
#include <mutex>
#include <string>

#include "monocular_eye_hand/arm/puma560.h"

namespace monocular_eye_hand {

/// The arm's joint angles over time, from sensor_msgs/JointState. The joints may come in several messages, of
/// several publishers: each has a history of its own. Safe from several threads.
class JointHistory {
 public:
  JointHistory(const std::array<std::string, 6>& names, double memory) : names_(names), memory_(memory) {}

  /// Takes what a message says of the six joints; other ones (the fingers') are left out, and so is a message
  /// in which one of the six has no position or one that is not finite. A message without stamp counts as of
  /// `now`. When the time of a joint goes back by more than a second what is older is forgotten.
  void add(const sensor_msgs::JointState& message, const ros::Time& now);

  enum class Match {
    kNone,    ///< of one of the joints there is none within `max_gap` [s]
    kNear,    ///< the nearest within it
    kBetween  ///< of all joints interpolated between two within it
  };
  Match at(const ros::Time& stamp, double max_gap, JointVector* joints) const;
  /// How fast the fastest joint turns at `stamp`, on average over `span` before or after it, whichever is
  /// slower; 0 when that is not known [s, rad/s].
  double speedAt(const ros::Time& stamp, double span, double max_gap) const;
  /// The last angle of every joint, and the time since which all of them are known. False while one is not.
  bool latest(JointVector* joints, ros::Time* stamp) const;
  /// What is wrong with the messages of late, or that none came; "": nothing.
  std::string problem() const;

 private:
  struct Entry {
    ros::Time stamp;
    double angle;
  };
  void addAngle(size_t joint, const Entry& entry);
  Match angleAt(size_t joint, const ros::Time& stamp, double max_gap, double* angle) const;

  const std::array<std::string, 6> names_;
  const double memory_;
  mutable std::mutex mutex_;
  std::array<std::deque<Entry>, 6> entries_;  // by stamp
  bool any_ = false;                          // a message came
  std::string problem_;                       // of the last message that named one of the joints
};

}  // namespace monocular_eye_hand
