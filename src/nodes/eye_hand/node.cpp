#include "nodes/eye_hand/node.h"

#include <fmt/format.h>

#include "monocular_eye_hand/eye_hand/frame_axes.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/grasp/known_cell.h"
#include "nodes/common/camera_info.h"
#include "nodes/common/conversion.h"
#include "nodes/common/names.h"
#include "nodes/common/node_on.h"
#include "nodes/common/stamps.h"
#include "nodes/eye_hand/messages.h"

namespace monocular_eye_hand {
namespace {

constexpr int kServiceThreads = 2;  // calls that are answered at the same time

/// A view from before the last ~forget.
struct BeforeForget : BadInput {
  using BadInput::BadInput;
};

}  // namespace

EyeHandNode::EyeHandNode(const ModelBase& models, const EyeHandParameters& parameters, const Puma560& arm,
                         const GraspAdvisor& advisor)
    : models_(models),
      parameters_(parameters),
      advisor_(advisor),
      hand_(parameters, arm),
      map_(&models, parameters.map),
      outputs_(models, parameters, advisor, [this] { return hand_.now(); }),
      service_node_(nodeOn(&service_queue_, "~")),
      diagnostics_(parameters.diagnostic_period, {views_, infos_, hand_, map_, outputs_}),
      service_spinner_(kServiceThreads, &service_queue_) {
  infos_ = node_.subscribe(names::kCameraInfo, 10, &EyeHandNode::onInfo, this);
  views_ = node_.subscribe(names::kRecognizedObjects, 100, &EyeHandNode::onView, this);
  worker_ = std::thread(&EyeHandNode::work, this);
  diagnostics_.start();
  grasp_targets_ = service_node_.advertiseService(names::kGraspTargets, &EyeHandNode::onGraspTargets, this);
  forget_ = service_node_.advertiseService(names::kForget, &EyeHandNode::onForget, this);
  service_spinner_.start();
}

EyeHandNode::~EyeHandNode() {
  stop_ = true;
  changed_.notify_all();
  grasp_targets_.shutdown();
  forget_.shutdown();
  service_spinner_.stop();
  worker_.join();
}

void EyeHandNode::onView(const RecognizedObjectArrayConstPtr& view) {
  RecognizedObjectArrayConstPtr overtaken;
  {
    std::lock_guard<std::mutex> lock(mutex_);
    waiting_.push_back(view);
    if (int(waiting_.size()) > parameters_.max_waiting) {
      overtaken = waiting_.front();
      waiting_.pop_front();
    }
  }
  changed_.notify_all();
  if (overtaken)
    refuse(*overtaken, fmt::format("{} newer views came while it waited for its turn behind one without tf",
                                   parameters_.max_waiting));
}

void EyeHandNode::onInfo(const sensor_msgs::CameraInfoConstPtr& info) {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    info_ = info;
  }
  changed_.notify_all();
}

void EyeHandNode::work() {
  while (!stop_ && ros::ok()) {
    RecognizedObjectArrayConstPtr view;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait_for(lock, std::chrono::milliseconds(100), [this] { return stop_ || !waiting_.empty(); });
      if (stop_ || waiting_.empty()) continue;
      view = waiting_.front();
      waiting_.pop_front();
    }
    workOn(*view);
  }
}

void EyeHandNode::workOn(const RecognizedObjectArray& view) {
  try {
    watchClock();
    const std::string outcomes = merge(view);
    ROS_DEBUG("view of %f: %s", view.header.stamp.toSec(), outcomes.c_str());
    diagnostics_.viewUsed(outcomes);
    publishKnown(view.header.stamp, "");
  } catch (const BeforeForget& e) {  // as it should be: no warning
    diagnostics_.viewLeftOut();
    publishKnown(view.header.stamp, e.what());
  } catch (const std::exception& e) {
    if (!stop_) refuse(view, e.what());
  }
}

std::string EyeHandNode::merge(const RecognizedObjectArray& view) {
  if (view.header.stamp.isZero()) throw BadInput("the view has no stamp: the camera's driver must set it");
  if (view.header.frame_id.empty())
    throw BadInput("the view has no frame_id: set the frame in the camera's driver");

  ObjectView input;
  input.objects = toSeenObjects(view, models_);
  input.stamp = view.header.stamp.toSec();
  input.camera = camera();

  const std::string camera_frame = withoutSlash(view.header.frame_id);
  const HandAtStamp hand = handAt(view.header.stamp, camera_frame);
  input.hand = hand.hand;
  input.hand_eye = hand.hand_eye;
  // A camera in motion misses much, and again and again; what the hand holds, of whatever shape, hides much.
  const bool holds = hand.gripper && hand.gripper->holds(parameters_.held_width);
  input.complete = isComplete(view) && !hand.moves && !holds;
  requireOpticalFrame(input, camera_frame, hand.table_height);
  input.known = knownCell(parameters_, hand.table_height, hand.hand.base_from_tool0 * advisor_.tool0FromTcp(),
                          hand.gripper);

  const AddedView added = map_.add(input, nanoseconds(view.header.stamp));
  if (added.before_forget) throw BeforeForget(added.report.refused);
  if (!added.report.refused.empty())
    throw BadInput(added.report.refused + " (call ~forget for every object)");
  return textOf(added.report, models_);
}

