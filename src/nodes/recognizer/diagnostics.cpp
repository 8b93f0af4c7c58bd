#include "nodes/recognizer/diagnostics.h"

#include <algorithm>

namespace monocular_eye_hand {
namespace {

using diagnostic_msgs::DiagnosticStatus;
constexpr double kSilence = 5.0;    // without an image for so long the camera is reported [s]
constexpr double kLogAgain = 10.0;  // the same problem is logged again [s]

}  // namespace

Diagnostics::Diagnostics(const CameraInput& input, double period, std::function<bool()> wants_images)
    : input_(input), period_(period), wants_images_(std::move(wants_images)) {
  last_image_at_ = Moment::now();
  rate_at_ = ros::WallTime::now();
  updater_.setHardwareID("none");
  updater_.add("camera", this, &Diagnostics::camera);
  updater_.add("recognition", this, &Diagnostics::recognition);
}

void Diagnostics::start() {
  timer_ = ros::NodeHandle().createWallTimer(ros::WallDuration(period_),
                                             [this](const ros::WallTimerEvent&) { update(); });
}

void Diagnostics::cameraGood(const std::string& description) {
  std::lock_guard<std::mutex> lock(mutex_);
  description_ = description;
  if (!problem_.empty()) ROS_INFO("camera: usable again (%s)", description.c_str());
  problem_.clear();
  logged_.clear();
}

void Diagnostics::cameraBad(const std::string& problem) {
  std::lock_guard<std::mutex> lock(mutex_);
  problem_ = problem;
  logProblem(problem);
}

void Diagnostics::frameOdd(const std::string& problem) {
  std::lock_guard<std::mutex> lock(mutex_);
  frame_problem_ = problem;
}

void Diagnostics::worked(double seconds, size_t objects, const std::string& reason, bool truncated) {
  std::lock_guard<std::mutex> lock(mutex_);
  ++worked_;
  last_seconds_ = seconds;
  longest_seconds_ = std::max(longest_seconds_, seconds);
  total_seconds_ += seconds;
  objects_ = objects;
  reason_ = reason;
  truncated_ = truncated;
}

void Diagnostics::logProblem(const std::string& problem) {
  const ros::WallTime now = ros::WallTime::now();
  if (problem == logged_ && (now - logged_at_).toSec() < kLogAgain) return;
  logged_ = problem;
  logged_at_ = now;
  ROS_WARN("camera: %s", problem.c_str());
}

std::string Diagnostics::missingInput() const {
  const std::string topic = input_.imageTopic();
  if (input_.imagePublishers() == 0)
    return "no image: nobody publishes " + topic + " (start the camera, or remap the topic)";
  return "no image: " + topic + " has a publisher but sends nothing";
}

bool Diagnostics::inputMissing() const { return last_image_at_.since() > kSilence; }

std::string Diagnostics::oddInput() const {
  const std::string stamps = input_.stampProblem();
  return stamps.empty() ? frame_problem_ : stamps;
}

void Diagnostics::update() {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    const ros::WallTime now = ros::WallTime::now();
    const uint64_t received = input_.received();
    const double elapsed = (now - rate_at_).toSec();
    if (elapsed > 0) rate_ = double(received - received_) / elapsed;
    if (received != received_ || !wants_images_()) last_image_at_ = Moment::now();
    received_ = received;
    rate_at_ = now;
    if (inputMissing()) logProblem(missingInput());
    const std::string problem = oddInput();
    if (!problem.empty() && (now - odd_logged_at_).toSec() > kLogAgain) {
      ROS_WARN("camera: %s", problem.c_str());
      odd_logged_at_ = now;
    }
  }
  updater_.force_update();
}

void Diagnostics::camera(diagnostic_updater::DiagnosticStatusWrapper& status) {
  std::lock_guard<std::mutex> lock(mutex_);
  const std::string odd_problem = oddInput();
  if (inputMissing() || (received_ == 0 && wants_images_()))
    status.summary(DiagnosticStatus::WARN, missingInput());
  else if (!problem_.empty())
    status.summary(DiagnosticStatus::ERROR, problem_);
  else if (!odd_problem.empty())
    status.summary(DiagnosticStatus::WARN, odd_problem);
  else if (received_ == 0)
    status.summary(DiagnosticStatus::OK, "no image yet, and nobody asked for one");
  else
    status.summary(DiagnosticStatus::OK, description_.empty() ? "images arrive" : description_);

  status.add("image topic", input_.imageTopic());
  status.add("camera_info topic", input_.infoTopic());
  status.add("image publishers", input_.imagePublishers());
  status.add("camera_info publishers", input_.infoPublishers());
  status.add("images received", received_);
  status.add("images per second", rate_);
}

void Diagnostics::recognition(diagnostic_updater::DiagnosticStatusWrapper& status) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (worked_ == 0)
    status.summary(DiagnosticStatus::OK, "no image worked on yet");
  else if (truncated_)
    status.summary(DiagnosticStatus::WARN, "the wall-clock limit ended the search early");
  else if (objects_ == 0)
    status.summary(DiagnosticStatus::OK, "nothing found: " + reason_);
  else
    status.summaryf(DiagnosticStatus::OK, "%zu object%s", objects_, objects_ == 1 ? "" : "s");
  status.add("images worked on", worked_);
  status.add("objects in the last image", objects_);
  status.add("seconds for the last image", last_seconds_);
  status.add("seconds per image, mean", worked_ ? total_seconds_ / double(worked_) : 0.0);
  status.add("seconds per image, longest", longest_seconds_);
  status.add("reason", reason_);
}

}  // namespace monocular_eye_hand
