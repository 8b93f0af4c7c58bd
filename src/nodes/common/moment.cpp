#include "nodes/common/moment.h"

#include <algorithm>

namespace monocular_eye_hand {

double Moment::since() const {
  const double wall = (ros::WallTime::now() - wall_).toSec();
  if (!ros::Time::isSimTime()) return wall;
  const ros::Time now = ros::Time::now();
  if (now.isZero() || now < clock_) return wall;  // none came, or it was set back: it tells nothing
  return std::min(wall, (now - clock_).toSec());
}

}  // namespace monocular_eye_hand
