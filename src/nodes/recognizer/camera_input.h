#pragma once
#include <image_transport/image_transport.h>
#include <image_transport/subscriber.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>

#include "monocular_eye_hand/io/image_calibration.h"
#include "monocular_eye_hand/io/stamp_watch.h"

namespace monocular_eye_hand {

/// An image with the calibration it came with.
struct CameraFrame {
  uint64_t number = 0;    ///< counts the images received, from 1
  uint64_t restarts = 0;  ///< of the stamps before it
  ros::Time clock;        ///< when it came
  sensor_msgs::ImageConstPtr image;
  sensor_msgs::CameraInfoConstPtr info;  ///< null: none was ever received
};

/// Subscribes to image_raw or image_rect and to camera_info and keeps the newest image only. The calibration
/// is the camera_info with the image's stamp, waited for briefly; a camera whose stamps differ gets its
/// latest one.
class CameraInput {
 public:
  CameraInput(ImageKind kind, const std::string& transport);
  ~CameraInput();
  CameraInput(const CameraInput&) = delete;
  CameraInput& operator=(const CameraInput&) = delete;

  /// The newest image not handed out yet; false when none came within `timeout` [s, wall clock].
  bool next(double timeout, CameraFrame* frame);
  /// Images received so far: the number of the newest.
  uint64_t received() const;
  /// Of the stamps so far; a frame with fewer is from before time went back.
  uint64_t restarts() const;
  /// What is odd about the stamps; "" while nothing is.
  std::string stampProblem() const;
  bool stampsInFuture() const;
  std::string imageTopic() const { return image_.getTopic(); }
  std::string infoTopic() const { return info_.getTopic(); }
  uint32_t imagePublishers() const { return image_.getNumPublishers(); }
  uint32_t infoPublishers() const { return info_.getNumPublishers(); }

 private:
  void onImage(const sensor_msgs::ImageConstPtr& image);
  void onInfo(const sensor_msgs::CameraInfoConstPtr& info);
  sensor_msgs::CameraInfoConstPtr infoAt(const ros::Time& stamp) const;  // null when none has this stamp

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  CameraFrame newest_;
  StampWatch stamps_;
  uint64_t handed_out_ = 0;
  std::deque<sensor_msgs::CameraInfoConstPtr> infos_;  // newest last
  bool stamps_match_ = true;                           // as far as we know

  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  image_transport::ImageTransport transport_;
  ros::Subscriber info_;
  image_transport::Subscriber image_;
  ros::AsyncSpinner spinner_;
};

}  // namespace monocular_eye_hand
