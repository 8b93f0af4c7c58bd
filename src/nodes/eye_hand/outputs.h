#pragma once
#include <monocular_eye_hand/GraspTargetArray.h>
#include <ros/ros.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "monocular_eye_hand/grasp/grasp_advisor.h"
#include "monocular_eye_hand/parameters/eye_hand.h"
#include "nodes/common/markers.h"
#include "nodes/eye_hand/messages.h"

namespace monocular_eye_hand {

/// ~objects, ~best_grasps, ~grasp_poses and ~markers. Grasps are computed on a thread of their own, of the
/// newest state only, and only while someone listens.
class EyeHandOutputs {
 public:
  /// All must outlive it; `arm_now` is called from the thread.
  EyeHandOutputs(const ModelBase& models, const EyeHandParameters& parameters, const GraspAdvisor& advisor,
                 std::function<ArmNow()> arm_now);
  ~EyeHandOutputs();
  /// `stamp`: of the view; `refused`: why it was not used.
  void publish(const KnownObjects& known, const ros::Time& stamp, const std::string& refused);
  double lastGraspSeconds() const { return grasp_seconds_; }

 private:
  bool graspsWanted() const;
  void askForGrasps(const KnownObjects& known);
  void work();
  void publishGrasps(const KnownObjects& known);
  void repeatMarkers();  // with mutex_ held
  visualization_msgs::MarkerArray meshes(const KnownObjects& known);

  const ModelBase& models_;
  const EyeHandParameters& parameters_;
  const GraspAdvisor& advisor_;
  const std::function<ArmNow()> arm_now_;
  MarkerBuilder mesh_markers_;
  GraspArrows arrows_;       // of the thread
  GraspTargetArray grasps_;  // of the thread: the last ones
  std::atomic<double> grasp_seconds_{0};

  std::mutex mutex_;
  std::condition_variable changed_;
  KnownObjects newest_;
  bool pending_ = false, any_ = false, stop_ = false;

  ros::NodeHandle private_node_;
  ros::Publisher objects_, best_grasps_, grasp_poses_, markers_;
  std::thread worker_;
};

}  // namespace monocular_eye_hand
