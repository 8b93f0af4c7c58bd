#pragma once
#include "monocular_eye_hand/geometry/nanoseconds.h"

namespace monocular_eye_hand {

/// How fast cell time may pass. It knows no clock: whoever asks says what time it is.
class CellPace {
 public:
  /// `factor`: cell seconds per second; 0: no waiting while the cell is busy, real time while it rests.
  explicit CellPace(double factor) : factor_(factor) {}
  /// Seconds until the cell may stand at `cell_time`; 0: at once. `now` [s] is of any steady clock. Time lost
  /// beyond kLongestLag is not caught up with.
  double wait(double cell_time, double now, bool busy);

  static constexpr double kLongestLag = 0.1;  ///< [s]

 private:
  double factor_;
  bool anchored_ = false;
  double anchor_cell_ = 0, anchor_now_ = 0;  // cell time and time that belong together
};

/// A row of evenly spaced instants of cell time, at which something is due.
class CellInstants {
 public:
  /// `rate` [Hz]; `first`: the first instant.
  CellInstants(double rate, Nanoseconds first);
  Nanoseconds next() const { return next_; }
  /// Whether the next one has come; then it is over.
  bool pass(Nanoseconds now);

 private:
  Nanoseconds period_, next_;
};

}  // namespace monocular_eye_hand
