#include "nodes/work_cell/pace.h"

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

}  // namespace monocular_eye_hand
