#include "recognition/work_budget.h"

#include <algorithm>

namespace monocular_eye_hand {

WorkBudget::WorkBudget(long long limit, double seconds)
    : limited_(limit > 0), limit_(limit), seconds_(seconds) {}

WorkBudget WorkBudget::part(int parts) const {
  WorkBudget part = *this;
  part.limit_ = std::max(0LL, limit_ - scored_) / std::max(parts, 1);
  part.scored_ = 0;
  return part;
}

WorkBudget WorkBudget::upTo(long long max_work) const {
  WorkBudget piece = part(1);
  piece.limit_ = limited_ ? std::min(piece.limit_, max_work) : max_work;
  piece.limited_ = true;
  return piece;
}

void WorkBudget::addPiece(const WorkBudget& piece) {
  scored_ += piece.scored_;
  cut_by_work_ = cut_by_work_ || (piece.cut_by_work_ && limited_ && scored_ >= limit_);
  cut_by_time_ = cut_by_time_ || piece.cut_by_time_;
}

void WorkBudget::add(const WorkBudget& part) {
  scored_ += part.scored_;
  cut_by_work_ = cut_by_work_ || part.cut_by_work_;
  cut_by_time_ = cut_by_time_ || part.cut_by_time_;
}

bool WorkBudget::outOfTime() {
  if (seconds_ <= 0) return false;
  const bool over = std::chrono::duration<double>(Clock::now() - start_).count() > seconds_;
  cut_by_time_ = cut_by_time_ || over;
  return over;
}

}  // namespace monocular_eye_hand