Camera EyeHandNode::camera() {
  const sensor_msgs::CameraInfoConstPtr info = waitForInfo();
  if (!info)
    throw BadInput("no camera_info on " + infos_.getTopic() + ": start the camera, or remap the topic");
  try {
    return cameraOf(fromMessage(*info), parameters_.rectified ? ImageKind::kRectified : ImageKind::kRaw);
  } catch (const BadCameraInfo& e) {
    throw BadInput("bad camera_info on " + infos_.getTopic() + ": " + e.what());
  }
}

HandAtStamp EyeHandNode::handAt(const ros::Time& stamp, const std::string& camera_frame) {
  const double went_back = map_.beginAgain(nanoseconds(stamp));
  if (went_back > 0)
    ROS_WARN("the stamps of the views went back by %.1f s: everything known is forgotten", went_back);
  HandAtStamp hand = hand_.at(stamp, camera_frame, [this] { return stop_ || !ros::ok(); });
  // Whether tf could tell or not: it takes nothing that is much older than what it has.
  if (went_back > 0) hand_.restart();
  if (!hand.problem.empty()) throw BadInput(hand.problem);
  return hand;
}

/// A camera's driver that names the body's frame puts every object somewhere else.
void EyeHandNode::requireOpticalFrame(const ObjectView& view, const std::string& frame, double table_height) {
  if (frame == optical_frame_) return;
  constexpr char kCure[] =
      "; set the parameter camera_frame of the recognizer to the optical frame (z forward)";
  const std::string optical = hand_.opticalFrameIn(frame);
  if (!optical.empty())
    throw BadInput(
        fmt::format("the view's frame {} is the body of the camera (x forward), whose optical frame is {}{}",
                    frame, optical, kCure));
  const FrameAxes axes = parameters_.table ? axesOf(view, models_, table_height) : FrameAxes::kUnknown;
  if (axes == FrameAxes::kOptical) optical_frame_ = frame;
  if (axes == FrameAxes::kBody)
    throw BadInput(fmt::format(
        "the view's frame {} seems to be the body of the camera (x forward): with its axes the objects "
        "would stand on the table, as they are none does{}",
        frame, kCure));
}

void EyeHandNode::refuse(const RecognizedObjectArray& view, const std::string& reason) {
  map_.refuse(reason);
  diagnostics_.viewRefused(reason);
  publishKnown(view.header.stamp, reason);
}

void EyeHandNode::publishKnown(const ros::Time& stamp, const std::string& refused) {
  std::lock_guard<std::mutex> lock(publish_mutex_);
  outputs_.publish(map_.known(), stamp, refused);
}

sensor_msgs::CameraInfoConstPtr EyeHandNode::waitForInfo() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(parameters_.wait), [this] { return info_ || stop_; });
  return info_;
}

void EyeHandNode::watchClock() {
  const ros::Time now = ros::Time::now();
  const double went_back = secondsBetween(now, last_now_);
  if (went_back > kTimeRestart) {
    ROS_WARN("time went back by %.1f s: everything known is forgotten", went_back);
    map_.clear();
  }
  last_now_ = now;
}

bool EyeHandNode::onGraspTargets(GraspTargets::Request& request, GraspTargets::Response& response) {
  try {
    const KnownObjects known = map_.known();
    const GraspAnswer answer =
        advisor_.answer(request.name, request.instance, known.map, hand_.now(), parameters_.table_height);
    response = toMessage(answer, known, parameters_.base_frame);
  } catch (const std::exception& e) {
    response.status = GraspTargets::Response::NO_GRASP;
    response.text = std::string("planning grasps failed: ") + e.what();
  }
  return true;
}

bool EyeHandNode::onForget(ForgetObject::Request& request, ForgetObject::Response& response) {
  const int object = request.name.empty() ? -1 : models_.indexOf(request.name);
  const std::string which =
      request.instance < 0 ? request.name : fmt::format("{} {}", request.name, request.instance);
  if (!request.name.empty() && object < 0) {
    response.text = "no object is named '" + request.name + "'; known: " + models_.names();
    return true;
  }
  response.forgotten = map_.forget(object, request.instance, nanoseconds(ros::Time::now()));
  if (response.forgotten == 0)
    response.text = "no " + (request.name.empty() ? "object" : which) + " is known";
  else
    response.text = "forgot " + (request.name.empty() ? "everything" : which);
  if (response.forgotten > 0) publishKnown(toTime(map_.known().stamp), "");
  return true;
}

}  // namespace monocular_eye_hand
