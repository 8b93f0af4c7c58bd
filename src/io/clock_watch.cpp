#include "monocular_eye_hand/io/clock_watch.h"

#include <fmt/format.h>

namespace monocular_eye_hand {
namespace {

constexpr double kStands = 2.0;        // a clock that does not go on for so long stands [s, wall clock]
constexpr double kFirstMessage = 5.0;  // so long it may take to begin [s, wall clock]

}  // namespace

ClockWatch::News ClockWatch::look(Nanoseconds clock, double wall) {
  const double stands = wall - ticked_at_;
  if (clock != clock_) {
    const bool stood = warned_;
    clock_ = clock;
    ticked_at_ = wall;
    warned_ = false;
    if (!stood) return {};
    return {fmt::format("the clock goes on, after {:.1f} s", stands), true};
  }

  if (warned_ || stands < (clock_ == 0 ? kFirstMessage : kStands)) return {};
  warned_ = true;
  if (clock_ == 0)
    return {fmt::format(
        "use_sim_time is set and nothing came on /clock for {:.0f} s: start the simulation or the bag "
        "(rosbag play --clock), or set use_sim_time to false before the nodes start",
        stands)};
  return {fmt::format(
      "the clock stands at {:.3f} s since {:.1f} s: is the simulation or the bag paused, or the machine "
      "too busy? Waits of this node are paused, too",
      secondsOf(clock_), stands)};
}

std::string ClockWatch::problem(double wall) const {
  const double stands = wall - ticked_at_;
  if (stands < kStands) return "";
  if (clock_ == 0) return "nothing came on /clock yet, though use_sim_time is set: does the simulation run?";
  return fmt::format(
      "the clock stands at {:.3f} s since {:.1f} s: is the simulation paused, or the machine too busy?",
      secondsOf(clock_), stands);
}

}  // namespace monocular_eye_hand
