#pragma once
#include <chrono>
#include <vector>

#include "monocular_eye_hand/recognition/object_estimate.h"

namespace monocular_eye_hand {

/// Times the stages of one recognition and keeps their counts.
class StageLog {
 public:
  /// Runs work(&report), which may fill the counts but not begin a stage itself, and returns what it returns.
  template <class Work>
  auto timed(const char* stage, const Work& work) {
    stages_.push_back({stage, 0, {}});
    const Stopwatch stopwatch(&stages_.back().seconds);
    return work(&stages_.back());
  }

  /// Adds the stages of another log, which may have run on another thread.
  void add(const StageLog& other) {
    stages_.insert(stages_.end(), other.stages_.begin(), other.stages_.end());
  }

  const std::vector<StageReport>& stages() const { return stages_; }

 private:
  // Writes the time of its life.
  class Stopwatch {
   public:
    explicit Stopwatch(double* seconds) : seconds_(seconds) {}
    ~Stopwatch() { *seconds_ = std::chrono::duration<double>(Clock::now() - begin_).count(); }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

   private:
    using Clock = std::chrono::steady_clock;
    double* seconds_;
    const Clock::time_point begin_ = Clock::now();
  };

  std::vector<StageReport> stages_;
};

}  // namespace monocular_eye_hand
