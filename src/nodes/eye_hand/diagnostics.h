#pragma once
#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

#include "nodes/common/moment.h"

namespace monocular_eye_hand {

/// What the rest of the node tells on request.
struct EyeHandState {
  std::string objects_topic, info_topic;
  uint32_t objects_publishers = 0, info_publishers = 0;
  bool on_request = false;   ///< the recogniser works when it is asked only
  std::string arm_problem;   ///< why the joints now are not known; "": they are
  std::string known;         ///< the objects in words
  double grasp_seconds = 0;  ///< the last time all best grasps were computed
};

/// /diagnostics of the node eye_hand: "views" (do they arrive, are they used, why not) and "arm". The first
/// refusal after a used view is logged, then one every ten seconds. Runs on wall time: a paused clock hides
/// nothing.
class EyeHandDiagnostics {
 public:
  EyeHandDiagnostics(double period, std::function<EyeHandState()> state);
  void start();
  void viewUsed(const std::string& outcomes);
  void viewRefused(const std::string& reason);
  /// Not used, and nothing is wrong with that.
  void viewLeftOut();

 private:
  void views(diagnostic_updater::DiagnosticStatusWrapper& status);
  void arm(diagnostic_updater::DiagnosticStatusWrapper& status);

  const double period_;
  const std::function<EyeHandState()> state_;
  std::mutex mutex_;
  uint64_t used_ = 0, refused_ = 0, left_out_ = 0;
  std::string problem_, outcomes_;
  ros::WallTime logged_at_;  // zero: the next refusal is logged
  Moment last_view_at_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace monocular_eye_hand
