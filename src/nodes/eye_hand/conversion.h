#pragma once
#include <monocular_eye_hand/GraspTarget.h>
#include <monocular_eye_hand/LocatedObject.h>
#include <monocular_eye_hand/RecognizedObjectArray.h>
#include <ros/time.h>

#include <vector>

#include "monocular_eye_hand/eye_hand/object_view.h"
#include "monocular_eye_hand/grasp/plan_grasps.h"

namespace monocular_eye_hand {

/// The objects of one image. Throws BadInput naming the object and what is wrong with it: a name that is not
/// in the model base, an invalid pose, quaternion, covariance or probability.
std::vector<SeenObject> toSeenObjects(const RecognizedObjectArray& array, const ModelBase& models);

/// The search ended by itself and was for everything: what the message does not hold was not seen.
bool isComplete(const RecognizedObjectArray& array);

/// `stamp`: of the object's last view.
LocatedObject toMessage(const MappedObject& object, const ros::Time& stamp, const std::string& base_frame);

/// The way to pick `object` up.
GraspTarget toMessage(const LocatedObject& object, const GraspCandidate& grasp);
/// Why there is none.
GraspTarget noGrasp(const LocatedObject& object, const std::string& reason);

}  // namespace monocular_eye_hand
