#pragma once
#include <ros/time.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace monocular_eye_hand {

/// What every node lives by, watched on a thread of its own: the clock and the master. Says once that
/// use_sim_time is set and nobody publishes /clock, that the clock stands, and that it goes on again. Ends
/// the node when its master was restarted: a new one does not know its topics, and nobody would find them.
class NodeWatch {
 public:
  /// `end`: ends the node; ros::requestShutdown() when it is empty. Create it after the first NodeHandle.
  explicit NodeWatch(std::function<void()> end = {});
  ~NodeWatch();
  NodeWatch(const NodeWatch&) = delete;
  NodeWatch& operator=(const NodeWatch&) = delete;

  /// "the clock stands at 12.300 s since 8.1 s" and what that means for waits; "" while it goes.
  std::string clockProblem() const;

 private:
  void watch();
  void watchClock();
  void watchMaster();
  void warnOfClock(double stands);

  const std::function<void()> end_;
  mutable std::mutex mutex_;
  ros::Time clock_;
  ros::WallTime ticked_at_;  // when the clock was last seen to go on
  bool warned_ = false;      // that it stands
  bool registered_ = false;  // the master has known this node
  bool master_silent_ = false;
  int unknown_ = 0;  // looks in a row at a master that did not know it any more
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace monocular_eye_hand
