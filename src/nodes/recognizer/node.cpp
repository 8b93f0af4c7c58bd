#include "nodes/recognizer/node.h"

#include <fmt/format.h>

#include <chrono>

#include "monocular_eye_hand/io/camera_file.h"
#include "monocular_eye_hand/io/grey_pixels.h"
#include "monocular_eye_hand/recognition/size_check.h"
#include "nodes/common/camera_info.h"
#include "nodes/common/conversion.h"
#include "nodes/common/names.h"
#include "nodes/common/node_on.h"
#include "nodes/common/optical_frame.h"
#include "nodes/common/stamps.h"

namespace monocular_eye_hand {
namespace {

constexpr int kServiceThreads = 32;  // calls that wait at the same time; more wait in line

Recognize::Response reply(uint8_t status, const std::string& text) {
  Recognize::Response response;
  response.status = status;
  response.text = text;
  return response;
}

/// The message's bytes, not a copy.
RawImage rawImage(const sensor_msgs::Image& message) {
  return {message.encoding,           int(message.width),  int(message.height), message.step,
          bool(message.is_bigendian), message.data.data(), message.data.size()};
}

std::string foundText(const std::vector<RecognizedObject>& objects) {
  std::string text;
  for (const RecognizedObject& object : objects)
    text += fmt::format("{}{}_{} (probability {:.2f}{})", text.empty() ? "found " : ", ", object.name,
                        object.instance, object.probability,
                        object.decision == RecognizedObject::AMBIGUOUS ? ", ambiguous" : "");
  return text;
}

std::string notFoundText(const std::string& only, const RecognitionResult& result) {
  return (only.empty() ? "no known object" : "no " + only) + " in the image: " + result.reason;
}

}  // namespace

RecognizerNode::RecognizerNode(const Recognizer& recognizer, const RecognizerParameters& parameters)
    : recognizer_(recognizer),
      parameters_(parameters),
      tracker_(recognizer.models(), parameters.instances),
      outputs_(recognizer.models(), parameters),
      input_(kind(), parameters.image_transport),
      diagnostics_(input_, parameters.diagnostic_period,
                   [this] { return !parameters_.on_request || !requests_.empty(); }),
      support_(parameters.support),
      service_node_(nodeOn(&service_queue_, "~")),
      service_spinner_(kServiceThreads, &service_queue_) {
  fixed_frames_subscriber_ = node_.subscribe("/tf_static", 100, &RecognizerNode::onFixedFrames, this);
  worker_ = std::thread(&RecognizerNode::work, this);
  diagnostics_.start();
  service_ = service_node_.advertiseService(names::kRecognize, &RecognizerNode::onRecognize, this);
  service_spinner_.start();
}

RecognizerNode::~RecognizerNode() {
  stop_ = true;
  requests_.close();
  service_.shutdown();
  service_spinner_.stop();
  worker_.join();
}

void RecognizerNode::work() {
  CameraFrame frame;
  while (!stop_ && ros::ok()) {
    if (!input_.next(0.1, &frame)) continue;
    const std::vector<PendingRequestPtr> requests = requests_.take(frame.number);
    const bool publish_all = !parameters_.on_request && (parameters_.continuous || outputs_.wanted());
    if (publish_all || !requests.empty()) workOn(frame, requests, publish_all);
  }
}

void RecognizerNode::workOn(const CameraFrame& frame, const std::vector<PendingRequestPtr>& requests,
                            bool publish_all) {
  const auto refuse = [&](uint8_t status, const std::string& text) {
    for (const PendingRequestPtr& request : requests) requests_.answer(request, reply(status, text));
  };

  try {
    WorkedImage image = prepare(frame);
    if (frame.restarts != support_restarts_) support_.restart();
    support_restarts_ = frame.restarts;
    image.support = support_.at(image.header);
    warnAboutCamera(image.camera);
    diagnostics_.frameOdd(frameProblem(image.header.frame_id));
    outputs_.showView(image.header, image.camera);
    diagnostics_.cameraGood(fmt::format("{}x{} {}", image.grey.cols, image.grey.rows, frame.image->encoding));

    // One object by name is looked for on its own: that search ends at the first good match. The search for
    // all serves whoever listens and every call for all; when it runs it alone is published.
    bool want_all = publish_all;
    for (const PendingRequestPtr& request : requests) want_all = want_all || request->name.empty();
    for (const PendingRequestPtr& request : requests)
      if (!request->name.empty()) requests_.answer(request, search(image, request->name, !want_all));
    if (!want_all) return;
    const Recognize::Response all = search(image, "", true);
    for (const PendingRequestPtr& request : requests)
      if (request->name.empty()) requests_.answer(request, all);
  } catch (const BadCameraInfo& e) {
    const std::string text = "bad camera_info on " + input_.infoTopic() + ": " + e.what();
    diagnostics_.cameraBad(text);
    refuse(Recognize::Response::BAD_CAMERA_INFO, text);
  } catch (const BadImage& e) {
    const std::string text = "bad image on " + input_.imageTopic() + ": " + e.what();
    diagnostics_.cameraBad(text);
    refuse(Recognize::Response::BAD_IMAGE, text);
  } catch (const std::exception& e) {
    ROS_ERROR("recognition failed: %s", e.what());
    refuse(Recognize::Response::FAILED, std::string("recognition failed: ") + e.what());
  }
}

void RecognizerNode::warnAboutCamera(const Camera& camera) {
  if (camera_checked_.exchange(true)) return;
  for (const std::string& warning : cameraWarnings(camera)) ROS_WARN("camera_info: %s", warning.c_str());
  for (const std::string& warning : sizeWarnings(recognizer_.models(), camera, recognizer_.options()))
    ROS_WARN("%s", warning.c_str());
}

void RecognizerNode::onFixedFrames(const tf2_msgs::TFMessage& message) {
  for (const geometry_msgs::TransformStamped& transform : message.transforms)
    fixed_frames_.setTransform(transform, "/tf_static", true);
}

std::string RecognizerNode::frameProblem(const std::string& frame) const {
  const std::string optical = opticalFrameIn(fixed_frames_, frame);
  if (optical.empty()) return "";
  return fmt::format(
      "the images' frame {} is the body of the camera (x forward), and the objects lie elsewhere in it; its "
      "optical "
      "frame is {}: set the parameter camera_frame to that",
      frame, optical);
}

WorkedImage RecognizerNode::prepare(const CameraFrame& frame) const {
  WorkedImage image;
  image.header = frame.image->header;
  image.header.frame_id = withoutSlash(image.header.frame_id);
  image.restarts = frame.restarts;
  image.clock = frame.clock;
  if (!parameters_.camera_frame.empty()) image.header.frame_id = withoutSlash(parameters_.camera_frame);
  if (image.header.frame_id.empty())
    throw BadImage(
        "header.frame_id is empty: set the frame in the camera's driver, or the parameter camera_frame");
  image.grey = greyPixels(rawImage(*frame.image));
  if (!frame.info)
    throw BadCameraInfo(
        fmt::format("none was received, {} publishers: calibrate the camera, and remap camera_info if it has "
                    "another name",
                    input_.infoPublishers()));
  image.camera = cameraOf(fromMessage(*frame.info), kind(), image.grey.cols, image.grey.rows);
  return image;
}

Recognize::Response RecognizerNode::search(WorkedImage image, const std::string& only, bool publish) {
  const double stamp = image.header.stamp.toSec();
  const auto start = std::chrono::steady_clock::now();
  RecognitionRequest request;
  request.only = only;
  request.support = image.support;
  request.previous = tracker_.previous(stamp);
  image.only = only;
  image.result = recognizer_.recognize(image.grey, image.camera, request);
  image.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  if (fromBeforeRestart(image)) {
    ROS_INFO("time went back while an image was worked on: its results are dropped");
    return reply(Recognize::Response::FAILED, "time went back while the image was worked on: ask again");
  }
  diagnostics_.worked(image.seconds, image.result.objects.size(), image.result.reason,
                      image.result.truncated);

  const std::vector<int> numbers = tracker_.update(image.result.objects, stamp);
  Recognize::Response response;
  response.objects = publish ? outputs_.publish(image, numbers) : outputs_.messages(image, numbers);
  if (response.objects.empty())
    return reply(Recognize::Response::NOT_FOUND, notFoundText(only, image.result));
  response.status = Recognize::Response::FOUND;
  response.text = foundText(response.objects);
  return response;
}

/// Its results would lie in the future of everything that comes, and hold up who listens to tf.
bool RecognizerNode::fromBeforeRestart(const WorkedImage& image) const {
  if (image.restarts != input_.restarts()) return true;
  const ros::Time now = ros::Time::now();
  if (!ros::Time::isSimTime() || now.isZero()) return false;
  const bool clock_went_back = secondsBetween(now, image.clock) > kTimeRestart;
  const bool late = secondsBetween(now, image.header.stamp) > kTimeRestart && !input_.stampsInFuture();
  return clock_went_back || late;
}

bool RecognizerNode::onRecognize(Recognize::Request& request, Recognize::Response& response) {
  const ModelBase& models = recognizer_.models();
  if (!request.name.empty() && models.indexOf(request.name) < 0) {
    response = reply(Recognize::Response::UNKNOWN_NAME,
                     "no object is named '" + request.name + "'; known: " + models.names());
    return true;
  }
  const PendingRequestPtr pending = requests_.add(request.name, input_.received());
  const auto arrived = [&] { return input_.received() > pending->after; };
  if (requests_.wait(pending, parameters_.service_timeout, arrived))
    response = pending->reply;
  else
    response = reply(Recognize::Response::NO_IMAGE, noImageText());
  return true;
}

std::string RecognizerNode::noImageText() const {
  return fmt::format("no image on {} within {:g} s: {}", input_.imageTopic(), parameters_.service_timeout,
                     input_.imagePublishers() == 0
                         ? "nobody publishes it (start the camera, or remap the topic)"
                         : "it has a publisher, which sent nothing");
}

}  // namespace monocular_eye_hand
