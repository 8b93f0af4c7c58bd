#pragma once
#include <cmath>
#include <cstdint>

namespace monocular_eye_hand {

/// A moment since the zero of its clock [ns]. A double does not hold the stamps of a driver exactly.
using Nanoseconds = int64_t;

/// A clock, or stamps, that go back by more were set back on purpose, or a recording began again: what was
/// known of later times does not count any more [s].
constexpr double kTimeRestart = 1.0;

/// The moment in seconds, to the nearest double [s].
inline double secondsOf(Nanoseconds moment) {
  constexpr Nanoseconds kSecond = 1000000000;
  return double(moment / kSecond) + 1e-9 * double(moment % kSecond);
}

/// The nearest moment; `seconds` [s].
inline Nanoseconds nanosecondsOf(double seconds) { return Nanoseconds(std::llround(seconds * 1e9)); }

/// From one moment to another [s].
inline double secondsBetween(Nanoseconds from, Nanoseconds to) { return 1e-9 * double(to - from); }

}  // namespace monocular_eye_hand
