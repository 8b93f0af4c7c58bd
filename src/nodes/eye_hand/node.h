#pragma once
#include <monocular_eye_hand/ForgetObject.h>
#include <monocular_eye_hand/GraspTargets.h>
#include <monocular_eye_hand/RecognizedObjectArray.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

#include "monocular_eye_hand/eye_hand/shared_map.h"
#include "monocular_eye_hand/parameters/eye_hand.h"
#include "nodes/eye_hand/diagnostics.h"
#include "nodes/eye_hand/hand_input.h"
#include "nodes/eye_hand/outputs.h"

namespace monocular_eye_hand {

/// The node eye_hand: recognised objects in, objects and grasps in the arm's base out. One worker thread
/// takes the views in their order and waits for their tf; service calls run beside it.
class EyeHandNode {
 public:
  /// All must outlive it.
  EyeHandNode(const ModelBase& models, const EyeHandParameters& parameters, const Puma560& arm,
              const GraspAdvisor& advisor);
  ~EyeHandNode();

 private:
  void onView(const RecognizedObjectArrayConstPtr& view);
  void onInfo(const sensor_msgs::CameraInfoConstPtr& info);
  bool onGraspTargets(GraspTargets::Request& request, GraspTargets::Response& response);
  bool onForget(ForgetObject::Request& request, ForgetObject::Response& response);
  void work();
  void workOn(const RecognizedObjectArray& view);
  /// Merges the view. Throws BadInput with the reason why it is not used; what it returns are outcomes.
  std::string merge(const RecognizedObjectArray& view);
  /// Both throw BadInput when it is not known.
  Camera camera();
  HandAtStamp handAt(const ros::Time& stamp, const std::string& camera_frame);
  void requireOpticalFrame(const ObjectView& view, const std::string& frame, double table_height);
  void refuse(const RecognizedObjectArray& view, const std::string& reason);
  /// Publishes what is known now.
  void publishKnown(const ros::Time& stamp, const std::string& refused);
  sensor_msgs::CameraInfoConstPtr waitForInfo();
  void watchClock();

  const ModelBase& models_;
  const EyeHandParameters& parameters_;
  const GraspAdvisor& advisor_;
  HandInput hand_;
  SharedMap map_;
  EyeHandOutputs outputs_;
  std::mutex publish_mutex_;  // who looks later publishes later

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<RecognizedObjectArrayConstPtr> waiting_;
  sensor_msgs::CameraInfoConstPtr info_;
  ros::Time last_now_;         // of the worker
  std::string optical_frame_;  // of the worker: objects have stood on the table by it

  ros::NodeHandle node_;
  ros::CallbackQueue service_queue_;
  ros::NodeHandle service_node_;
  ros::Subscriber views_, infos_;
  EyeHandDiagnostics diagnostics_;
  ros::ServiceServer grasp_targets_, forget_;
  ros::AsyncSpinner service_spinner_;
  std::atomic<bool> stop_{false};
  std::thread worker_;
};

}  // namespace monocular_eye_hand
