#include "nodes/eye_hand/known_cell.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nodes/common/optical_frame.h"

namespace monocular_eye_hand {
namespace {

constexpr double kStands = 0.02, kFloats = 0.05;  // off the table's top: at most, at least [m]

KnownBox inHand(const char* name, const Rigid3& base_from_tcp, const Eigen::Vector3d& centre,
                const Eigen::Vector3d& size) {
  KnownBox box{name, base_from_tcp, size};
  box.base_from_box.translation = base_from_tcp * centre;
  return box;
}

Eigen::Vector3d vectorOf(const std::array<double, 3>& values) { return {values[0], values[1], values[2]}; }

void addFingers(const GripperOptions& gripper, const GripperReading& state, double held_width,
                const Rigid3& base_from_tcp, std::vector<KnownBox>* boxes) {
  const Eigen::Vector3d size(gripper.finger_width, gripper.finger_thickness,
                             gripper.finger_length + gripper.finger_tip);
  const double z = (gripper.finger_tip - gripper.finger_length) / 2;
  for (double side : {1.0, -1.0}) {
    const Eigen::Vector3d centre(0, side * (state.width + gripper.finger_thickness) / 2, z);
    boxes->push_back(inHand("the fingers of the hand", base_from_tcp, centre, size));
  }
  if (!holds(state, held_width)) return;
  boxes->push_back(inHand("what the hand holds", base_from_tcp, Eigen::Vector3d::Zero(),
                          {gripper.pad_width, state.width, gripper.pad_length}));
}

double lowestPoint(const ObjectModel& model, const Rigid3& base_from_object) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& vertex : model.mesh.vertices)
    lowest = std::min(lowest, (base_from_object * vertex).z());
  return lowest;
}

}  // namespace

bool holds(const std::optional<GripperReading>& gripper, double held_width) {
  return gripper && gripper->stalled && gripper->width > held_width;
}

KnownSpace knownCell(const EyeHandParameters& parameters, double table_height, const Rigid3& base_from_tcp,
                     const std::optional<GripperReading>& gripper) {
  KnownSpace known;
  if (parameters.table) known.table_height = table_height;
  for (const CellBox& box : parameters.boxes)
    known.boxes.push_back({box.name, box.baseFromBox(), vectorOf(box.size)});
  for (const GripperBox& box : parameters.gripper.body)
    known.boxes.push_back(inHand("the hand", base_from_tcp, vectorOf(box.centre), vectorOf(box.size)));
  if (gripper) addFingers(parameters.gripper, *gripper, parameters.held_width, base_from_tcp, &known.boxes);
  return known;
}

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
