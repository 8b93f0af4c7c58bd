#pragma once
#include <image_transport/image_transport.h>
#include <monocular_eye_hand/RecognizedObjectArray.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/model/model_base.h"
#include "monocular_eye_hand/recognition/object_estimate.h"
#include "nodes/instances.h"
#include "nodes/markers.h"
#include "nodes/recognizer_parameters.h"

namespace monocular_eye_hand {

/// What one image was worked on with, and what came out.
struct WorkedImage {
  std_msgs::Header header;  ///< stamp of the image, optical frame
  cv::Mat grey;
  Camera camera;
  std::string only;  ///< the one name looked for, "": all
  RecognitionResult result;
  double seconds = 0;
  uint64_t restarts = 0;  ///< CameraFrame::restarts
  ros::Time clock;        ///< CameraFrame::clock
};

/// ~objects, ~markers, ~overlay and the objects' tf frames.
class Outputs {
 public:
  /// `models` must outlive it.
  Outputs(const ModelBase& models, const RecognizerParameters& parameters);
  /// Someone listens to ~objects, ~markers or ~overlay (of tf nobody can tell).
  bool wanted() const;
  /// Numbers the instances and returns the objects as messages, unpublished.
  std::vector<RecognizedObject> number(const WorkedImage& image);
  /// Numbers the instances, publishes everything, and returns the objects as published.
  std::vector<RecognizedObject> publish(const WorkedImage& image);
  /// Objects seen lately, for the next image at `stamp` [s].
  std::vector<ObjectEstimate> previous(double stamp) const { return instances_.previous(stamp); }

 private:
  void publishFrames(const std_msgs::Header& header, const std::vector<ObjectEstimate>& objects,
                     const std::vector<int>& numbers);
  void publishOverlay(const WorkedImage& image, const std::vector<int>& numbers);

  const ModelBase& models_;
  std::string frame_prefix_;
  Instances instances_;
  MarkerBuilder marker_builder_;
  ros::NodeHandle private_node_;
  image_transport::ImageTransport transport_;
  ros::Publisher objects_, markers_;
  image_transport::Publisher overlay_;
  tf2_ros::TransformBroadcaster broadcaster_;
};

}  // namespace monocular_eye_hand
