#pragma once
#include <cstdint>
#include <string>

#include "monocular_eye_hand/geometry/nanoseconds.h"

namespace monocular_eye_hand {

/// What is odd about the stamps of successive images.
class StampWatch {
 public:
  /// `stamp`: zero when the driver gave none. `now`: of the clock when the image came; zero: not known.
  void add(Nanoseconds stamp, Nanoseconds now);
  /// Zero, constant or future stamps, and what to do; "" while nothing is wrong.
  const std::string& problem() const { return problem_; }
  /// The stamps are always ahead of the clock.
  bool inFuture() const;
  /// Counts how often stamps went back by more than a second: a bag was played again, somebody set a clock.
  uint64_t restarts() const { return restarts_; }

 private:
  Nanoseconds last_ = 0;
  int repeated_ = 0;  // images in a row with the stamp of the one before
  int ahead_ = 0;     // ... in the future
  uint64_t restarts_ = 0;
  std::string problem_;
};

}  // namespace monocular_eye_hand
