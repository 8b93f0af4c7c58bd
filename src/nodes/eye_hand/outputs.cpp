#include "nodes/eye_hand/outputs.h"

#include <geometry_msgs/PoseArray.h>
#include <monocular_eye_hand/LocatedObjectArray.h>

#include <chrono>

#include "nodes/common/names.h"
#include "nodes/eye_hand/messages.h"

namespace monocular_eye_hand {

EyeHandOutputs::EyeHandOutputs(const ModelBase& models, const EyeHandParameters& parameters,
                               const GraspAdvisor& advisor, std::function<ArmNow()> arm_now)
    : models_(models),
      parameters_(parameters),
      advisor_(advisor),
      arm_now_(std::move(arm_now)),
      mesh_markers_(models, {parameters.marker_triangles, parameters.label_height, Eigen::Vector3d::UnitZ()}),
      private_node_("~") {
  // Who begins to listen gets the grasps of what is known already.
  const ros::SubscriberStatusCallback listener = [this](const ros::SingleSubscriberPublisher&) {
    std::lock_guard<std::mutex> lock(mutex_);
    pending_ = any_;
    changed_.notify_all();
  };

  objects_ = private_node_.advertise<LocatedObjectArray>(names::kObjects, 10, true);
  best_grasps_ = private_node_.advertise<GraspTargetArray>(names::kBestGrasps, 10, listener);
  grasp_poses_ = private_node_.advertise<geometry_msgs::PoseArray>(names::kGraspPoses, 10, listener);
  markers_ = private_node_.advertise<visualization_msgs::MarkerArray>(names::kMarkers, 10, listener);
  worker_ = std::thread(&EyeHandOutputs::work, this);
}

EyeHandOutputs::~EyeHandOutputs() {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  worker_.join();
}

void EyeHandOutputs::publish(const KnownObjects& known, const ros::Time& stamp, const std::string& refused) {
  LocatedObjectArray array;
  array.header.stamp = stamp;
  array.header.frame_id = parameters_.base_frame;
  array.objects = toMessages(known, parameters_.base_frame);
  array.refused = refused;
  if (refused.empty()) array.ruled_out = known.map.ruled_out;
  objects_.publish(array);
  askForGrasps(known);
}

bool EyeHandOutputs::graspsWanted() const {
  return best_grasps_.getNumSubscribers() > 0 || grasp_poses_.getNumSubscribers() > 0 ||
         markers_.getNumSubscribers() > 0;
}

void EyeHandOutputs::askForGrasps(const KnownObjects& known) {
  std::lock_guard<std::mutex> lock(mutex_);
  newest_ = known;
  any_ = pending_ = true;
  changed_.notify_all();
}

void EyeHandOutputs::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    const auto news = [this] { return pending_ || stop_; };
    if (!changed_.wait_for(lock, std::chrono::duration<double>(kMarkerRepeat), news)) {
      repeatMarkers();
      continue;
    }

    if (stop_) return;
    pending_ = false;
    const KnownObjects known = newest_;
    lock.unlock();
    try {
      if (graspsWanted()) publishGrasps(known);
    } catch (const std::exception& e) {
      ROS_ERROR("no grasps: %s", e.what());
    }
    lock.lock();
  }
}

void EyeHandOutputs::publishGrasps(const KnownObjects& known) {
  if (markers_.getNumSubscribers() > 0) markers_.publish(meshes(known));
  const auto start = std::chrono::steady_clock::now();
  grasps_ = toMessage(advisor_.best(known.map, arm_now_(), parameters_.table_height), known,
                      parameters_.base_frame);
  grasp_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  best_grasps_.publish(grasps_);
  geometry_msgs::PoseArray poses;
  poses.header = grasps_.header;
  for (const GraspTarget& target : grasps_.targets)
    if (target.feasible) poses.poses.push_back(target.grasp);
  grasp_poses_.publish(poses);
  if (markers_.getNumSubscribers() > 0) markers_.publish(arrows_.build(grasps_));
}

void EyeHandOutputs::repeatMarkers() {
  if (!any_ || markers_.getNumSubscribers() == 0) return;
  markers_.publish(meshes(newest_));
  markers_.publish(arrows_.build(grasps_));
}

visualization_msgs::MarkerArray EyeHandOutputs::meshes(const KnownObjects& known) {
  std_msgs::Header header;  // stamp 0: in the base they are where they are
  header.frame_id = parameters_.base_frame;
  std::vector<ObjectEstimate> shown;
  std::vector<int> numbers;
  for (const MappedObject& object : known.map.objects) {
    ObjectEstimate estimate;
    estimate.object = object.object;
    estimate.name = object.name;
    estimate.camera_from_object = object.base_from_object;  // the frame is the header's
    estimate.probability = object.probability;
    estimate.decision = Decision::kAccepted;
    shown.push_back(estimate);
    numbers.push_back(object.number);
  }
  return mesh_markers_.build(header, shown, numbers, kRepeatedLifetime);
}

}  // namespace monocular_eye_hand
