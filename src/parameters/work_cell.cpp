#include "monocular_eye_hand/parameters/work_cell.h"

#include <fmt/format.h>

#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {
namespace {

void requireRate(const char* field, double value, int max_rate) {
  require(value >= 0.1 && value <= max_rate, field, value, fmt::format("0.1..{} Hz", max_rate));
}

}  // namespace

void WorkCellParameters::check() const {
  requireGiven("objects", objects, "the path of the model base, e.g. config/objects.yaml of this package");
  requireGiven("urdf", urdf, "the path of the arm's URDF, e.g. urdf/puma560.urdf of this package");
  require(real_time_factor >= 0 && real_time_factor <= 1000, "real_time_factor", real_time_factor,
          "0..1000 (0: as fast as computed)");
  requireRate("joint_rate", joint_rate, 1000);
  requireRate("camera_rate", camera_rate, 200);
  requireRate("truth_rate", truth_rate, 1000);
  require(camera_threads >= 0, "camera_threads", camera_threads, ">= 0 (0: all cores)");
}

}  // namespace monocular_eye_hand
