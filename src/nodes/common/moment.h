#pragma once
#include <ros/time.h>

namespace monocular_eye_hand {

/// A moment from which a silence or a time-out is counted. In real time the wall clock counts. Under
/// use_sim_time both clocks must have gone on: a simulation that stands or comes late, and a machine that is
/// too busy for its own clock, are no silence. While no clock came at all the wall clock counts.
class Moment {
 public:
  Moment() = default;  ///< never
  Moment(const ros::WallTime& wall, const ros::Time& clock) : wall_(wall), clock_(clock) {}
  static Moment now() { return Moment(ros::WallTime::now(), ros::Time::now()); }

  bool never() const { return wall_.isZero(); }
  double since() const;  ///< [s]

 private:
  ros::WallTime wall_;
  ros::Time clock_;
};

}  // namespace monocular_eye_hand
