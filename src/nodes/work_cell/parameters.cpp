#include "nodes/work_cell/parameters.h"

#include <sstream>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {
namespace {

void requireRate(const char* field, double value, double most) {
  if (value >= 0.1 && value <= most) return;
  std::ostringstream text;
  text << field << " = " << value << " must be 0.1.." << most << " Hz";
  throw BadInput(text.str());
}

}  // namespace

void WorkCellParameters::check() const {
  requireGiven("objects", objects, "the path of the model base, e.g. config/objects.yaml of this package");
  requireGiven("urdf", urdf, "the path of the arm's URDF, e.g. urdf/puma560.urdf of this package");
  if (!(real_time_factor >= 0 && real_time_factor <= 1000))
    throw BadInput("real_time_factor = " + std::to_string(real_time_factor) +
                   " must be 0..1000 (0: as fast as computed)");
  requireRate("joint_rate", joint_rate, 1000);
  requireRate("camera_rate", camera_rate, 200);
  requireRate("truth_rate", truth_rate, 1000);
  if (camera_threads < 0)
    throw BadInput("camera_threads = " + std::to_string(camera_threads) + " must be >= 0 (0: all cores)");
}

}  // namespace monocular_eye_hand
