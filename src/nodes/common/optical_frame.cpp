#include "nodes/common/optical_frame.h"

#include <tf2/exceptions.h>

#include <Eigen/Geometry>
#include <vector>

#include "monocular_eye_hand/geometry/optical_axes.h"

namespace monocular_eye_hand {
namespace {

constexpr double kSameAxes = 0.02;  // of two rotation matrices

bool hangsAsOptical(const tf2::BufferCore& tf, const std::string& frame, const std::string& other) {
  try {
    const auto q = tf.lookupTransform(frame, other, ros::Time(0)).transform.rotation;
    const Eigen::Matrix3d frame_from_other =
        Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
    return (frame_from_other - bodyFromOptical()).cwiseAbs().maxCoeff() < kSameAxes;
  } catch (const tf2::TransformException&) {  // not known yet
    return false;
  }
}

}  // namespace

std::string opticalFrameIn(const tf2::BufferCore& tf, const std::string& frame) {
  std::vector<std::string> all;
  tf._getFrameStrings(all);
  for (const std::string& other : all) {
    std::string parent;
    if (other.find("optical") == std::string::npos || !tf._getParent(other, ros::Time(0), parent)) continue;
    if (parent == frame && hangsAsOptical(tf, frame, other)) return other;
  }
  return "";
}

}  // namespace monocular_eye_hand
