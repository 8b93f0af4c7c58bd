#pragma once
#include <chrono>

namespace monocular_eye_hand {

/// What one image may cost: hypotheses scored, and optionally seconds. The work is dealt out to the objects
/// in turn, so that one that comes late in the model base gets its part; what an object leaves over goes to
/// those after it. Every thread has a part of its own.
class WorkBudget {
 public:
  /// `limit`: most hypotheses scored, 0 = no limit; `seconds`: wall-clock limit from now on, 0 = none.
  explicit WorkBudget(long long limit = 0, double seconds = 0);

  bool limited() const { return limited_; }  ///< in the work, not the time
  /// A budget for the next part: an equal share of the work that is left, for one of `parts` that are still
  /// to come. Without a limit, parts may be worked on at once.
  WorkBudget part(int parts) const;
  /// A budget for a piece of this part: no more than `most` of its work.
  WorkBudget upTo(long long max_work) const;
  /// Counts what a part of this budget has spent.
  void add(const WorkBudget& part);
  /// The same of a piece: that `most` has cut it is no news.
  void addPiece(const WorkBudget& piece);

  void count(int scored = 1) { scored_ += scored; }
  long long scored() const { return scored_; }  ///< of a part: since it was made

  /// Asked before more work is begun, never after the last of it: true when the part is used up or the time
  /// is over. What is then left undone is what the limits cut.
  bool spent() { return workSpent() || outOfTime(); }
  /// The same without a look at the clock, for steps that take no longer than that.
  bool workSpent() {
    if (!limited_ || scored_ < limit_) return false;
    cut_by_work_ = true;
    return true;
  }
  /// The same for work that is not counted: only the time.
  bool outOfTime();

  bool cutByWork() const { return cut_by_work_; }  ///< some work was left undone because the budget was spent
  bool cutByTime() const { return cut_by_time_; }  ///< ... because the time was over

 private:
  using Clock = std::chrono::steady_clock;
  bool limited_;
  long long limit_;  // most that are scored
  double seconds_;
  Clock::time_point start_ = Clock::now();
  long long scored_ = 0;
  bool cut_by_work_ = false, cut_by_time_ = false;
};

}  // namespace monocular_eye_hand
