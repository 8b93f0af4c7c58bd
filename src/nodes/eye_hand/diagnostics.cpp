#include "nodes/eye_hand/diagnostics.h"

namespace monocular_eye_hand {
namespace {

using diagnostic_msgs::DiagnosticStatus;
constexpr double kSilence =
    10.0;  // without a view for so long the recogniser is reported [s], unless it waits to be asked
constexpr double kLogAgain = 10.0;  // the same problem is logged again [s]

}  // namespace

EyeHandDiagnostics::EyeHandDiagnostics(double period, std::function<EyeHandState()> state)
    : period_(period), state_(std::move(state)) {
  last_view_at_ = Moment::now();
  updater_.setHardwareID("none");
  updater_.add("views", this, &EyeHandDiagnostics::views);
  updater_.add("arm", this, &EyeHandDiagnostics::arm);
}

void EyeHandDiagnostics::start() {
  timer_ = ros::NodeHandle().createWallTimer(ros::WallDuration(period_),
                                             [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

void EyeHandDiagnostics::viewUsed(const std::string& outcomes) {
  std::lock_guard<std::mutex> lock(mutex_);
  ++used_;
  outcomes_ = outcomes;
  if (!problem_.empty()) ROS_INFO("views are used again");
  problem_.clear();
  logged_at_ = ros::WallTime();
  last_view_at_ = Moment::now();
}

void EyeHandDiagnostics::viewRefused(const std::string& reason) {
  std::lock_guard<std::mutex> lock(mutex_);
  ++refused_;
  problem_ = reason;
  const ros::WallTime now = ros::WallTime::now();
  last_view_at_ = Moment::now();
  // Not compared with the last text: most hold a stamp and always differ.
  if (!logged_at_.isZero() && (now - logged_at_).toSec() < kLogAgain) return;
  logged_at_ = now;
  ROS_WARN("a view is not used: %s", reason.c_str());
}

void EyeHandDiagnostics::viewLeftOut() {
  std::lock_guard<std::mutex> lock(mutex_);
  ++left_out_;
  last_view_at_ = Moment::now();
}

void EyeHandDiagnostics::views(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const EyeHandState state = state_();
  std::lock_guard<std::mutex> lock(mutex_);
  if (state.objects_publishers == 0)
    status.summary(DiagnosticStatus::WARN, "no view: nobody publishes " + state.objects_topic +
                                               " (start the recognizer, or remap the topic)");
  else if (last_view_at_.since() > kSilence && !state.on_request)
    status.summary(DiagnosticStatus::WARN,
                   "no view: " + state.objects_topic + " has a publisher but sends nothing");
  else if (!problem_.empty())
    status.summary(DiagnosticStatus::ERROR, "the last view was not used: " + problem_);
  else
    status.summary(DiagnosticStatus::OK, state.known);

  status.add("objects topic", state.objects_topic);
  status.add("camera_info topic", state.info_topic);
  status.add("camera_info publishers", state.info_publishers);
  status.add("views used", used_);
  status.add("views refused", refused_);
  status.add("views from before a forget", left_out_);
  status.add("last view", outcomes_);
  status.add("known", state.known);
  status.add("seconds for all grasps", state.grasp_seconds);
}

void EyeHandDiagnostics::arm(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const EyeHandState state = state_();
  if (state.arm_problem.empty())
    status.summary(DiagnosticStatus::OK, "joint states arrive");
  else
    status.summary(DiagnosticStatus::WARN, state.arm_problem);
}

}  // namespace monocular_eye_hand
