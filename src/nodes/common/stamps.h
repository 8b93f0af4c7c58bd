#pragma once
#include <ros/time.h>

#include "monocular_eye_hand/geometry/nanoseconds.h"

namespace monocular_eye_hand {

inline Nanoseconds nanoseconds(const ros::Time& stamp) { return Nanoseconds(stamp.toNSec()); }

inline ros::Time toTime(Nanoseconds stamp) { return ros::Time().fromNSec(uint64_t(stamp)); }

/// A message's stamp, or `now` when its sender gave none.
inline const ros::Time& stampOr(const ros::Time& stamp, const ros::Time& now) {
  return stamp.isZero() ? now : stamp;
}

/// From one stamp to another [s]. ros::Time's own difference throws when they lie more than 68 years apart,
/// as the stamps of a broken driver do, and in a callback that ends the node.
inline double secondsBetween(const ros::Time& from, const ros::Time& to) {
  return secondsBetween(nanoseconds(from), nanoseconds(to));
}

}  // namespace monocular_eye_hand
