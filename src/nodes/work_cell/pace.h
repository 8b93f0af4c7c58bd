#pragma once

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

}  // namespace monocular_eye_hand
