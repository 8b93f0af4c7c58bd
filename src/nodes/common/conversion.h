#pragma once
#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseWithCovariance.h>
#include <geometry_msgs/TransformStamped.h>
#include <monocular_eye_hand/RecognizedObject.h>
#include <std_msgs/Header.h>

#include <string>

#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/recognition/object_estimate.h"

namespace monocular_eye_hand {

/// A frame's name as tf2 takes it: tf of old wrote a slash before it.
std::string withoutSlash(const std::string& frame);
geometry_msgs::Point toPoint(const Eigen::Vector3d& p);
/// `a_from_b` is the pose of frame b in frame a.
geometry_msgs::Pose toPose(const Rigid3& a_from_b);
Rigid3 fromPose(const geometry_msgs::Pose& pose);
/// `target_from_source` of tf's lookupTransform(target, source).
Rigid3 fromTransform(const geometry_msgs::Transform& transform);
/// Throws BadInput naming `what` when the pose is not finite or its quaternion has not length 1 (to 1 %).
Rigid3 poseOf(const geometry_msgs::Pose& pose, const std::string& what);
/// Row-major, order x, y, z, rotation about x, y, z: the core's own order.
geometry_msgs::PoseWithCovariance toPose(const Rigid3& a_from_b, const Matrix6d& covariance);
Matrix6d covarianceOf(const geometry_msgs::PoseWithCovariance& message);
/// `header.frame_id` is frame a, `child` frame b.
geometry_msgs::TransformStamped toTransform(const std_msgs::Header& header, const std::string& child,
                                            const Rigid3& a_from_b);
/// "<prefix><name>_<number>", with what tf does not take in a frame's name (anything but letters, digits,
/// '_', '-', '.', '/') replaced by '_'.
std::string objectFrame(const std::string& prefix, const std::string& name, int number);
/// `models`: for the names of the alternatives.
RecognizedObject toMessage(const std_msgs::Header& header, const ObjectEstimate& object, int instance,
                           const ModelBase& models);

}  // namespace monocular_eye_hand
