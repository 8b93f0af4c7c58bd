#pragma once
#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <cstdint>
#include <mutex>
#include <string>

#include "monocular_eye_hand/eye_hand/shared_map.h"
#include "nodes/common/moment.h"
#include "nodes/eye_hand/hand_input.h"
#include "nodes/eye_hand/outputs.h"

namespace monocular_eye_hand {

/// Of what the node tells; all must outlive the diagnostics.
struct EyeHandParts {
  const ros::Subscriber& views;
  const ros::Subscriber& infos;
  const HandInput& hand;
  const SharedMap& map;
  const EyeHandOutputs& outputs;
};

/// /diagnostics of the node eye_hand: "views" (do they arrive, are they used, why not) and "arm". The first
/// refusal after a used view is logged, then one every ten seconds. Runs on wall time: a paused clock hides
/// nothing.
class EyeHandDiagnostics {
 public:
  EyeHandDiagnostics(double period, const EyeHandParts& parts);
  void start();
  void viewUsed(const std::string& outcomes);
  void viewRefused(const std::string& reason);
  /// Not used, and nothing is wrong with that.
  void viewLeftOut();

 private:
  void views(diagnostic_updater::DiagnosticStatusWrapper& status);
  void arm(diagnostic_updater::DiagnosticStatusWrapper& status);

  const double period_;
  const EyeHandParts parts_;
  std::mutex mutex_;
  uint64_t used_ = 0, refused_ = 0, left_out_ = 0;
  std::string problem_, outcomes_;
  ros::WallTime logged_at_;  // zero: the next refusal is logged
  Moment last_view_at_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace monocular_eye_hand
