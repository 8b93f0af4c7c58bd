#include "nodes/eye_hand/diagnostics.h"

#include <fmt/format.h>

namespace monocular_eye_hand {
namespace {

using diagnostic_msgs::DiagnosticStatus;
constexpr double kSilence =
    10.0;  // without a view for so long the recogniser is reported [s], unless it waits to be asked
constexpr double kLogAgain = 10.0;  // the same problem is logged again [s]

std::string knownText(const MapState& known) {
  std::string text;
  for (const MappedObject& object : known.objects)
    text += fmt::format("{}{} {}", text.empty() ? "knows " : ", ", object.name, object.number);
  return text.empty() ? "knows nothing yet" : text;
}

}  // namespace

EyeHandDiagnostics::EyeHandDiagnostics(double period, const EyeHandParts& parts)
    : period_(period), parts_(parts) {
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
  const std::string topic = parts_.views.getTopic(), known = knownText(parts_.map.known().map);
  bool on_request = false;
  ros::param::getCached(ros::names::parentNamespace(topic) + "/on_request", on_request);

  std::lock_guard<std::mutex> lock(mutex_);
  if (parts_.views.getNumPublishers() == 0)
    status.summaryf(DiagnosticStatus::WARN,
                    "no view: nobody publishes %s (start the recognizer, or remap the topic)", topic.c_str());
  else if (last_view_at_.since() > kSilence && !on_request)
    status.summaryf(DiagnosticStatus::WARN, "no view: %s has a publisher but sends nothing", topic.c_str());
  else if (!problem_.empty())
    status.summary(DiagnosticStatus::ERROR, "the last view was not used: " + problem_);
  else
    status.summary(DiagnosticStatus::OK, known);

  status.add("objects topic", topic);
  status.add("camera_info topic", parts_.infos.getTopic());
  status.add("camera_info publishers", parts_.infos.getNumPublishers());
  status.add("views used", used_);
  status.add("views refused", refused_);
  status.add("views from before a forget", left_out_);
  status.add("last view", outcomes_);
  status.add("known", known);
  status.add("seconds for all grasps", parts_.outputs.lastGraspSeconds());
}

void EyeHandDiagnostics::arm(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::string problem = parts_.hand.now().problem;
  if (problem.empty())
    status.summary(DiagnosticStatus::OK, "joint states arrive");
  else
    status.summary(DiagnosticStatus::WARN, problem);
}

}  // namespace monocular_eye_hand
