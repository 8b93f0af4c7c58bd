#include "nodes/recognizer/camera_input.h"

#include <algorithm>
#include <chrono>

#include "nodes/common/names.h"
#include "nodes/common/node_on.h"
#include "nodes/common/stamps.h"

namespace monocular_eye_hand {
namespace {

constexpr size_t kInfosKept = 30;
// Image and camera_info of one moment travel on two connections: the second one may be this late.
constexpr std::chrono::milliseconds kInfoDelay(200);

}  // namespace

CameraInput::CameraInput(ImageKind kind, const std::string& transport)
    : node_(nodeOn(&queue_)), transport_(node_), spinner_(1, &queue_) {
  // camera_info first: whoever sees our image subscription can count on the other one.
  info_ = node_.subscribe(names::kCameraInfo, kInfosKept, &CameraInput::onInfo, this);
  const char* topic = kind == ImageKind::kRaw ? names::kImageRaw : names::kImageRect;
  image_ =
      transport_.subscribe(topic, 1, &CameraInput::onImage, this,
                           image_transport::TransportHints(transport, ros::TransportHints().tcpNoDelay()));
  spinner_.start();
}

CameraInput::~CameraInput() {
  spinner_.stop();
  image_.shutdown();
  info_.shutdown();
}

bool CameraInput::next(double timeout, CameraFrame* frame) {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto fresh = [&] { return newest_.number > handed_out_; };
  if (!changed_.wait_for(lock, std::chrono::duration<double>(timeout), fresh)) return false;
  CameraFrame result = newest_;
  handed_out_ = result.number;
  const ros::Time stamp = result.image->header.stamp;
  const bool wait = infos_.empty() || stamps_match_;
  const auto arrived = [&] { return infoAt(stamp) != nullptr; };
  if (wait) stamps_match_ = changed_.wait_for(lock, kInfoDelay, arrived) || infos_.empty();
  if (arrived()) {
    result.info = infoAt(stamp);
    stamps_match_ = true;
  } else if (!infos_.empty()) {
    result.info = infos_.back();
  }
  *frame = result;
  return true;
}

uint64_t CameraInput::received() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return newest_.number;
}

uint64_t CameraInput::restarts() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return stamps_.restarts();
}

std::string CameraInput::stampProblem() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return stamps_.problem();
}

bool CameraInput::stampsInFuture() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return stamps_.inFuture();
}

void CameraInput::onImage(const sensor_msgs::ImageConstPtr& image) {
  std::lock_guard<std::mutex> lock(mutex_);
  stamps_.add(nanoseconds(image->header.stamp), nanoseconds(ros::Time::now()));
  newest_.image = image;
  newest_.restarts = stamps_.restarts();
  newest_.clock = ros::Time::now();
  ++newest_.number;
  changed_.notify_all();
}

void CameraInput::onInfo(const sensor_msgs::CameraInfoConstPtr& info) {
  std::lock_guard<std::mutex> lock(mutex_);
  infos_.push_back(info);
  if (infos_.size() > kInfosKept) infos_.pop_front();
  changed_.notify_all();
}

sensor_msgs::CameraInfoConstPtr CameraInput::infoAt(const ros::Time& stamp) const {
  for (auto it = infos_.rbegin(); it != infos_.rend(); ++it)
    if ((*it)->header.stamp == stamp) return *it;
  return nullptr;
}

}  // namespace monocular_eye_hand
