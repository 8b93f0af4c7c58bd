#include "monocular_eye_hand/eye_hand/frame_axes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "monocular_eye_hand/geometry/optical_axes.h"

namespace monocular_eye_hand {
namespace {

constexpr double kStands = 0.02, kFloats = 0.05;  // off the table's top: at most, at least [m]

double lowestPoint(const ObjectModel& model, const Rigid3& base_from_object) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& vertex : model.mesh.vertices)
    lowest = std::min(lowest, (base_from_object * vertex).z());
  return lowest;
}

}  // namespace

FrameAxes axesOf(const ObjectView& view, const ModelBase& models, double table_height) {
  const Rigid3 base_from_camera = view.hand.base_from_tool0 * view.hand_eye.tool0_from_camera;
  const Rigid3 base_from_optical = base_from_camera * Rigid3{bodyFromOptical(), Eigen::Vector3d::Zero()};
  const auto off = [&](const SeenObject& seen, const Rigid3& base_from_frame) {
    const ObjectModel& model = models.objects[size_t(seen.object)].model;
    return std::abs(lowestPoint(model, base_from_frame * seen.camera_from_object) - table_height);
  };

  FrameAxes axes = view.objects.empty() ? FrameAxes::kUnknown : FrameAxes::kBody;
  for (const SeenObject& seen : view.objects) {
    const double as_it_is = off(seen, base_from_camera);
    if (as_it_is < kStands) return FrameAxes::kOptical;
    if (as_it_is < kFloats || off(seen, base_from_optical) > kStands) axes = FrameAxes::kUnknown;
  }
  return axes;
}

}  // namespace monocular_eye_hand
