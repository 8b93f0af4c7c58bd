#pragma once
#include <image_transport/image_transport.h>
#include <monocular_eye_hand/RecognizedObjectArray.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/parameters/recognizer.h"
#include "monocular_eye_hand/recognition/object_estimate.h"
#include "nodes/common/markers.h"

namespace monocular_eye_hand {

/// What one image was worked on with, and what came out.
struct WorkedImage {
  std_msgs::Header header;  ///< stamp of the image, optical frame
  cv::Mat grey;
  Camera camera;
  std::optional<SupportPlane> support;  ///< what the parts stand on, where that is known
  std::string only;                     ///< the one name looked for, "": all
  RecognitionResult result;
  double seconds = 0;
  uint64_t restarts = 0;  ///< CameraFrame::restarts
  ros::Time clock;        ///< CameraFrame::clock
};

/// ~objects, ~markers, ~view, ~overlay and the objects' tf frames.
class Outputs {
 public:
  /// `models` must outlive it.
  Outputs(const ModelBase& models, const RecognizerParameters& parameters);
  /// Someone listens to ~objects, ~markers or ~overlay (of tf nobody can tell).
  bool wanted() const;
  /// The image's objects as messages, unpublished. `numbers`: of each, among those of its name.
  std::vector<RecognizedObject> messages(const WorkedImage& image, const std::vector<int>& numbers) const;
  /// Publishes everything and returns what was found, without the doubtful candidates that ~objects may tell.
  std::vector<RecognizedObject> publish(const WorkedImage& image, const std::vector<int>& numbers);
  /// Shows where the camera looks.
  void showView(const std_msgs::Header& header, const Camera& camera);

 private:
  /// Of markers, as long as images take now [s]; 0: for ever.
  double lifetime() const;
  void publishFrames(const std_msgs::Header& header, const std::vector<ObjectEstimate>& objects,
                     const std::vector<int>& numbers);
  void publishOverlay(const WorkedImage& image, const std::vector<int>& numbers);

  const ModelBase& models_;
  std::string frame_prefix_;
  double doubtful_;  // rejected candidates are published from this probability on
  double marker_lifetime_;
  double last_seconds_ = 0;  // of the last image worked on
  MarkerBuilder marker_builder_;
  ros::NodeHandle private_node_;
  image_transport::ImageTransport transport_;
  ros::Publisher objects_, markers_, view_;
  image_transport::Publisher overlay_;
  tf2_ros::TransformBroadcaster broadcaster_;
};

}  // namespace monocular_eye_hand
