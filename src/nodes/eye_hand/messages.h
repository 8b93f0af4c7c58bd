#pragma once
#include <monocular_eye_hand/GraspTargetArray.h>
#include <monocular_eye_hand/GraspTargets.h>
#include <monocular_eye_hand/LocatedObject.h>
#include <monocular_eye_hand/RecognizedObjectArray.h>
#include <ros/time.h>

#include <string>
#include <vector>

#include "monocular_eye_hand/eye_hand/shared_map.h"
#include "monocular_eye_hand/grasp/grasp_advisor.h"
#include "nodes/common/markers.h"

namespace monocular_eye_hand {

/// The objects of one image. Throws BadInput naming the object and what is wrong with it: a name that is not
/// in the model base, an invalid pose, quaternion, covariance or probability.
std::vector<SeenObject> toSeenObjects(const RecognizedObjectArray& array, const ModelBase& models);

/// The search ended by itself and was for everything: what the message does not hold was not seen.
bool isComplete(const RecognizedObjectArray& array);

/// `stamp`: of the object's last view.
LocatedObject toMessage(const MappedObject& object, const ros::Time& stamp, const std::string& base_frame);
/// In the order of known.map.objects.
std::vector<LocatedObject> toMessages(const KnownObjects& known, const std::string& base_frame);

/// The way to pick `object` up.
GraspTarget toMessage(const LocatedObject& object, const GraspCandidate& grasp);
/// Why there is none.
GraspTarget noGrasp(const LocatedObject& object, const std::string& reason);
/// The reply of ~grasp_targets. `known`: what the answer was found in.
GraspTargets::Response toMessage(const GraspAnswer& answer, const KnownObjects& known,
                                 const std::string& base_frame);
/// The message of ~best_grasps.
GraspTargetArray toMessage(const std::vector<BestGrasp>& best, const KnownObjects& known,
                           const std::string& base_frame);

/// Arrows from pre-grasp to grasp for rviz, namespace "<name>/grasp", id = instance; arrows of grasps that
/// are no more are deleted.
class GraspArrows {
 public:
  visualization_msgs::MarkerArray build(const GraspTargetArray& grasps);

 private:
  ShownMarkers shown_;
};

}  // namespace monocular_eye_hand
