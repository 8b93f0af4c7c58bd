#pragma once
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "monocular_eye_hand/parameters/recognizer.h"
#include "monocular_eye_hand/recognition/recognizer.h"
#include "monocular_eye_hand/tracking/object_tracker.h"
#include "nodes/recognizer/camera_input.h"
#include "nodes/recognizer/diagnostics.h"
#include "nodes/recognizer/outputs.h"
#include "nodes/recognizer/requests.h"
#include "nodes/recognizer/support_input.h"

namespace monocular_eye_hand {

/// The node recognizer: images in, recognised objects out. One worker thread takes the newest image whenever
/// it is free (images that come while it is busy are skipped); service calls wait beside it.
class RecognizerNode {
 public:
  /// `recognizer` must outlive it.
  RecognizerNode(const Recognizer& recognizer, const RecognizerParameters& parameters);
  ~RecognizerNode();

 private:
  void work();
  void workOn(const CameraFrame& frame, const std::vector<PendingRequestPtr>& requests, bool publish_all);
  /// Tells once what looks wrong about the camera, and which objects it cannot see.
  void warnAboutCamera(const Camera& camera);
  void onFixedFrames(const tf2_msgs::TFMessage& message);
  /// An optical frame hangs in the frame of the images, which is then the camera's body. "": none that is
  /// known.
  std::string frameProblem(const std::string& frame) const;
  /// Header, grey image and camera of a frame; throws BadImage or BadCameraInfo.
  WorkedImage prepare(const CameraFrame& frame) const;
  ImageKind kind() const { return parameters_.rectified ? ImageKind::kRectified : ImageKind::kRaw; }
  /// Searches, numbers what was found, publishes, and returns the service's reply.
  Recognize::Response search(WorkedImage image, const std::string& only, bool publish);
  bool onRecognize(Recognize::Request& request, Recognize::Response& response);
  std::string noImageText() const;
  bool fromBeforeRestart(const WorkedImage& image) const;

  const Recognizer& recognizer_;
  const RecognizerParameters parameters_;
  ObjectTracker tracker_;  // of worker_ alone
  Outputs outputs_;
  CameraInput input_;
  tf2::BufferCore fixed_frames_;
  Diagnostics diagnostics_;
  Requests requests_;
  SupportInput support_;
  uint64_t support_restarts_ = 0;  // CameraFrame::restarts of the image before
  ros::CallbackQueue service_queue_;
  ros::NodeHandle node_, service_node_;
  ros::Subscriber fixed_frames_subscriber_;
  ros::ServiceServer service_;
  ros::AsyncSpinner service_spinner_;
  std::atomic<bool> stop_{false}, camera_checked_{false};
  std::thread worker_;
};

}  // namespace monocular_eye_hand
