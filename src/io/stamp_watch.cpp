#include "monocular_eye_hand/io/stamp_watch.h"

#include "monocular_eye_hand/geometry/seconds_text.h"

namespace monocular_eye_hand {
namespace {

constexpr double kFuture = 1.0;  // a stamp is no more than this before the clock [s]
constexpr int kInARow = 3;       // images with the same fault: the camera's way

}  // namespace

void StampWatch::add(Nanoseconds stamp, Nanoseconds now) {
  if (secondsBetween(stamp, last_) > kTimeRestart) ++restarts_;
  repeated_ = stamp == last_ ? repeated_ + 1 : 0;
  last_ = stamp;

  problem_.clear();
  const double ahead = now == 0 ? 0 : secondsBetween(now, stamp);
  ahead_ = ahead > kFuture ? ahead_ + 1 : 0;  // one alone may be the last of a bag that plays again
  if (stamp == 0) {
    problem_ = "the images have no stamp (zero): the camera's driver must set header.stamp";
  } else if (repeated_ >= kInARow) {
    problem_ = "the images all have one stamp: the camera's driver must set header.stamp anew for each";
  } else if (inFuture()) {
    problem_ = "the images' stamps are " + secondsText(ahead, 1) +
               " in the future: do camera and this node share one clock (use_sim_time, NTP)?";
  }
}

bool StampWatch::inFuture() const { return ahead_ >= kInARow; }

}  // namespace monocular_eye_hand
