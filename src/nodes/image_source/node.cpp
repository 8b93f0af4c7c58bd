#include "nodes/image_source/node.h"

#include <cv_bridge/cv_bridge.h>
#include <fmt/format.h>
#include <sensor_msgs/image_encodings.h>

#include <filesystem>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/file_path.h"
#include "nodes/common/camera_info.h"
#include "nodes/common/names.h"

namespace monocular_eye_hand {
namespace {

namespace enc = sensor_msgs::image_encodings;

std::string size(int width, int height) { return fmt::format("{}x{}", width, height); }

const char* encodingOf(const cv::Mat& image) {
  if (image.channels() == 3) return image.depth() == CV_16U ? enc::BGR16.c_str() : enc::BGR8.c_str();
  return image.depth() == CV_16U ? enc::MONO16.c_str() : enc::MONO8.c_str();
}

CameraFile readCalibration(const std::string& file) {
  try {
    CameraFile read = readCameraFile(file);
    ROS_INFO("camera_info: %s (%s)", file.c_str(), read.kind.c_str());
    for (const std::string& warning : read.warnings)
      ROS_WARN("camera_info: %s: %s", file.c_str(), warning.c_str());
    return read;
  } catch (const BadInput& e) {
    throw BadInput(std::string("camera_info: ") + e.what());
  }
}

}  // namespace

ImageSourceNode::ImageSourceNode(const ImageSourceParameters& parameters)
    : parameters_(parameters), sequence_(openImageSequence(parameters.source, parameters.colour)) {
  loadCalibration();
  const image_transport::SubscriberStatusCallback none;
  publisher_ = image_transport::ImageTransport(node_).advertiseCamera(
      names::kImageRaw, 10,
      [this](const image_transport::SingleSubscriberPublisher&) { image_wanted_ = true; }, none,
      [this](const ros::SingleSubscriberPublisher&) { info_wanted_ = true; });
}

void ImageSourceNode::loadCalibration() {
  if (parameters_.camera_info.empty()) {
    ROS_WARN("camera_info is not set: an uncalibrated camera is published");
    // A file that is not there: the manager would otherwise take one from an earlier set_camera_info.
    calibration_ = std::make_unique<camera_info_manager::CameraInfoManager>(node_, "camera");
    return;
  }
  const std::string file = resolvedPath(parameters_.camera_info);
  if (!std::filesystem::is_regular_file(file))
    throw BadInput(
        fmt::format("camera_info: there is no file {} (a calibration of these images is expected)", file));
  const CameraFile read = readCalibration(file);
  // set_camera_info writes a YAML of camera_calibration: it goes over no other kind of file.
  const bool may_be_overwritten = read.kind == kRosYamlKind;
  const std::string url = may_be_overwritten ? "file://" + std::filesystem::absolute(file).string() : "";
  calibration_ = std::make_unique<camera_info_manager::CameraInfoManager>(
      node_, read.name.empty() ? "camera" : read.name, url);
  calibration_->setCameraInfo(toMessage(calibrationOf(read)));
}

void ImageSourceNode::waitForSubscriber() const {
  if (!parameters_.wait_for_subscriber) return;
  ROS_INFO("waiting for a subscriber of %s", publisher_.getTopic().c_str());
  while (ros::ok() && !image_wanted_) ros::WallDuration(0.01).sleep();
  // Who takes images usually takes camera_info: its connection may be on the way.
  for (int i = 0; i < 100 && ros::ok() && !info_wanted_; ++i) ros::WallDuration(0.01).sleep();
}

void ImageSourceNode::publish(const SequenceImage& image) {
  sensor_msgs::CameraInfo info = calibration_->getCameraInfo();
  const int width = image.image.cols, height = image.image.rows;
  if (info.width == 0 && info.height == 0) {
    info.width = uint32_t(width);
    info.height = uint32_t(height);
  } else if (int(info.width) != width || int(info.height) != height) {
    throw BadInput(fmt::format(
        "{} is {} but the calibration {} is for {}: give the calibration of these images", image.name,
        size(width, height), parameters_.camera_info, size(int(info.width), int(info.height))));
  }
  std_msgs::Header header;
  header.frame_id = parameters_.frame_id;
  header.stamp = info.header.stamp = ros::Time::now();
  info.header.frame_id = parameters_.frame_id;
  publisher_.publish(*cv_bridge::CvImage(header, encodingOf(image.image), image.image).toImageMsg(), info);
}

void ImageSourceNode::run() {
  const double own = sequence_->rate();
  ros::WallRate rate(parameters_.rate > 0 ? parameters_.rate : own > 0 ? own : 10.0);
  SequenceImage image;
  if (!sequence_->next(&image)) throw BadInput("source: " + parameters_.source + " holds no image");
  ROS_INFO("%s", sequence_->describe().c_str());
  waitForSubscriber();

  int published = 0;
  while (ros::ok()) {
    publish(image);
    ++published;
    rate.sleep();
    if (sequence_->next(&image)) continue;
    if (!parameters_.loop) break;
    sequence_->rewind();
    if (!sequence_->next(&image))
      throw BadInput("source: " + parameters_.source + " cannot be read a second time");
  }
  ROS_INFO("published %d images", published);
}

}  // namespace monocular_eye_hand
