#include "monocular_eye_hand/simulation/cell/pace.h"

namespace monocular_eye_hand {

double CellPace::wait(double cell_time, double now, bool busy) {
  const bool unbound = factor_ == 0 && busy;
  if (!anchored_ || unbound) {
    anchored_ = true;
    anchor_cell_ = cell_time;
    anchor_now_ = now;
    return 0;
  }

  const double due = anchor_now_ + (cell_time - anchor_cell_) / (factor_ > 0 ? factor_ : 1.0);
  if (now - due > kLongestLag) anchor_now_ += now - due - kLongestLag;
  return due > now ? due - now : 0;
}

CellInstants::CellInstants(double rate, Nanoseconds first) : period_(nanosecondsOf(1 / rate)), next_(first) {}

bool CellInstants::pass(Nanoseconds now) {
  if (now < next_) return false;
  next_ += period_;
  return true;
}

}  // namespace monocular_eye_hand
