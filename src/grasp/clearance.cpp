#include "clearance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/covariance.h"

namespace monocular_eye_hand {
namespace {

double mm(double metres) { return std::round(1e4 * metres) / 10; }

}  // namespace

ClearanceNeed clearanceNeed(const Rigid3& base_from_object, const Matrix6d& held, const Rigid3& base_from_tcp,
                            double width, const GripperOptions& gripper, const GraspPlanOptions& options) {
  // The part's small motion seen in the hand: d_hand = R^T (d about the hand's origin).
  const Matrix6d motion = adjointOfRotation(base_from_tcp.rotation.transpose()) *
                          adjointOfTranslation(base_from_tcp.translation - base_from_object.translation);
  const Matrix6d at_hand = propagate(motion, held);

  ClearanceNeed need;
  double largest = 0;
  for (const double x : {-0.5, 0.5}) {
    for (const double z : {-0.5, 0.5}) {
      Vector6d row;  // of y at the corner (x, 0, z): y + (rotation x corner)_y
      row << 0, 1, 0, -z * gripper.pad_length, 0, x * gripper.pad_width;
      largest = std::max(largest, row.dot(at_hand * row));
    }
  }
  need.closing = options.sigmas * std::sqrt(largest) + options.min_clearance;
  need.across = options.sigmas * std::sqrt(std::max(0.0, at_hand(0, 0)));
  need.along = options.sigmas * std::sqrt(std::max(0.0, at_hand(2, 2)));

  const double free = (gripper.opening_max - width) / 2;
  const auto refuse = [&](double wanted, double there, const char* where, const char* whose) {
    if (wanted - there <= need.shortfall) return;
    need.shortfall = wanted - there;
    need.refusal = fmt::format("{:g} sigma of the pose need {:g} mm {}, {} {:g} mm", options.sigmas,
                               mm(wanted), where, whose, mm(there));
    if (where[0] == 'o')
      need.refusal += fmt::format(" (opening {:g} mm, part {:g} mm)", mm(gripper.opening_max), mm(width));
  };
  refuse(need.closing, free, "on each side of the part", "the gripper leaves");
  refuse(need.across, gripper.pad_width / 2, "across the pads", "half a pad is");
  refuse(need.along, gripper.pad_length / 2, "along the approach", "half a pad is");
  return need;
}

}  // namespace monocular_eye_hand
