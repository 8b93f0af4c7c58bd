#include "recognition/work_budget.h"

#include <algorithm>

namespace monocular_eye_hand {

WorkBudget::WorkBudget(long long limit, double seconds) : limit_(limit), seconds_(seconds), allowed_(limit) {}

void WorkBudget::allow(int parts) {
  allowed_ = scored_ + std::max(0LL, limit_ - scored_) / std::max(parts, 1);
}

bool WorkBudget::outOfTime() {
  if (seconds_ <= 0) return false;
  const bool over = std::chrono::duration<double>(Clock::now() - start_).count() > seconds_;
  cut_by_time_ = cut_by_time_ || over;
  return over;
}

}  // namespace monocular_eye_hand
