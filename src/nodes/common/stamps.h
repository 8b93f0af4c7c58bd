#pragma once
#include <ros/time.h>

#include <cstdint>

namespace monocular_eye_hand {

/// From one stamp to another [s]. ros::Time's own difference throws when they lie more than 68 years apart,
/// as the stamps of a broken driver do, and in a callback that ends the node.
inline double secondsBetween(const ros::Time& from, const ros::Time& to) {
  return 1e-9 * double(int64_t(to.toNSec()) - int64_t(from.toNSec()));
}

}  // namespace monocular_eye_hand
