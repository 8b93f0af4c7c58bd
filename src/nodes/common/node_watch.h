#pragma once
#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "monocular_eye_hand/io/clock_watch.h"

namespace monocular_eye_hand {

/// What every node lives by, watched on a thread of its own: the clock (as ClockWatch tells) and the master.
/// Ends the node when its master was restarted: a new one does not know its topics, and nobody would find
/// them.
class NodeWatch {
 public:
  /// `end`: ends the node; ros::requestShutdown() when it is empty. Create it after the first NodeHandle.
  explicit NodeWatch(std::function<void()> end = {});
  ~NodeWatch();
  NodeWatch(const NodeWatch&) = delete;
  NodeWatch& operator=(const NodeWatch&) = delete;

  /// As ClockWatch::problem(); "" in real time.
  std::string clockProblem() const;

 private:
  void watch();
  void watchClock();
  void watchMaster();

  const std::function<void()> end_;
  mutable std::mutex mutex_;
  ClockWatch clock_;
  bool registered_ = false;  // the master has known this node
  bool master_silent_ = false;
  int unknown_ = 0;  // looks in a row at a master that did not know it any more
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace monocular_eye_hand
