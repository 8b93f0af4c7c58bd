#include "monocular_eye_hand/grasp/known_cell.h"

namespace monocular_eye_hand {
namespace {

KnownBox inHand(const char* name, const Rigid3& base_from_tcp, const Eigen::Vector3d& centre,
                const Eigen::Vector3d& size) {
  KnownBox box{name, base_from_tcp, size};
  box.base_from_box.translation = base_from_tcp * centre;
  return box;
}

Eigen::Vector3d vectorOf(const std::array<double, 3>& values) { return {values[0], values[1], values[2]}; }

std::vector<KnownBox> fingers(const GripperOptions& gripper, double width, const Rigid3& base_from_tcp) {
  const Eigen::Vector3d size(gripper.finger_width, gripper.finger_thickness,
                             gripper.finger_length + gripper.finger_tip);
  const double z = (gripper.finger_tip - gripper.finger_length) / 2;

  std::vector<KnownBox> boxes;
  for (double side : {1.0, -1.0}) {
    const Eigen::Vector3d centre(0, side * (width + gripper.finger_thickness) / 2, z);
    boxes.push_back(inHand("the fingers of the hand", base_from_tcp, centre, size));
  }
  return boxes;
}

}  // namespace

KnownSpace knownCell(const GraspingOptions& options, double table_height, const Rigid3& base_from_tcp,
                     const std::optional<GripperReading>& reading) {
  const GripperOptions& gripper = options.gripper;
  KnownSpace known;
  if (options.table) known.table_height = table_height;
  for (const CellBox& box : options.boxes)
    known.boxes.push_back({box.name, box.baseFromBox(), vectorOf(box.size)});
  for (const GripperBox& box : gripper.body)
    known.boxes.push_back(inHand("the hand", base_from_tcp, vectorOf(box.centre), vectorOf(box.size)));
  if (!reading) return known;

  for (const KnownBox& finger : fingers(gripper, reading->width, base_from_tcp))
    known.boxes.push_back(finger);
  if (reading->holds(options.held_width))
    known.boxes.push_back(inHand("what the hand holds", base_from_tcp, Eigen::Vector3d::Zero(),
                                 {gripper.pad_width, reading->width, gripper.pad_length}));
  return known;
}

}  // namespace monocular_eye_hand
