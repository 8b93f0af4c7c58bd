#include "monocular_eye_hand/geometry/cell_box.h"

#include <cmath>
#include <set>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {
void CellBox::check() const {
  if (name.empty()) throw BadInput("name is empty: every box needs one, for messages");
  for (double value : {x, y, z, roll, pitch, yaw})
    require(std::isfinite(value) && std::abs(value) < 100, "pose", value, "within +-100");
  for (double value : size) require(std::isfinite(value) && value > 0, "size", value, "positive");
}

Rigid3 CellBox::baseFromBox() const { return poseOf(x, y, z, roll, pitch, yaw); }

void requireOwnNames(const std::vector<CellBox>& boxes) {
  std::set<std::string> names{"table"};
  for (const CellBox& box : boxes)
    if (!names.insert(box.name).second) throw BadInput("boxes: the name '" + box.name + "' stands twice");
}

Rigid3 poseOf(double x, double y, double z, double roll, double pitch, double yaw) {
  Rigid3 pose;
  pose.rotation =
      (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  pose.translation = {x, y, z};
  return pose;
}

}  // namespace monocular_eye_hand
