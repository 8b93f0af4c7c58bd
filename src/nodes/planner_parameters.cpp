#include "nodes/planner_parameters.h"

#include <cmath>
#include <sstream>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {
namespace {

void requireFinite(const char* field, double value) {
  require(std::isfinite(value) && std::abs(value) < 100, field, value, "within +-100");
}
void requireShare(const char* field, double value, double most) {
  if (value >= 0 && value <= most) return;
  std::ostringstream text;
  text << field << " = " << value << " must be 0 to " << most;
  throw BadInput(text.str());
}

}  // namespace

void PlannerTable::check() const {
  requireFinite("x", x);
  requireFinite("y", y);
  requireFinite("z", z);
  requireFinite("yaw", yaw);
  requirePositive("length", length);
  requirePositive("width", width);
  requirePositive("thickness", thickness);
}

void DropPlace::check() const {
  requireFinite("x", x);
  requireFinite("y", y);
  requireFinite("yaw", yaw);
}

void DropZone::check() const {
  requireFinite("x", x);
  requireFinite("y", y);
  requireFinite("yaw", yaw);
  requireFinite("part_yaw", part_yaw);
  requirePositive("length", length);
  requirePositive("width", width);
  require(columns >= 1 && columns <= 100, "columns", columns, "1 to 100");
  require(rows >= 1 && rows <= 100, "rows", rows, "1 to 100");
}

std::vector<DropPlace> DropZone::places() const {
  if (!list.empty()) return list;
  std::vector<DropPlace> places;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double along = length * ((column + 0.5) / columns - 0.5);
      const double across = width * ((row + 0.5) / rows - 0.5);
      DropPlace place;
      place.x = x + std::cos(yaw) * along - std::sin(yaw) * across;
      place.y = y + std::sin(yaw) * along + std::cos(yaw) * across;
      place.yaw = yaw + part_yaw;
      places.push_back(place);
    }
  return places;
}

void FollowOptions::check() const {
  requirePositive("deviation", deviation);
  requirePositive("lag", lag);
  requirePositive("settle", settle);
  requirePositive("goal_tolerance", goal_tolerance);
  requirePositive("stand_speed", stand_speed);
}

void ExecutionOptions::check() const {
  requirePositive("start_tolerance", start_tolerance);
  requirePositive("joint_silence", joint_silence);
  requirePositive("gripper_silence", gripper_silence);
  requirePositive("gripper_timeout", gripper_timeout);
  requirePositive("stop_timeout", stop_timeout);
  requirePositive("squeeze", squeeze);
  requirePositive("width_tolerance", width_tolerance);
  requirePositive("open_tolerance", open_tolerance);
  require(squeeze > width_tolerance, "squeeze", squeeze,
          "more than width_tolerance: else an empty gripper looks as if it held the part");
}

void PlannerParameters::check() const {
  requireGiven("objects", objects, "the path of the model base, e.g. config/objects.yaml of this package");
  requireGiven("urdf", urdf, "the path of the arm's URDF, e.g. urdf/puma560.urdf of this package");
  if (base_frame.empty()) throw BadInput("base_frame is empty");
  requireShare("drop_gap", drop_gap, 0.05);
  requirePositive("drop_above", drop_above);
  require(drop_above > drop_gap, "drop_above", drop_above, "more than drop_gap");
  requirePositive("feedback_period", feedback_period);
  requirePositive("diagnostic_period", diagnostic_period);
  requireOwnNames(boxes);
}

}  // namespace monocular_eye_hand
