#include "nodes/recognizer/stamp_watch.h"

#include <cstdio>

#include "nodes/common/stamps.h"

namespace monocular_eye_hand {
namespace {

constexpr double kRestart = 1.0;  // stamps that go back by more begin again [s]
constexpr double kFuture = 1.0;   // a stamp is no more than this before the clock [s]
constexpr int kInARow = 3;        // images with the same fault: the camera's way

}  // namespace

void StampWatch::add(const ros::Time& stamp, const ros::Time& now) {
  if (secondsBetween(stamp, last_) > kRestart) ++restarts_;
  repeated_ = stamp == last_ ? repeated_ + 1 : 0;
  last_ = stamp;

  problem_.clear();
  const double ahead = now.isZero() ? 0 : secondsBetween(now, stamp);
  ahead_ = ahead > kFuture ? ahead_ + 1 : 0;  // one alone may be the last of a bag that plays again
  if (stamp.isZero()) {
    problem_ = "the images have no stamp (zero): the camera's driver must set header.stamp";
  } else if (repeated_ >= kInARow) {
    problem_ = "the images all have one stamp: the camera's driver must set header.stamp anew for each";
  } else if (inFuture()) {
    char text[160];
    std::snprintf(
        text, sizeof text,
        "the images' stamps are %.1f s in the future: do camera and this node share one clock (use_sim_time, "
        "NTP)?",
        ahead);
    problem_ = text;
  }
}

bool StampWatch::inFuture() const { return ahead_ >= kInARow; }

}  // namespace monocular_eye_hand
