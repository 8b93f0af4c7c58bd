#pragma once
#include <camera_info_manager/camera_info_manager.h>
#include <image_transport/image_transport.h>
#include <ros/ros.h>

#include <atomic>
#include <memory>
#include <string>

#include "monocular_eye_hand/video/image_sequence.h"
#include "nodes/image_source/parameters.h"

namespace monocular_eye_hand {

/// The node image_source: a camera made of files. Publishes image_raw and camera_info at a rate and offers
/// set_camera_info. Throws BadInput when source or calibration cannot be used.
class ImageSourceNode {
 public:
  explicit ImageSourceNode(const ImageSourceParameters& parameters);
  /// Publishes until the sequence ends (loop: false) or the node goes down.
  void run();

 private:
  void loadCalibration();
  void waitForSubscriber() const;
  void publish(const SequenceImage& image);

  const ImageSourceParameters parameters_;
  std::unique_ptr<ImageSequence> sequence_;
  ros::NodeHandle node_;
  std::unique_ptr<camera_info_manager::CameraInfoManager> calibration_;
  std::atomic<bool> image_wanted_{false}, info_wanted_{false};  // had a subscriber
  image_transport::CameraPublisher publisher_;
};

}  // namespace monocular_eye_hand
