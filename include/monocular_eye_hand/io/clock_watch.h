#pragma once
#include <string>

#include "monocular_eye_hand/geometry/nanoseconds.h"

namespace monocular_eye_hand {

/// Whether a simulated clock goes on, for who looks at it again and again.
class ClockWatch {
 public:
  /// What a look has to tell; "": nothing.
  struct News {
    std::string text;
    bool good = false;  ///< the clock goes on again
  };

  /// `wall`: of the wall clock, now [s].
  explicit ClockWatch(double wall) : ticked_at_(wall) {}
  /// `clock`: what it shows; 0: it never came. Tells once that it stands, and that it goes on.
  News look(Nanoseconds clock, double wall);
  /// "the clock stands at 12.300 s since 8.1 s" and what to ask; "" while it goes.
  std::string problem(double wall) const;

 private:
  Nanoseconds clock_ = 0;
  double ticked_at_;     // by the wall clock: when it was last seen to go on
  bool warned_ = false;  // that it stands
};

}  // namespace monocular_eye_hand
