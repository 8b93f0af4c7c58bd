#include "nodes/recognizer/outputs.h"

#include <cv_bridge/cv_bridge.h>
#include <fmt/format.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>

#include "monocular_eye_hand/report/result_drawing.h"
#include "nodes/common/conversion.h"
#include "nodes/common/names.h"

namespace monocular_eye_hand {
namespace {

constexpr double kViewDepth = 0.15;            // so far the pyramid of the camera's view is drawn [m]
constexpr PictureSize kOverlaySize{640, 800};  // a panel of rviz shows it about so wide
constexpr int kNoNumber = -1;                  // of what is not tracked
constexpr double kImagesUnshown = 3.0;         // markers outlive so many images of the same work

}  // namespace

Outputs::Outputs(const ModelBase& models, const RecognizerParameters& parameters)
    : models_(models),
      frame_prefix_(parameters.frame_prefix),
      doubtful_(parameters.doubtful),
      marker_lifetime_(parameters.marker_lifetime),
      marker_builder_(models, {parameters.marker_triangles, parameters.label_height}),
      private_node_("~"),
      transport_(private_node_) {
  objects_ = private_node_.advertise<RecognizedObjectArray>(names::kObjects, 10);
  markers_ = private_node_.advertise<visualization_msgs::MarkerArray>(names::kMarkers, 10);
  view_ = private_node_.advertise<visualization_msgs::Marker>(names::kView, 1);
  overlay_ = transport_.advertise(names::kOverlay, 1);
}

bool Outputs::wanted() const {
  return objects_.getNumSubscribers() > 0 || markers_.getNumSubscribers() > 0 ||
         overlay_.getNumSubscribers() > 0;
}

std::vector<RecognizedObject> Outputs::messages(const WorkedImage& image,
                                                const std::vector<int>& numbers) const {
  const std::vector<ObjectEstimate>& objects = image.result.objects;
  std::vector<RecognizedObject> messages;
  for (size_t i = 0; i < objects.size(); ++i)
    messages.push_back(toMessage(image.header, objects[i], numbers[i], models_));
  return messages;
}

std::vector<RecognizedObject> Outputs::publish(const WorkedImage& image, const std::vector<int>& numbers) {
  const std::vector<ObjectEstimate>& objects = image.result.objects;
  RecognizedObjectArray array;
  array.header = image.header;
  const std::vector<RecognizedObject> found = messages(image, numbers);
  array.objects = found;
  for (const ObjectEstimate& candidate : image.result.rejected)
    if (candidate.probability >= doubtful_)
      array.objects.push_back(toMessage(image.header, candidate, kNoNumber, models_));
  if (objects.empty()) array.reason = image.result.reason;
  array.truncated = image.result.truncated;
  array.budget_spent = image.result.budget_spent;
  array.seconds = image.seconds;

  publishFrames(image.header, objects, numbers);  // before the message that names them
  objects_.publish(array);
  last_seconds_ = image.seconds;
  if (markers_.getNumSubscribers() > 0)
    markers_.publish(marker_builder_.build(image.header, objects, numbers, lifetime(), image.only));
  if (overlay_.getNumSubscribers() > 0) publishOverlay(image, numbers);
  return found;
}

void Outputs::showView(const std_msgs::Header& header, const Camera& camera) {
  if (view_.getNumSubscribers() == 0) return;
  visualization_msgs::Marker marker = viewMarker(header.frame_id, camera, kViewDepth);
  marker.lifetime = ros::Duration(lifetime());
  view_.publish(marker);
}

double Outputs::lifetime() const {
  if (marker_lifetime_ == 0) return 0;
  return std::max(marker_lifetime_, kImagesUnshown * last_seconds_);
}

void Outputs::publishFrames(const std_msgs::Header& header, const std::vector<ObjectEstimate>& objects,
                            const std::vector<int>& numbers) {
  std::vector<geometry_msgs::TransformStamped> transforms;
  for (size_t i = 0; i < objects.size(); ++i)
    transforms.push_back(toTransform(header, objectFrame(frame_prefix_, objects[i].name, numbers[i]),
                                     objects[i].camera_from_object));
  if (!transforms.empty()) broadcaster_.sendTransform(transforms);
}

void Outputs::publishOverlay(const WorkedImage& image, const std::vector<int>& numbers) {
  RecognitionResult labelled = image.result;
  for (size_t i = 0; i < numbers.size(); ++i) labelled.objects[i].name += fmt::format("_{}", numbers[i]);
  const cv::Mat picture = drawResult(image.grey, image.camera, models_, labelled, false, kOverlaySize);
  overlay_.publish(
      cv_bridge::CvImage(image.header, sensor_msgs::image_encodings::BGR8, picture).toImageMsg());
}

}  // namespace monocular_eye_hand
