#include "monocular_eye_hand/execution/options.h"

#include <fmt/format.h>

#include <cmath>

#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {
namespace {

void requireWithin100(const char* field, double value) {
  require(std::abs(value) < 100, field, value, "within +-100");
}
void requireUpTo(const char* field, double value, double limit) {
  require(value >= 0 && value <= limit, field, value, fmt::format("0 to {:g}", limit));
}

}  // namespace

Rigid3 WorkTable::baseFromBox() const { return poseOf(x, y, z - thickness / 2, 0, 0, yaw); }

void WorkTable::check() const {
  requireWithin100("x", x);
  requireWithin100("y", y);
  requireWithin100("z", z);
  requireWithin100("yaw", yaw);
  requirePositive("length", length);
  requirePositive("width", width);
  requirePositive("thickness", thickness);
}

void DropPlace::check() const {
  requireWithin100("x", x);
  requireWithin100("y", y);
  requireWithin100("yaw", yaw);
}

void DropZone::check() const {
  requireWithin100("x", x);
  requireWithin100("y", y);
  requireWithin100("yaw", yaw);
  requireWithin100("part_yaw", part_yaw);
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

void ExecutorOptions::check() const {
  requireGiven("objects", objects, "the path of the model base, e.g. config/objects.yaml of this package");
  requireGiven("urdf", urdf, "the path of the arm's URDF, e.g. urdf/puma560.urdf of this package");
  requireUpTo("drop_gap", drop_gap, 0.05);
  requirePositive("drop_above", drop_above);
  require(drop_above > drop_gap, "drop_above", drop_above, "more than drop_gap");
  requirePositive("feedback_period", feedback_period);
  requireOwnNames(boxes);
}

}  // namespace monocular_eye_hand
