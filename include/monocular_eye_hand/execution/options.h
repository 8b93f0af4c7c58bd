#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/puma560.h"
#include "monocular_eye_hand/geometry/cell_box.h"
#include "monocular_eye_hand/planning/options.h"

namespace monocular_eye_hand {

// Defaults of the execution stand here and nowhere else. check() throws BadInput naming field, value and
// rule.

/// The table's top: a box that ends there.
struct WorkTable {
  double x = 0.55, y = 0, z = 0.3, yaw = 0;            ///< middle of the top in base_link [m, rad]
  double length = 0.6, width = 1.0, thickness = 0.03;  ///< along its x and y, downwards [m]

  Rigid3 baseFromBox() const;  ///< of the box's middle
  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("x", x);
    v("y", y);
    v("z", z);
    v("yaw", yaw);
    v("length", length);
    v("width", width);
    v("thickness", thickness);
  }
};

/// A place where a part is put down.
struct DropPlace {
  double x = 0, y = 0;  ///< middle of the part's footprint in base_link [m]
  double yaw = 0;       ///< of the footprint's long side [rad]; tried first

  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("x", x);
    v("y", y);
    v("yaw", yaw);
  }
};

/// Places given one by one, or a rectangle divided into a grid.
struct DropZone {
  double x = 0.5, y = 0.33, yaw = 0;     ///< middle of the rectangle in base_link [m, rad]
  double length = 0.36, width = 0.26;    ///< along its x and y [m]
  int columns = 3, rows = 2;             ///< along its x and y; counted row by row
  double part_yaw = 1.5707963267948966;  ///< of the parts' long sides against its x [rad]
  std::vector<DropPlace> list;           ///< instead of the rectangle

  void check() const;
  std::vector<DropPlace> places() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("x", x);
    v("y", y);
    v("yaw", yaw);
    v("length", length);
    v("width", width);
    v("columns", columns);
    v("rows", rows);
    v("part_yaw", part_yaw);
    v("list", list);
  }
};

/// When a motion is done and when it has gone wrong.
struct FollowOptions {
  double deviation = 0.1;         ///< a joint farther off the planned path stops the arm [rad]
  double lag = 2.0;               ///< so far behind the plan stops it too [s]
  double goal_tolerance = 0.003;  ///< of every joint at the end [rad]
  double stand_speed = 0.01;      ///< a joint slower than this stands [rad/s]
  double settle = 2.0;            ///< longest wait for both after the motion's time [s]

  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("deviation", deviation);
    v("lag", lag);
    v("goal_tolerance", goal_tolerance);
    v("stand_speed", stand_speed);
    v("settle", settle);
  }
};

/// How arm and gripper are driven. Silences and time-outs count by Robot::since().
struct ExecutionOptions {
  double start_tolerance = 0.01;   ///< a kept plan is used when every joint is within this of its start [rad]
  double joint_silence = 2.0;      ///< the joint states must not be silent for longer [s]
  double gripper_silence = 2.0;    ///< nor the gripper's [s]
  double gripper_timeout = 10.0;   ///< longest way of the fingers [s]
  double stop_timeout = 5.0;       ///< the arm must stand so long after it was told to stop [s]
  double squeeze = 0.01;           ///< the gripper is told to close so much further than the part is wide [m]
  double width_tolerance = 0.004;  ///< a part is held when the width is that of the part within this [m]
  double open_tolerance = 0.001;  ///< the gripper is open when its width is the commanded one within this [m]
  FollowOptions follow;

  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("start_tolerance", start_tolerance);
    v("joint_silence", joint_silence);
    v("gripper_silence", gripper_silence);
    v("gripper_timeout", gripper_timeout);
    v("stop_timeout", stop_timeout);
    v("squeeze", squeeze);
    v("width_tolerance", width_tolerance);
    v("open_tolerance", open_tolerance);
    v("follow", follow);
  }
};

/// All that pick, place, move and recover can be told.
struct ExecutorOptions {
  std::string objects;  ///< model base: path of a YAML as config/objects.yaml; required
  std::string urdf;     ///< path of the arm's URDF; required
  WorkTable table;
  std::vector<CellBox> boxes;
  DropZone drop_zone;
  double drop_gap = 0.001;       ///< a part is let go so far above where it stood on the table [m]
  double drop_above = 0.1;       ///< the straight way down to its place [m]
  double feedback_period = 0.1;  ///< [s, wall clock]
  ExecutionOptions execution;
  PlanningOptions planning;
  Puma560Options arm;

  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("objects", objects);
    v("urdf", urdf);
    v("table", table);
    v("boxes", boxes);
    v("drop_zone", drop_zone);
    v("drop_gap", drop_gap);
    v("drop_above", drop_above);
    v("feedback_period", feedback_period);
    v("execution", execution);
    v("planning", planning);
    v("arm", arm);
  }
};

}  // namespace monocular_eye_hand
