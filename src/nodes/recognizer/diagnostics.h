#pragma once
#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

#include "nodes/common/moment.h"
#include "nodes/recognizer/camera_input.h"

namespace monocular_eye_hand {

/// /diagnostics of the node recognizer: "camera" (does it deliver, is its calibration usable, what is wrong)
/// and "recognition" (images, objects, time per image, the last reason). Problems of the camera are logged as
/// well, when they change and every ten seconds. Runs on wall time: a paused clock hides nothing.
class Diagnostics {
 public:
  /// `input` must outlive it. `wants_images`: whether their silence is one.
  Diagnostics(const CameraInput& input, double period, std::function<bool()> wants_images);
  /// Image and calibration are usable.
  void cameraGood(const std::string& description);
  /// They are not: what is wrong, in a sentence.
  void cameraBad(const std::string& problem);
  /// What is odd about the images' frame; "" when nothing is. The images are used all the same.
  void frameOdd(const std::string& problem);
  void worked(double seconds, size_t objects, const std::string& reason, bool truncated);
  /// Starts the timer.
  void start();

 private:
  void update();
  void camera(diagnostic_updater::DiagnosticStatusWrapper& status);
  void recognition(diagnostic_updater::DiagnosticStatusWrapper& status);
  void logProblem(const std::string& problem);  // with mutex_ held
  std::string missingInput() const;             // why no image comes
  bool inputMissing() const;                    // with mutex_ held
  std::string oddInput() const;                 // about stamps or frame; with mutex_ held

  const CameraInput& input_;
  double period_;
  const std::function<bool()> wants_images_;
  std::mutex mutex_;
  std::string description_, problem_, frame_problem_;
  std::string logged_;
  ros::WallTime logged_at_, odd_logged_at_;
  Moment last_image_at_;
  uint64_t received_ = 0;
  double rate_ = 0;  // images per second over the last period
  ros::WallTime rate_at_;
  uint64_t worked_ = 0;
  double last_seconds_ = 0, longest_seconds_ = 0, total_seconds_ = 0;
  size_t objects_ = 0;
  std::string reason_;
  bool truncated_ = false;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace monocular_eye_hand
